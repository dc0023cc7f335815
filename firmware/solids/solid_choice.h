// Which of its four members a solid is drawn with: by its size on the screen against a threshold table (Shindo et al.,
// chapter 5).
#pragma once

#include <cstdint>

#include "firmware/scene/view.h"
#include "firmware/solids/solid_format.h"
#include "firmware/solids/view_candidates.h"
#include "hal/vec.h"

namespace usuzumi::firmware {

enum class Member : std::uint8_t { kHigh = 0, kMedium = 1, kLow = 2, kRough = 3 };
inline constexpr std::uint32_t kMemberCount = 4;

/// Eq. (6): pixels, high >= medium >= low >= 0.
struct Thresholds {
  float high = 1, medium = 0, low = 0;  // T0: everything that is larger than a pixel is drawn whole
  friend bool operator==(const Thresholds&, const Thresholds&) = default;
};

/// False where they rise, are below 0 or are no numbers.
bool thresholds_fall(const Thresholds& thresholds);

/// Member 0 where `size_px` is above `high`, 1 above `medium`, 2 above `low`, else 3.
Member member_of(float size_px, const Thresholds& thresholds);

/// How a solid stands in a view.
struct SolidView {
  bool clipped = false;      // all of its box is outside the picture
  bool at_the_eye = false;   // it reaches to the viewer or behind: as large as can be
  float size_px = 0;         // Vmax: the longest of table 1's three, projected through the origin
};

/// `margin`: the picture is taken to reach so much farther on every side, as a share of its half: what comes into sight
/// is then known before it shows (ch. 6, at the end).
SolidView look_at(const format::Solid& solid, const View& view, float margin);

/// From where the view is seen: the point that projects to no place of the picture. Where lines of sight do not meet,
/// `parallel` is set and the answer is the direction to the viewer.
struct Eye {
  Vec3 place;
  bool parallel = false;
  /// From `point` to the viewer.
  Vec3 from(Vec3 point) const { return parallel ? place : place - point; }
};
Eye eye_of(const Mat4& model_to_clip);

}  // namespace usuzumi::firmware
