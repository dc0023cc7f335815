// The board's memories (memory_map.h), taken from the kernel once: nothing is allocated afterwards.
#pragma once

#include <cstddef>
#include <span>

#include "boards/common/memory.h"

namespace usuzumi::linux_arm64 {

class MappedMemory {
 public:
  MappedMemory() = default;
  ~MappedMemory();
  MappedMemory(const MappedMemory&) = delete;
  MappedMemory& operator=(const MappedMemory&) = delete;

  /// RAM, VRAM and the engine's working memory, all zeros. 0, or errno.
  int map();
  /// The file as ROM, read-only; it must not be cut short while it is mapped. 0, or errno (EFBIG: longer than
  /// kMostRomBytes; EISDIR, EMEDIUMTYPE: a folder, or a pipe or device). Without a ROM, or of an empty file, rom is
  /// empty: the device then says that it has no drawing data.
  int map_rom(const char* path);
  /// Keeps what is used of it from being swapped out. 0, or errno: the limit of locked memory, most often.
  int lock();

  const boards::BoardMemory& memory() const { return memory_; }

 private:
  boards::BoardMemory memory_;
  std::span<std::byte> all_;  // RAM, VRAM and working memory in one piece
};

}  // namespace usuzumi::linux_arm64
