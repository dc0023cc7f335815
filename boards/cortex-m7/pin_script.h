// Ignition and mode button after a script, for a machine that has no pins: "0:ignition=1,120:mode=1".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hal/pins.h"

namespace usuzumi::boards::cortex_m7 {

class PinScript {
 public:
  static constexpr std::size_t kMaxEvents = 32;

  /// FRAME:NAME=0|1, parted by commas, in rising order of frames; NAME is ignition or mode. All low at first. False,
  /// and an empty script, where the text is none or has more than kMaxEvents.
  bool read(std::string_view text);

  /// The inputs at this frame; frames come in rising order. Without a script the ignition is on, the button up.
  PinInputs at(std::uint32_t frame);

 private:
  struct Event {
    std::uint32_t frame = 0;
    bool ignition = false;  // or the mode button
    bool level = false;
  };
  static bool read_event(std::string_view text, Event& event);

  std::array<Event, kMaxEvents> events_;
  std::size_t count_ = 0, next_ = 0;
  PinInputs levels_{.ignition = true};
};

}  // namespace usuzumi::boards::cortex_m7
