#include "boards/cortex-a9/ignition_times.h"

namespace usuzumi::boards::cortex_a9 {

void IgnitionTimes::ignition(bool on, const Moment& now) {
  if (on == on_) return;  // an edge that bounced back
  on_ = on;
  edge_ = light_ = now;
  stage_ = Stage::kEdge;
}

void IgnitionTimes::light(bool on, const Moment& now) {
  if (on == lit_) return;
  lit_ = on;
  light_ = now;
  if (on && stage_ == Stage::kHanded) stage_ = Stage::kFollowed;
}

void IgnitionTimes::handed(bool black, const Moment& now) {
  if (stage_ != Stage::kEdge || black == on_) return;
  stage_ = Stage::kHanded;
  handed_ = now;
}

void IgnitionTimes::sent(bool black, const Moment& now) {
  if (stage_ != Stage::kHanded || !black) return;
  stage_ = Stage::kFollowed;
  sent_ = now;
}

bool IgnitionTimes::take_line(TextLine& line) {
  if (stage_ != Stage::kFollowed) return false;
  stage_ = Stage::kNone;
  const Moment& last = on_ ? light_ : sent_;
  line.text("ignition ").number(on_ ? 1 : 0).text(" light_us=").number((light_.ns - edge_.ns) / 1000);
  if (!on_) line.text(" black_us=").number((sent_.ns - edge_.ns) / 1000);
  line.text(" vcompares=").number(last.vertical_compares - handed_.vertical_compares);
  return true;
}

}  // namespace usuzumi::boards::cortex_a9
