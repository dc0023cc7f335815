#include "sim/desk/scripted_pins.h"

namespace usuzumi::sim {

void ScriptedPins::begin_frame(std::uint32_t frame) {
  for (; next_ < script_.size() && script_[next_].frame <= frame; ++next_) {
    const FrameEvent& event = script_[next_];
    if (event.name == "ignition") {
      levels_.ignition = event.level;
    } else {
      levels_.mode_button = event.level;
      pressed_since_read_ |= event.level;
    }
  }
}

PinInputs ScriptedPins::do_read() {
  PinInputs inputs = levels_;
  inputs.mode_button |= pressed_since_read_;
  pressed_since_read_ = false;
  return inputs;
}

}  // namespace usuzumi::sim
