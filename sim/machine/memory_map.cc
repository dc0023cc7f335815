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

MemoryMap::MemoryMap(std::span<const std::byte> rom, std::size_t ram_bytes, std::size_t vram_bytes)
    : rom_(checked("ROM", ExitCode::kBadInput, rom.size(), kRomBytesMax)),
      ram_(checked("RAM", ExitCode::kDevice, ram_bytes, kRamBytesMax)),
      vram_(checked("VRAM", ExitCode::kDevice, vram_bytes, kVramBytesMax)) {
  if (!rom.empty()) std::memcpy(rom_.bytes().data(), rom.data(), rom.size());
  rom_.make_read_only();
}

std::uint32_t MemoryMap::rom_crc32() const { return crc32(kCrc32Start, rom()); }

std::span<std::byte> MemoryMap::resolve(BusAddress address, std::size_t size, bool for_writing) const {
  struct Place {
    BusAddress base;
    std::span<std::byte> bytes;
    bool writable;
  };
  const Place places[] = {
      {kRomBase, rom_.bytes(), false}, {kRamBase, ram_.bytes(), true}, {kVramBase, vram_.bytes(), true}};
  for (const Place& place : places) {
    if (address < place.base || address - place.base >= place.bytes.size()) continue;
    const std::size_t offset = address - place.base;
    if (size > place.bytes.size() - offset || (for_writing && !place.writable)) return {};
    return place.bytes.subspan(offset, size);
  }
  return {};
}

std::span<const std::byte> MemoryMap::do_read_window(BusAddress address, std::size_t size) const {
  return resolve(address, size, false);
}
std::span<std::byte> MemoryMap::do_write_window(BusAddress address, std::size_t size) {
  return resolve(address, size, true);
}

BusAddress MemoryMap::do_bus_address(const void* pointer) const {
  const auto p = reinterpret_cast<std::uintptr_t>(pointer);
  const auto within = [p](std::span<const std::byte> bytes, BusAddress base) -> BusAddress {
    const auto first = reinterpret_cast<std::uintptr_t>(bytes.data());
    return p >= first && p - first < bytes.size() ? base + static_cast<BusAddress>(p - first) : 0;
  };
  if (const BusAddress a = within(ram(), kRamBase); a != 0) return a;
  if (const BusAddress a = within(rom(), kRomBase); a != 0) return a;
  return within(vram(), kVramBase);
}

}  // namespace usuzumi::sim
