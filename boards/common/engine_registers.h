// The 3D engine's registers on a board that has no 3D engine: behind the doorbell the CPU draws.
#pragma once

#include <cstddef>
#include <span>

#include "gfx_subsystem/engine/engine_device.h"
#include "gfx_subsystem/engine_soft/soft_engine.h"
#include "hal/bus.h"
#include "hal/clock.h"

namespace usuzumi::boards {

class EngineRegisters final : public RegisterIo, public InterruptWaiter {
 public:
  /// Where the firmware finds the engine. No address of a board: nothing but this class sees it.
  static constexpr BusAddress kBase = 0xF0000000;

  EngineRegisters(BusMemory& memory, std::span<std::byte> work_memory)
      : engine_({.work_memory = work_memory}), device_(engine_, memory, {}) {}

 private:
  std::uint32_t do_read32(BusAddress address) override { return device_.read(address - kBase); }
  /// A list is executed when its doorbell is rung; its end shows at once.
  void do_write32(BusAddress address, std::uint32_t value) override;
  Status do_wait(Interrupt interrupt, std::uint32_t timeout_us) override;

  gfx::SoftEngine engine_;
  gfx::EngineDevice device_;
};

}  // namespace usuzumi::boards
