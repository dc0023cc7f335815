// The quadric error metric of Garland & Heckbert, "Surface Simplification Using Quadric Error Metrics" (SIGGRAPH 1997),
// in single precision.
//
// A quadric is the weighted sum of squared distances to a set of planes, Q(x) = x'Ax + 2 b'x + c. Here x is RELATIVE TO
// THE VERTEX that owns the quadric, not to the model's origin. Far from the origin b and c would be differences of large
// numbers; near their own vertex they are the small numbers themselves, so that singles are enough where an absolute
// frame needs doubles. What is left is the rounding of A: distances below about 2.5e-4 of an edge's length are noise.
#pragma once

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

/// Q(x). Rounding can take it a little below zero.
inline float evaluate(const Quadric& q, Vec3 x) { return dot(x, multiply(q, x) + q.b * 2.0f) + q.c; }

/// Adds a plane through the owner: `weighted_normal` n' = n * s and `scale` = weight / s^2, so that A gains weight * n n'.
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

/// q + r, where r's owner lies at `offset` in q's frame; the sum is in q's frame.
inline Quadric sum_with_neighbour(const Quadric& q, const Quadric& r, Vec3 offset) {
  const Vec3 t = multiply(r, offset);
  const Vec3 b = r.b - t;
  return {q.xx + r.xx, q.xy + r.xy, q.xz + r.xz, q.yy + r.yy, q.yz + r.yz, q.zz + r.zz,
          q.b + b,     q.c + (r.c - dot(offset, r.b + b))};
}

/// A + pull I = L D L' (A is positive semidefinite: no pivoting needed), to solve for places where Q is least.
class PulledSystem {
 public:
  /// `pull` > 0 has the units of A. usable() is false where a pivot is not above zero: A is zero, or not finite.
  PulledSystem(const Quadric& q, float pull) : pull_(pull) {
    const float d0 = q.xx + pull;
    r0_ = 1.0f / d0;
    l10_ = q.xy * r0_;
    l20_ = q.xz * r0_;
    const float d1 = (q.yy + pull) - l10_ * q.xy;
    const float e21 = q.yz - l10_ * q.xz;
    r1_ = 1.0f / d1;
    l21_ = e21 * r1_;
    const float d2 = ((q.zz + pull) - l20_ * q.xz) - l21_ * e21;
    r2_ = 1.0f / d2;
    usable_ = d0 > 0 && d1 > 0 && d2 > 0 && r0_ > 0 && r1_ > 0 && r2_ > 0;
  }

  bool usable() const { return usable_; }

  /// Where Q(x) + pull |x - towards|^2 is least.
  Vec3 minimum(const Quadric& q, Vec3 towards) const {
    const float y0 = pull_ * towards.x - q.b.x;
    const float y1 = (pull_ * towards.y - q.b.y) - l10_ * y0;
    const float y2 = ((pull_ * towards.z - q.b.z) - l20_ * y0) - l21_ * y1;
    const float z = y2 * r2_;
    const float y = y1 * r1_ - l21_ * z;
    return {(y0 * r0_ - l10_ * y) - l20_ * z, y, z};
  }

 private:
  float pull_, r0_, r1_, r2_, l10_, l20_, l21_;
  bool usable_;
};

}  // namespace usuzumi::firmware
