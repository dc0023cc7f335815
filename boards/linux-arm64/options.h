// The command line of usuzumi-device.
#pragma once

#include <cstdint>

#include "hal/linux/drm_display.h"
#include "hal/linux/gpio_pins.h"

namespace usuzumi::linux_arm64 {

struct Options {
  const char* rom = nullptr;
  std::uint32_t width = 800, height = 480;  // pixels
  const char* card = nullptr;               // null: the first with a display
  // Defaults are the QEMU board's.
  linux_hal::GpioPinsConfig pins{.chip = "gpiochip0",
                                 .ignition = {4, false},
                                 .mode_button = {5, false},
                                 .backlight = {6, false}};
  std::uint32_t frames = 0;  // 0: until SIGTERM
  bool orbit = false;
  bool rgb565 = false;
  bool pause = false;
  bool help = false;
};

/// What the arguments ask for. Where they are wrong, false, with one line on standard error that says which and what
/// would be right.
bool parse_options(int count, char** arguments, Options& options);

extern const char kUsage[];

}  // namespace usuzumi::linux_arm64
