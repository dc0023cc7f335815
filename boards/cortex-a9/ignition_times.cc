#include "boards/cortex-a9/ignition_times.h"

namespace usuzumi::boards::cortex_a9 {

void IgnitionTimes::ignition(bool on, const Moment& now) {
  if (on == on_) return;  // an edge that bounced back
  on_ = on;
  edge_ = now;
  pending_ = true;
  light_followed_ = lit_ == on;
  light_ = now;
  black_followed_ = false;
}

void IgnitionTimes::light(bool on, const Moment& now) {
  if (on == lit_) return;
  lit_ = on;
  if (on != on_) return;
  light_followed_ = true;
  light_ = now;
}

void IgnitionTimes::sent(bool black, const Moment& now) {
  if (!black || on_ || black_followed_) return;
  black_followed_ = true;
  black_ = now;
}

bool IgnitionTimes::take_line(TextLine& line) {
  if (!pending_ || !light_followed_ || (!on_ && !black_followed_)) return false;
  pending_ = false;
  const Moment& last = on_ ? light_ : black_;
  line.text("ignition ").number(on_ ? 1 : 0).text(" light_us=").number((light_.ns - edge_.ns) / 1000);
  if (!on_) line.text(" black_us=").number((black_.ns - edge_.ns) / 1000);
  line.text(" vcompares=").number(last.vertical_compares - edge_.vertical_compares);
  return true;
}

}  // namespace usuzumi::boards::cortex_a9
