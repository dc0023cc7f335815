// The cortex-a9 board: what its drivers do for the instrument.
#pragma once

#include <cstdint>
#include <string_view>

#include "boards/common/board.h"
#include "boards/cortex-a9/ignition_times.h"
#include "boards/cortex-a9/memory_map.h"
#include "boards/cortex-a9/pl011.h"
#include "boards/cortex-a9/pl061.h"
#include "boards/cortex-a9/pl111.h"
#include "boards/cortex-a9/sp804.h"

namespace usuzumi::boards::cortex_a9 {

/// One of it; it stays where it is, for interrupts find it there.
///
/// The console listens after each step: 'h' holds the instrument there until the next byte, which is a step more, or
/// 'r', which lets it run. So a test looks at a panel that stands still. After kHoldUs without a byte it runs on.
class CortexA9Board final : public Board {
 public:
  static constexpr std::uint32_t kFrameUs = 16'667;
  /// A picture begins within a frame; more means that the controller stands.
  static constexpr std::uint32_t kShowTimeoutUs = 6 * kFrameUs;
  static constexpr std::uint32_t kHoldUs = 60'000'000;

  /// Brings console, timers, pins and interrupts up. The backlight is off.
  void start();
  /// Holds after the first step already, as if 'h' had come.
  void hold() { held_ = true; }

 private:
  std::uint64_t do_now_ns() override;

  std::uint32_t do_stride_bytes(std::uint32_t width, std::uint32_t, command::PixelFormat format) override;
  Status do_start(const Scanout& scanout) override;
  Status do_show(std::uint32_t picture, const PictureRectangle* part) override;
  Status do_check() override { return display_.take_fault(); }

  PinInputs do_read() override;
  void do_set_backlight(bool on) override;
  void do_wait_for_change(std::uint32_t timeout_us) override;

  void do_print(std::string_view line) override { console_.print(line); }
  void do_step_done() override;

  /// Sleeps until `done()`, which interrupts make true, or for `timeout_us`; then false.
  template <class Done>
  bool wait_until(std::uint32_t timeout_us, Done done);
  void on_gpio_interrupt();
  /// The light is on while the instrument wants it and the ignition is on: it goes off without waiting for a step.
  void drive_backlight();
  bool ignition() const { return gpio_.read(kIgnitionLine) == 0; }
  IgnitionTimes::Moment moment() { return {timers_.now_ns(), display_.vertical_compares()}; }

  Pl011 console_{Registers(kUart0)};
  Sp804 timers_{Registers(kTimers01)};
  Pl061 gpio_{Registers(kGpio0)};
  Pl111 display_{Registers(kLcd)};
  IgnitionTimes times_;
  Scanout scanout_;
  bool light_wanted_ = false;
  bool held_ = false;
};

}  // namespace usuzumi::boards::cortex_a9
