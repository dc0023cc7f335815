// Our engine on a scene: a flat piece of memory as its bus, one command list, executed again for every frame.
#pragma once

#include <cstdint>
#include <vector>

#include "gfx_subsystem/engine_soft/soft_engine.h"
#include "tests/bench/engine/bench_scenes.h"

namespace usuzumi::bench {

class SoftSubject {
 public:
  SoftSubject(const BenchScene& scene, gfx::ParallelRunner* runner, const gfx::soft::Kernels* kernels = nullptr);

  void draw();
  const std::uint32_t* pixels() const { return reinterpret_cast<const std::uint32_t*>(memory_.vram.data()); }
  const char* kernel_name() const { return engine_.kernel_name(); }

 private:
  static constexpr BusAddress kRam = 0x1000, kVram = 0x40000000;
  struct Memory final : BusMemory {
    std::vector<std::byte> ram;
    std::span<std::byte> vram;  // begins at a cache line, as a device's would
    std::span<const std::byte> do_read_window(BusAddress address, std::size_t size) const override;
    std::span<std::byte> do_write_window(BusAddress address, std::size_t size) override;
  };

  std::vector<std::byte> vram_;
  Memory memory_;
  std::vector<std::byte> work_;
  gfx::SoftEngine engine_;
  std::vector<std::uint32_t> words_;
  std::span<const std::uint32_t> list_;
};

}  // namespace usuzumi::bench
