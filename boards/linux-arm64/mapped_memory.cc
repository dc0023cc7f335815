#include "boards/linux-arm64/mapped_memory.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "boards/linux-arm64/memory_map.h"

namespace usuzumi::linux_arm64 {

MappedMemory::~MappedMemory() {
  if (!all_.empty()) munmap(all_.data(), all_.size());
  if (!memory_.rom.bytes.empty()) munmap(memory_.rom.bytes.data(), memory_.rom.bytes.size());
}

int MappedMemory::map() {
  constexpr std::size_t kAll = kRamBytes + kVramBytes + kEngineWorkBytes;
  void* const at = mmap(nullptr, kAll, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (at == MAP_FAILED) return errno;
  all_ = {static_cast<std::byte*>(at), kAll};
  memory_.ram = {kRamBase, all_.first(kRamBytes)};
  memory_.vram = {kVramBase, all_.subspan(kRamBytes, kVramBytes)};
  memory_.engine_work = all_.last(kEngineWorkBytes);
  memory_.rom = {kRomBase, {}, false};
  return 0;
}

int MappedMemory::map_rom(const char* path) {
  // Without O_NONBLOCK the opening of a pipe waits for whoever will write into it.
  const int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return errno;
  struct stat about {};
  int error = fstat(file, &about) < 0 ? errno : 0;
  if (error == 0 && !S_ISREG(about.st_mode)) error = S_ISDIR(about.st_mode) ? EISDIR : EMEDIUMTYPE;
  const auto bytes = static_cast<std::size_t>(about.st_size);
  if (error == 0 && bytes > kMostRomBytes) error = EFBIG;
  if (error == 0 && bytes > 0) {
    void* const at = mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE, file, 0);
    if (at == MAP_FAILED) error = errno;
    else memory_.rom.bytes = {static_cast<std::byte*>(at), bytes};
  }
  close(file);
  return error;
}

int MappedMemory::lock() { return mlockall(MCL_CURRENT | MCL_ONFAULT) < 0 ? errno : 0; }

}  // namespace usuzumi::linux_arm64
