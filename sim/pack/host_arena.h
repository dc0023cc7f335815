// The host's memory as the arena that a board would give, for what the firmware does on the desk.
#pragma once

#include <cstddef>
#include <memory>

#include "hal/arena.h"

namespace usuzumi::sim {

/// `bytes` of it, not touched where they are not used.
class HostArena {
 public:
  explicit HostArena(std::size_t bytes) : memory_(new std::byte[bytes]), arena({memory_.get(), bytes}) {}

 private:
  std::unique_ptr<std::byte[]> memory_;

 public:
  Arena arena;
};

}  // namespace usuzumi::sim
