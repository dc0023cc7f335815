#include "firmware/solids/solid_placement.h"

#include <cmath>

#include "firmware/simplify/bounds.h"
#include "firmware/solids/solid_shape.h"

namespace usuzumi::firmware {
namespace {

/// NaN is not.
bool is_within(Vec3 v, float most) {
  return std::fabs(v.x) <= most && std::fabs(v.y) <= most && std::fabs(v.z) <= most;
}

}  // namespace

SolidPlacement SolidPlacement::of(const format::Solid& solid) {
  const float* m = solid.to_model;
  return {{{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}}, {m[3], m[7], m[11]}};
}

Vec3 SolidPlacement::normal(Vec3 own) const {
  // The transposed inverse but for the determinant's size: normals do not stretch as places do.
  const Vec3 n = cross(column[1], column[2]) * own.x + cross(column[2], column[0]) * own.y +
                 cross(column[0], column[1]) * own.z;
  return normalized(determinant() < 0 ? n * -1 : n);
}

SolidCorners corners_of(const format::Solid& solid) {
  const SolidPlacement placement = SolidPlacement::of(solid);
  const Vec3 half = half_extent(solid.kind, solid.size);
  SolidCorners corners;
  for (unsigned i = 0; i < 8; ++i)
    corners.of[i] = placement.point({(i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                                     (i & 4) != 0 ? half.z : -half.z});
  return corners;
}

bool has_sound_sizes(const format::Solid& solid) {
  const std::uint32_t count = format::kSolidSizeCount[static_cast<std::uint32_t>(solid.kind)];
  for (std::uint32_t i = 0; i < format::kMaxSolidSizes; ++i) {
    const float size = solid.size[i];
    if (i < count ? !(size >= format::kLeastSolidSize && size <= kMaxCoordinate) : size != 0) return false;
  }
  return true;
}

bool is_placed_soundly(const format::Solid& solid) {
  for (const float m : solid.to_model)
    if (!(std::fabs(m) <= kMaxCoordinate)) return false;
  for (const Vec3 corner : corners_of(solid).of)
    if (!is_within(corner, kMaxCoordinate)) return false;
  const SolidPlacement placement = SolidPlacement::of(solid);
  // Of unit length, so that neither a very small nor a very large solid falls out of single precision.
  constexpr float kFlat = 1e-4f;
  Vec3 axes[3];
  for (int i = 0; i < 3; ++i) {
    const float l = length(placement.column[i]);
    if (!(l >= format::kLeastSolidSize) || !std::isfinite(l)) return false;
    axes[i] = placement.column[i] * (1.0f / l);
  }
  return std::fabs(dot(axes[0], cross(axes[1], axes[2]))) >= kFlat;
}

}  // namespace usuzumi::firmware
