#include "firmware/solids/solid_choice.h"

#include <cmath>

#include "firmware/solids/solid_placement.h"
#include "firmware/solids/solid_shape.h"

namespace usuzumi::firmware {
namespace {

float length_px(Vec4 a, Vec4 b, const View& view) {
  const float x = (b.x / b.w - a.x / a.w) * 0.5f * static_cast<float>(view.width);
  const float y = (b.y / b.w - a.y / a.w) * 0.5f * static_cast<float>(view.height);
  return std::sqrt(x * x + y * y);
}

}  // namespace

bool thresholds_fall(const Thresholds& t) { return t.high >= t.medium && t.medium >= t.low && t.low >= 0; }

Member member_of(float size_px, const Thresholds& thresholds) {
  if (size_px > thresholds.high) return Member::kHigh;
  if (size_px > thresholds.medium) return Member::kMedium;
  return size_px > thresholds.low ? Member::kLow : Member::kRough;
}

SolidView look_at(const format::Solid& solid, const View& view, float margin) {
  SolidView seen;
  // Bit by bit: every corner beyond the left, right, lower, upper, near or far side.
  std::uint32_t beyond = 63;
  for (const Vec3 corner : corners_of(solid).of) {
    const Vec4 c = transform_point(view.model_to_clip, corner);
    const float edge = c.w * (1 + margin);
    std::uint32_t outside = 0;
    if (c.x < -edge) outside |= 1;
    if (c.x > edge) outside |= 2;
    if (c.y < -edge) outside |= 4;
    if (c.y > edge) outside |= 8;
    if (c.z < -c.w) outside |= 16;
    if (c.z > c.w) outside |= 32;
    beyond &= outside;
    if (!(c.w > 0)) seen.at_the_eye = true;
  }
  seen.clipped = beyond != 0;
  if (seen.clipped || seen.at_the_eye) return seen;
  const SolidPlacement placement = SolidPlacement::of(solid);
  const Vec3 size = identifying_size(solid.kind, solid.size) * 0.5f;
  for (const Vec3 own : {Vec3{size.x, 0, 0}, Vec3{0, size.y, 0}, Vec3{0, 0, size.z}}) {
    const Vec3 way = placement.direction(own);
    const float px = length_px(transform_point(view.model_to_clip, placement.origin - way),
                               transform_point(view.model_to_clip, placement.origin + way), view);
    if (px > seen.size_px) seen.size_px = px;
  }
  return seen;
}

Eye eye_of(const Mat4& m) {
  // Rows x, y and w of the projection vanish at the eye.
  const Vec3 x{m.m[0], m.m[1], m.m[2]}, y{m.m[4], m.m[5], m.m[6]}, w{m.m[12], m.m[13], m.m[14]};
  const Vec3 across = cross(x, y);
  const float determinant = dot(across, w);
  if (determinant == 0) {
    // Towards the viewer depth falls.
    const Vec3 deeper{m.m[8], m.m[9], m.m[10]};
    return {normalized(dot(across, deeper) > 0 ? across * -1 : across), true};
  }
  const Vec3 sum = cross(y, w) * m.m[3] + cross(w, x) * m.m[7] + across * m.m[15];
  return {sum * (-1.0f / determinant), false};
}

}  // namespace usuzumi::firmware
