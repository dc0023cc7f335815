// Driver of the 3D engine (hal/registers/engine.h): rings the doorbell, waits, and says in words what failed.
#pragma once

#include <cstdint>

#include "hal/bus.h"
#include "hal/clock.h"
#include "hal/status.h"

namespace usuzumi {

class EngineDriver {
 public:
  /// `base`: bus address of the register block.
  EngineDriver(RegisterIo& registers, BusAddress base, InterruptWaiter& interrupts)
      : registers_(registers), interrupts_(interrupts), base_(base) {}

  /// Resets the engine and enables its interrupts. kUnavailable when another device, or none, answers at `base`
  /// (`where`: the ID read); kUnsupported for a rasterizer of another major version (`where`: the version read).
  Status probe();

  /// Starts a list of `words` words, kEnd included, at bus address `list`. kInvalidArgument when it is unaligned,
  /// empty, at address 0 or longer than the engine can take; kFailedPrecondition before probe(); kUnavailable while
  /// busy.
  Status start(BusAddress list, std::uint32_t words);

  /// Sleeps until the list has ended. An engine error becomes a Status with the list's word in `where`; error_code()
  /// has the number. kDeadlineExceeded after `timeout_us`: the engine is soft-reset and can be started again.
  /// kFailedPrecondition when nothing was started.
  Status wait_done(std::uint32_t timeout_us);

  /// Of the last list that ended; 0 before the first and after a timeout.
  std::uint64_t cycles();
  std::uint32_t faces_drawn();
  std::uint32_t faces_in();
  std::uint32_t vertices();
  std::uint32_t error_code();  // engine_registers::ErrorCode
  std::uint32_t rasterizer_version();

 private:
  std::uint32_t read(std::uint32_t offset) { return registers_.read32(base_ + offset); }
  void write(std::uint32_t offset, std::uint32_t value) { registers_.write32(base_ + offset, value); }
  void reset_and_enable();

  RegisterIo& registers_;
  InterruptWaiter& interrupts_;
  BusAddress base_;
  bool probed_ = false;
  bool started_ = false;
};

}  // namespace usuzumi
