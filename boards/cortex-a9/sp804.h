// Time: Arm Dual-Timer SP804 (DDI 0271). Timer 1 counts for ever, timer 2 wakes the processor.
#pragma once

#include <cstdint>

#include "boards/cortex-a9/registers.h"

namespace usuzumi::boards::cortex_a9 {

class Sp804 {
 public:
  /// TIMCLK.
  static constexpr std::uint32_t kClockHz = 1'000'000;
  /// From the start to the counter's first wrap: while the first picture is drawn, so that every run measures a time
  /// through one, not only a run of 71 minutes.
  static constexpr std::uint32_t kFirstWrapUs = 50'000;

  explicit constexpr Sp804(Registers registers) : counter_(registers), alarm_(registers.part(0x20)) {}

  void start();

  /// Since start(). 32 bits of counter are made 64 by adding up differences, so it must be asked once in 71 minutes:
  /// the main loop does, frame by frame. Interrupts are masked meanwhile.
  std::uint64_t now_ns();

  /// One interrupt after `us`, which alarm_rang() then tells until the next set_alarm().
  void set_alarm(std::uint32_t us);
  void cancel_alarm();
  bool alarm_rang() const { return alarm_rang_; }

  /// The handler of the interrupt that both timers share.
  void on_interrupt();

 private:
  Registers counter_, alarm_;
  std::uint32_t last_count_ = 0;
  std::uint64_t elapsed_us_ = 0;
  volatile bool alarm_rang_ = false;
};

}  // namespace usuzumi::boards::cortex_a9
