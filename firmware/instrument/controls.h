// What the driver asks for by ignition and mode button: pins in, presses out. No hardware, no drawing.
#pragma once

#include <cstdint>

#include "hal/pins.h"

namespace usuzumi::firmware {

class Controls {
 public:
  /// Contacts bounce for some milliseconds as they close and as they open: a press that begins within this time after
  /// the button was last seen down is none.
  static constexpr std::uint64_t kDebounceNs = 50'000'000;

  /// Takes the pins as they are at `now_ns`. A press of the button counts once, when it begins, and only while the
  /// ignition is on.
  void update(const PinInputs& pins, std::uint64_t now_ns);

  bool ignition() const { return ignition_; }
  /// When the ignition was last seen to go on.
  std::uint64_t ignition_on_ns() const { return ignition_on_ns_; }
  /// How often the button was pressed.
  std::uint32_t presses() const { return presses_; }

 private:
  std::uint32_t presses_ = 0;
  bool ignition_ = false;
  bool button_ = false;
  bool down_before_ = false;
  std::uint64_t last_down_ns_ = 0;
  std::uint64_t ignition_on_ns_ = 0;
};

}  // namespace usuzumi::firmware
