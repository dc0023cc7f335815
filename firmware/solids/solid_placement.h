// Where a solid stands in the model.
#pragma once

#include "firmware/solids/solid_format.h"
#include "hal/vec.h"

namespace usuzumi::firmware {

struct SolidPlacement {
  Vec3 column[3];  // where the solid's axes go
  Vec3 origin;

  static SolidPlacement of(const format::Solid& solid);
  Vec3 direction(Vec3 own) const { return column[0] * own.x + column[1] * own.y + column[2] * own.z; }
  Vec3 point(Vec3 own) const { return direction(own) + origin; }
  /// Unit length, of a surface's normal; outward although the placement mirrors.
  Vec3 normal(Vec3 own) const;
  /// Below 0 where it mirrors.
  float determinant() const { return dot(column[0], cross(column[1], column[2])); }
};

/// The box around the solid, placed.
struct SolidCorners {
  Vec3 of[8];
};
SolidCorners corners_of(const format::Solid& solid);

/// Whether the sizes are those of its kind, each from kLeastSolidSize to kMaxCoordinate, and the others 0.
bool has_sound_sizes(const format::Solid& solid);

/// Whether the solid, whose sizes are sound, is placed within kMaxCoordinate, neither flattened nor stretched to less
/// than kLeastSolidSize.
bool is_placed_soundly(const format::Solid& solid);

}  // namespace usuzumi::firmware
