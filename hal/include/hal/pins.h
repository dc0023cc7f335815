// The pins of an instrument: ignition and mode button come in, the backlight goes out.
#pragma once

#include <cstdint>

namespace usuzumi {

/// Meaning, not voltage: what is active-low is turned round by the board.
struct PinInputs {
  bool ignition = false;
  /// The button is down, or was at some time since the last read: a board with edge events reports short presses so.
  bool mode_button = false;
  friend constexpr bool operator==(const PinInputs&, const PinInputs&) = default;
};

class Pins {
 public:
  PinInputs read() { return do_read(); }
  void set_backlight(bool on) { do_set_backlight(on); }
  /// Sleeps until an input changes, `timeout_us` at most. May return early: it saves power, nothing depends on it.
  void wait_for_change(std::uint32_t timeout_us) { do_wait_for_change(timeout_us); }

 protected:
  ~Pins() = default;

 private:
  virtual PinInputs do_read() = 0;
  virtual void do_set_backlight(bool on) = 0;
  virtual void do_wait_for_change(std::uint32_t) {}
};

}  // namespace usuzumi
