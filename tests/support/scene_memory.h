// A bus with two pieces of memory, RAM and VRAM, for engines under test. Nothing else answers.
#pragma once

#include <cstddef>
#include <vector>

#include "hal/bus.h"

namespace usuzumi::scenes {

class SceneMemory final : public BusMemory {
 public:
  static constexpr BusAddress kRamBase = 0x10000000, kVramBase = 0x20000000;

  SceneMemory(std::size_t ram_bytes, std::size_t vram_bytes) : ram_(ram_bytes), vram_(vram_bytes) {}

  std::span<std::byte> ram() { return ram_; }
  std::span<std::byte> vram() { return vram_; }
  std::span<const std::byte> vram() const { return vram_; }

 private:
  std::span<const std::byte> do_read_window(BusAddress address, std::size_t size) const override;
  std::span<std::byte> do_write_window(BusAddress address, std::size_t size) override;

  std::vector<std::byte> ram_, vram_;
};

}  // namespace usuzumi::scenes
