// The instrument's pins on lines of a GPIO chip.
#pragma once

#include "hal/linux/gpio_lines.h"
#include "hal/pins.h"
#include "hal/status.h"

namespace usuzumi::linux_hal {

struct GpioPinsConfig {
  const char* chip = "";  // label, name or path
  GpioLine ignition, mode_button, backlight;
};

class GpioPins final : public Pins {
 public:
  /// The backlight is off when this returns. Errors: GpioLines::open().
  Status open(const GpioPinsConfig& config);
  /// Backlight off, lines given back.
  void close();
  /// ok, or why pins could not be read or set since the last call. Where reading fails the last levels hold.
  Status check();

 private:
  PinInputs do_read() override;
  void do_set_backlight(bool on) override;
  void do_wait_for_change(std::uint32_t timeout_us) override;
  void note(const Status& status);

  GpioLines lines_;
  PinInputs last_;           // levels, without what events told
  Status failed_;
};

}  // namespace usuzumi::linux_hal
