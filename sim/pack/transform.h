// Node transforms in double precision, applied to meshes once and for all: the device knows no nodes.
#pragma once

#include <cmath>

#include "hal/vec.h"
#include "sim/pack/model.h"

namespace usuzumi::sim {

/// An affine map: rows of the upper 3x4 of a matrix that multiplies column vectors.
struct Transform {
  double m[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};

  bool finite() const {
    for (const auto& row : m)
      for (double c : row)
        if (!std::isfinite(c)) return false;
    return true;
  }
  double determinant() const {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  }
};

/// First `b`, then `a`.
Transform operator*(const Transform& a, const Transform& b);
/// Translation after rotation (quaternion x y z w, made unit; no rotation where it is zero) after scale, as glTF has
/// it.
Transform from_parts(const double translation[3], const double rotation[4], const double scale[3]);

/// Moves `mesh` by `t`: positions by the map, normals by its inverse transpose; a mirroring map (negative determinant)
/// turns the winding round, so that outside stays outside. Normals that a flattening map leaves without direction
/// become zero.
void apply(const Transform& t, Mesh& mesh);

}  // namespace usuzumi::sim
