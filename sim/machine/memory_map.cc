#include "sim/machine/memory_map.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

#include "hal/crc32.h"
#include "sim/common/error.h"
#include "sim/machine/address_map.h"

namespace usuzumi::sim {
namespace {

std::size_t whole_pages(std::size_t bytes) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  return bytes == 0 ? page : (bytes + page - 1) / page * page;
}

std::size_t checked(const char* what, ExitCode code, std::size_t bytes, std::size_t most) {
  if (bytes > most)
    throw Error(code, fmt::format("{} of {} bytes: the address map has room for {}", what, bytes, most));
  return bytes;
}

}  // namespace

HostPages::HostPages(std::size_t bytes) : size_(bytes), reserved_(whole_pages(bytes)) {
  void* p = ::mmap(nullptr, reserved_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (p == MAP_FAILED)
    throw Error(ExitCode::kDevice,
                fmt::format("cannot reserve {} bytes for the device's memory: {}", bytes, std::strerror(errno)));
  data_ = static_cast<std::byte*>(p);
}

HostPages::~HostPages() { ::munmap(data_, reserved_); }

void HostPages::make_read_only() {
  if (::mprotect(data_, reserved_, PROT_READ) != 0)
    throw Error(ExitCode::kDevice, fmt::format("cannot make the ROM read-only: {}", std::strerror(errno)));
}

MemoryMap::MemoryMap(std::span<const std::byte> rom_image, std::size_t ram_bytes, std::size_t vram_bytes)
    : MachineMemories{HostPages(checked("ROM", ExitCode::kBadInput, rom_image.size(), kRomBytesMax)),
                      HostPages(checked("RAM", ExitCode::kDevice, ram_bytes, kRamBytesMax)),
                      HostPages(checked("VRAM", ExitCode::kDevice, vram_bytes, kVramBytesMax))},
      MemoryRegions({{{kRamBase, ram(), true},
                      {kRomBase, MachineMemories::rom.bytes(), false},
                      {kVramBase, vram(), true}}}) {
  if (!rom_image.empty()) std::memcpy(MachineMemories::rom.bytes().data(), rom_image.data(), rom_image.size());
  MachineMemories::rom.make_read_only();
}

std::uint32_t MemoryMap::rom_crc32() const { return crc32(kCrc32Start, rom()); }

}  // namespace usuzumi::sim
