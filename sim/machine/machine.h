// The device put together: memories, 3D engine, display controller and interrupt controller on one bus, under one
// virtual clock. What the firmware reaches, it reaches through the interfaces of hal/include implemented here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "gfx_subsystem/display/display_controller.h"
#include "gfx_subsystem/engine/engine.h"
#include "gfx_subsystem/engine/engine_device.h"
#include "hal/clock.h"
#include "sim/machine/address_map.h"
#include "sim/machine/board.h"
#include "sim/machine/guest_log.h"
#include "sim/machine/interrupt_controller.h"
#include "sim/machine/memory_map.h"

namespace usuzumi::sim {

/// What is broken, so that the firmware's timeouts and the display's faults can be tested.
struct Faults {
  bool engine_hangs = false;  // lists are executed but never end
  double bus_slowdown = 1;    // the display controller gets this much less of the bus; >= 1
};

class Machine final : public MemoryMap, public RegisterIo, public Clock, public InterruptWaiter {
 public:
  /// `rom` is copied; `engine` and `video` outlive the machine. Throws Error, see MemoryMap.
  Machine(const BoardDescription& board, std::span<const std::byte> rom, gfx::Engine& engine, gfx::VideoSink& video,
          const Faults& faults = {});

  const BoardDescription& board() const { return board_; }
  /// From now on; a list that runs already ends as it would have.
  void inject(const Faults& faults);

  /// Virtual time in cycles of kMasterHz.
  std::uint64_t now_cycles() const { return now_; }
  /// Lets time pass with the CPU idle.
  void idle(std::uint64_t cycles) { advance_to(now_ + cycles); }

  /// Host-side views; nothing the firmware could see.
  const gfx::EngineDevice& engine() const { return engine_; }
  const gfx::DisplayController& display() const { return display_; }
  const InterruptController& interrupts() const { return interrupts_; }
  const GuestLog& guest_log() const { return guest_log_; }

 private:
  void advance_to(std::uint64_t now);
  void spend_cpu_clocks(std::uint64_t clocks);
  /// Takes over the devices' interrupt lines and the time of their next event.
  void poll_devices();

  std::uint32_t do_read32(BusAddress address) override;
  void do_write32(BusAddress address, std::uint32_t value) override;
  std::uint64_t do_now_ns() override;
  void do_charge(CpuWork work, std::uint64_t count) override;
  Status do_wait(Interrupt interrupt, std::uint32_t timeout_us) override;

  BoardDescription board_;
  GuestLog guest_log_;
  GuestLog::Device engine_log_{guest_log_, "engine", kEngineBase};
  GuestLog::Device display_log_{guest_log_, "display", kDisplayBase};
  GuestLog::Device interrupt_log_{guest_log_, "interrupts", kInterruptBase};
  gfx::EngineDevice engine_;
  gfx::DisplayController display_;
  InterruptController interrupts_;
  std::uint64_t now_ = 0;
  std::uint64_t next_event_ = 0;
  std::uint64_t cpu_remainder_ = 0;  // of a master cycle, in 1 / cpu_hz
};

}  // namespace usuzumi::sim
