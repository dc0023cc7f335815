// The quadric error metric of Garland & Heckbert, "Surface Simplification Using Quadric Error Metrics" (SIGGRAPH 1997),
// in single precision.
//
// A quadric is the weighted sum of squared distances to a set of planes, Q(x) = x'Ax + 2 b'x + c. Here x is RELATIVE TO
// THE VERTEX that owns the quadric, not to the model's origin. Far from the origin b and c would be differences of
// large numbers; near their own vertex they are the small numbers themselves, so that singles are enough where an
// absolute frame needs doubles. What is left is the rounding of A: distances below about 2.5e-4 of an edge's length are
// noise.
#pragma once

#include <cmath>

#include "hal/vec.h"

namespace usuzumi::firmware {

struct Quadric {
  float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  // A, symmetric; units: weight
  Vec3 b;                                                // weight * length
  float c = 0;                                           // weight * length^2; Q at the owner itself
};
static_assert(sizeof(Quadric) == 40);

inline Vec3 multiply(const Quadric& q, Vec3 x) {
  return {q.xx * x.x + q.xy * x.y + q.xz * x.z, q.xy * x.x + q.yy * x.y + q.yz * x.z,
          q.xz * x.x + q.yz * x.y + q.zz * x.z};
}

/// Summed weight of the planes: their unit normals make the trace.
inline float weight_of(const Quadric& q) { return q.xx + q.yy + q.zz; }

/// Root mean square distance of the owner from the planes; 0 where there are none.
inline float distance_of(const Quadric& q) {
  const float weight = weight_of(q);
  return weight > 0 ? std::sqrt(q.c / weight) : 0.0f;
}

/// Q(x). Rounding can take it a little below zero.
inline float evaluate(const Quadric& q, Vec3 x) { return dot(x, multiply(q, x) + q.b * 2.0f) + q.c; }

/// Adds a plane through the owner: `weighted_normal` n' = n * s and `scale` = weight / s^2, so that A gains weight * n
/// n'.
inline void add_plane_through_owner(Quadric& q, Vec3 weighted_normal, float scale) {
  const Vec3 s = weighted_normal * scale;
  q.xx += s.x * weighted_normal.x;
  q.xy += s.x * weighted_normal.y;
  q.xz += s.x * weighted_normal.z;
  q.yy += s.y * weighted_normal.y;
  q.yz += s.y * weighted_normal.z;
  q.zz += s.z * weighted_normal.z;
}

/// The same quadric about an owner that lies at `to` in the old frame.
inline Quadric moved_to(const Quadric& q, Vec3 to) {
  const Vec3 t = multiply(q, to);
  Quadric r = q;
  r.b = q.b + t;
  r.c = q.c + dot(to, q.b + r.b);
  return r;
}

/// Of two quadrics about one owner.
inline Quadric operator+(const Quadric& p, const Quadric& q) {
  return {p.xx + q.xx, p.xy + q.xy, p.xz + q.xz, p.yy + q.yy, p.yz + q.yz, p.zz + q.zz, p.b + q.b, p.c + q.c};
}

}  // namespace usuzumi::firmware
