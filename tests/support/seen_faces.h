// Faces as they are seen, whatever the numbers of their vertices and in whatever order: for comparing meshes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <set>

#include "hal/vec.h"

namespace usuzumi::testing {

/// Bits of a corner's place and attributes.
using SeenCorner = std::array<std::uint32_t, 7>;
using SeenFaceSet = std::multiset<std::array<SeenCorner, 3>>;

inline SeenCorner corner_of(Vec3 p, PackedNormal n, Rgba8 c, TexCoord t) {
  SeenCorner corner{};
  p = p + Vec3{};  // -0 is 0
  std::memcpy(&corner[0], &p, 12);
  corner[3] = n.bits;
  corner[4] = c.bits;
  std::memcpy(&corner[5], &t, 8);
  return corner;
}

/// Begins the face at its least corner: its winding stays.
inline void add_face(SeenFaceSet& faces, std::array<SeenCorner, 3> face) {
  std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  faces.insert(face);
}

}  // namespace usuzumi::testing
