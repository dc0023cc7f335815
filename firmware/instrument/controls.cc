#include "firmware/instrument/controls.h"

namespace usuzumi::firmware {

void Controls::update(const PinInputs& pins, std::uint64_t now_ns) {
  if (pins.ignition && !ignition_) ignition_on_ns_ = now_ns;
  ignition_ = pins.ignition;
  const bool begins = pins.mode_button && !button_;
  button_ = pins.mode_button;
  const bool bounces = pressed_before_ && now_ns - pressed_ns_ < kDebounceNs;
  if (!begins || bounces || !ignition_) return;
  pressed_before_ = true;
  pressed_ns_ = now_ns;
  ++presses_;
}

}  // namespace usuzumi::firmware
