#include "boards/cortex-m7/pin_script.h"

#include "firmware/instrument/frame_event.h"

namespace usuzumi::boards::cortex_m7 {

bool PinScript::read_event(std::string_view text, Event& event) {
  firmware::FrameEvent read;
  if (!firmware::read_frame_event(text, read)) return false;
  event = {read.frame, read.name == "ignition", read.level};
  return event.ignition || read.name == "mode";
}

bool PinScript::read(std::string_view text) {
  levels_ = {};
  count_ = next_ = 0;
  for (;;) {
    const std::size_t end = text.find(',');
    Event event;
    const bool sound = count_ < kMaxEvents && read_event(text.substr(0, end), event) &&
                       (count_ == 0 || events_[count_ - 1].frame <= event.frame);
    if (!sound) {
      count_ = 0;
      return false;
    }
    events_[count_++] = event;
    if (end == text.npos) return true;
    text.remove_prefix(end + 1);
  }
}

PinInputs PinScript::at(std::uint32_t frame) {
  for (; next_ < count_ && events_[next_].frame <= frame; ++next_) {
    const Event& event = events_[next_];
    (event.ignition ? levels_.ignition : levels_.mode_button) = event.level;
  }
  return levels_;
}

}  // namespace usuzumi::boards::cortex_m7
