// The board: a DRM display, pins on a GPIO chip, CLOCK_MONOTONIC, lines on standard output.
#pragma once

#include <csignal>
#include <cstdint>
#include <string_view>

#include "boards/common/board.h"
#include "boards/linux-arm64/changed_lines.h"
#include "hal/linux/drm_display.h"
#include "hal/linux/gpio_pins.h"
#include "hal/linux/kernel.h"

namespace usuzumi::linux_arm64 {

class LinuxBoard final : public boards::Board {
 public:
  /// `stop` becomes nonzero when the program is to end: a signal's handler sets it.
  LinuxBoard(linux_hal::Kernel& kernel, const volatile std::sig_atomic_t& stop) : display_(kernel), stop_(stop) {}

  /// Pins first, so that the backlight is off whatever becomes of the display.
  Status open(const linux_hal::GpioPinsConfig& pins, const linux_hal::DrmConfig& display);
  /// Backlight off, the display as it was found.
  void close();

  /// After each step a byte of standard input is waited for: a test looks at the panel meanwhile.
  void pause_after_steps() { pause_ = true; }
  /// Frames' lines are printed only where they tell of a change.
  void print_only_changes() { only_changes_ = true; }

 private:
  std::uint64_t do_now_ns() override;
  std::uint32_t do_stride_bytes(std::uint32_t width, std::uint32_t height, command::PixelFormat format) override;
  Status do_start(const Scanout& scanout) override { return display_.start(scanout); }
  Status do_show(std::uint32_t picture, const PictureRectangle* part) override;
  Status do_check() override { return pins_.check(); }
  PinInputs do_read() override;
  void do_set_backlight(bool on) override { pins_.set_backlight(on); }
  void do_wait_for_change(std::uint32_t timeout_us) override;
  void do_print(std::string_view line) override;
  void do_step_done() override;
  bool do_stop_wanted() override { return stop_ != 0; }

  linux_hal::GpioPins pins_;
  linux_hal::DrmDisplay display_;
  const volatile std::sig_atomic_t& stop_;
  ChangedLines changed_lines_;
  bool pause_ = false, only_changes_ = false;
};

}  // namespace usuzumi::linux_arm64
