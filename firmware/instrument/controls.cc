#include "firmware/instrument/controls.h"

namespace usuzumi::firmware {

void Controls::update(const PinInputs& pins, std::uint64_t now_ns) {
  if (pins.ignition && !ignition_) ignition_on_ns_ = now_ns;
  ignition_ = pins.ignition;
  const bool begins = pins.mode_button && !button_;
  const bool bounces = down_before_ && now_ns - last_down_ns_ < kDebounceNs;
  button_ = pins.mode_button;
  if (button_) {
    down_before_ = true;
    last_down_ns_ = now_ns;
  }
  if (begins && !bounces && ignition_) ++presses_;
}

}  // namespace usuzumi::firmware
