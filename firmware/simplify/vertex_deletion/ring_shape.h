// What a ring measures before its vertex is deleted.
#pragma once

#include <cstdint>

#include "firmware/simplify/surface.h"
#include "firmware/simplify/vertex_deletion/ring.h"

namespace usuzumi::firmware {

/// A sector's polygon and faces. Positions are relative to the ring's vertex, in working units.
struct SectorShape {
  std::uint32_t corner_count = 0;
  bool closing_edge = false;
  Vec3 corners[kMostCorners + 1];
  TexCoord texture[kMostCorners + 1];  // where there is texture
  Vec3 facing[kMostRingFaces];         // of the faces, by the corner they begin at
  float area = 0;                      // sum S(P_i)
  float angles = 0;                    // sum theta_i
  Vec3 weighted_normals;               // sum theta_i n_i
  Vec3 mean_normal, mean_direction;    // sum theta_i n_i / sum theta_i, and its direction as a unit vector
  float worst_sliver = 0;              // least sliverness() of the faces
  float texture_side = 0;              // 1 or -1 where all faces lie on the texture that way round, else 0
};

struct RingShape {
  SectorShape sectors[2];  // the second's sums are zero where there is none
  float area = 0;
  Vec3 direction;  // of the mean normal of all faces
};

/// Squared ratio of twice a triangle's area to its longest side's square: small for slivers.
constexpr float sliverness(float squared_double_area, float longest_side_squared) {
  return longest_side_squared > 0 ? squared_double_area / (longest_side_squared * longest_side_squared) : 0.0f;
}

/// Twice the signed area on the texture.
constexpr float texture_area(TexCoord a, TexCoord b, TexCoord c) {
  return (b.s - a.s) * (c.t - a.t) - (c.s - a.s) * (b.t - a.t);
}

/// False where the ring or one of its sides has no area, or a mean normal shorter than 1/1000. `texture_coordinates`
/// may be null.
bool measure_ring(const Surface& surface, const TexCoord* texture_coordinates, const Ring& ring, RingShape& shape);

}  // namespace usuzumi::firmware
