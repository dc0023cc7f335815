#include "boards/cortex-m7/pin_script.h"

#include "boards/cortex-m7/options.h"

namespace usuzumi::boards::cortex_m7 {

bool PinScript::read_event(std::string_view text, Event& event) {
  const std::size_t colon = text.find(':'), equals = text.find('=');
  if (colon == text.npos || equals == text.npos || equals < colon) return false;
  const std::string_view name = text.substr(colon + 1, equals - colon - 1), level = text.substr(equals + 1);
  event.ignition = name == "ignition";
  event.level = level == "1";
  return read_number(text.substr(0, colon), event.frame) && (name == "ignition" || name == "mode") &&
         (level == "0" || level == "1");
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
