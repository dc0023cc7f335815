// Angles that are the same bits on every processor.
#pragma once

#include "hal/vec.h"

namespace usuzumi::firmware {

/// The angle of the point (x, y), y >= 0, seen from the origin, in [0, pi] radians; 0 for the origin. Absolute error
/// below 3e-6 (tested against the C library): 1.7e-6 of the polynomial and a few roundings.
constexpr float angle_rad(float x, float y) {
  constexpr float kPiSingle = 3.14159265f;
  const float run = x < 0 ? -x : x;
  const bool steep = y > run;
  const float small = steep ? run : y, large = steep ? y : run;
  if (!(large > 0)) return 0;
  // atan(t) on [0, 1]: the odd polynomial of degree 11 whose largest error is least, fitted for this.
  const float t = small / large, s = t * t;
  const float first =
      t * (0.99997722f +
           s * (-0.33262279f + s * (0.19354015f + s * (-0.11642593f + s * (0.05264677f + s * -0.01171892f)))));
  const float acute = steep ? kPiSingle / 2 - first : first;
  return x < 0 ? kPiSingle - acute : acute;
}

/// The angle between two vectors in radians; 0 where either has no length.
inline float angle_between(Vec3 u, Vec3 v) { return angle_rad(dot(u, v), length(cross(u, v))); }

}  // namespace usuzumi::firmware
