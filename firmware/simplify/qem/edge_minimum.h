// Where the summed quadric of an edge's two ends is least: the arithmetic, for one edge or for four side by side.
//
// One template serves both, so that an edge's cost has the same bits whichever way it was worked out.
#pragma once

#include "firmware/simplify/quadric.h"

namespace usuzumi::firmware {

/// Four singles that a compiler keeps in a vector register where the processor has one.
using Float4 = float __attribute__((vector_size(16)));

template <class F>
struct Vec3Of {
  F x, y, z;
};
template <class F>
inline F dot(const Vec3Of<F>& a, const Vec3Of<F>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class F>
struct QuadricOf {
  F xx, xy, xz, yy, yz, zz;
  Vec3Of<F> b;
  F c;
};

// In a flat or straight neighbourhood the quadric is least along a whole plane or line, and rounding would choose the
// place. A faint pull towards the edge's middle chooses instead; its strength relative to the quadric's weight. Chosen
// by measuring.
inline constexpr float kPull = 3e-4f;

/// A + pull I = L D L' (A is positive semidefinite: no pivoting needed).
template <class F>
struct PulledSystem {
  F pull;
  F d0, d1, d2;     // pivots: not above zero (or not a number) where there is no minimum
  F r0, r1, r2;     // their reciprocals
  F l10, l20, l21;  // L
};

template <class F>
struct EdgeMinimum {
  QuadricOf<F> sum;  // relative to the first end
  PulledSystem<F> system;
  Vec3Of<F> offset;  // from the first end
  F cost;            // sum(offset), before clamping at zero
  F far_squared;     // from the edge's middle
  F edge_squared;
};

template <class F>
inline Vec3Of<F> multiply(const QuadricOf<F>& q, const Vec3Of<F>& x) {
  return {q.xx * x.x + q.xy * x.y + q.xz * x.z, q.xy * x.x + q.yy * x.y + q.yz * x.z,
          q.xz * x.x + q.yz * x.y + q.zz * x.z};
}

/// `b`'s owner lies at `edge` from `a`'s.
template <class F>
[[gnu::always_inline]] inline void sum_quadrics(const QuadricOf<F>& a, const QuadricOf<F>& b, const Vec3Of<F>& edge,
                                                QuadricOf<F>& sum) {
  const Vec3Of<F> t = multiply(b, edge);
  const Vec3Of<F> moved = {b.b.x - t.x, b.b.y - t.y, b.b.z - t.z};
  const Vec3Of<F> both = {b.b.x + moved.x, b.b.y + moved.y, b.b.z + moved.z};
  sum.xx = a.xx + b.xx;
  sum.xy = a.xy + b.xy;
  sum.xz = a.xz + b.xz;
  sum.yy = a.yy + b.yy;
  sum.yz = a.yz + b.yz;
  sum.zz = a.zz + b.zz;
  sum.b = {a.b.x + moved.x, a.b.y + moved.y, a.b.z + moved.z};
  sum.c = a.c + (b.c - dot(edge, both));
}

template <class F>
[[gnu::always_inline]] inline void factorise(const QuadricOf<F>& q, PulledSystem<F>& s) {
  s.pull = (q.xx + q.yy + q.zz) * kPull;
  s.d0 = q.xx + s.pull;
  s.r0 = 1.0f / s.d0;
  s.l10 = q.xy * s.r0;
  s.l20 = q.xz * s.r0;
  s.d1 = (q.yy + s.pull) - s.l10 * q.xy;
  const F e21 = q.yz - s.l10 * q.xz;
  s.r1 = 1.0f / s.d1;
  s.l21 = e21 * s.r1;
  s.d2 = ((q.zz + s.pull) - s.l20 * q.xz) - s.l21 * e21;
  s.r2 = 1.0f / s.d2;
}

/// Where q(x) + pull |x - towards|^2 is least.
template <class F>
[[gnu::always_inline]] inline Vec3Of<F> solve(const QuadricOf<F>& q, const PulledSystem<F>& s,
                                              const Vec3Of<F>& towards) {
  const F y0 = s.pull * towards.x - q.b.x;
  const F y1 = (s.pull * towards.y - q.b.y) - s.l10 * y0;
  const F y2 = ((s.pull * towards.z - q.b.z) - s.l20 * y0) - s.l21 * y1;
  const F z = y2 * s.r2;
  const F y = y1 * s.r1 - s.l21 * z;
  return {(y0 * s.r0 - s.l10 * y) - s.l20 * z, y, z};
}

/// The minimum under the pull towards the edge's middle, and its cost: there A x = pull (m - x) - b, which saves a
/// multiplication in q(x) = c + x . (A x + 2 b).
template <class F>
[[gnu::always_inline]] inline void minimise(const Vec3Of<F>& edge, EdgeMinimum<F>& r) {
  const QuadricOf<F>& q = r.sum;
  factorise(q, r.system);
  const Vec3Of<F> middle = {edge.x * 0.5f, edge.y * 0.5f, edge.z * 0.5f};
  const Vec3Of<F> x = solve(q, r.system, middle);
  const Vec3Of<F> back = {middle.x - x.x, middle.y - x.y, middle.z - x.z};
  const Vec3Of<F> slope = {q.b.x + r.system.pull * back.x, q.b.y + r.system.pull * back.y,
                           q.b.z + r.system.pull * back.z};
  r.offset = x;
  r.cost = q.c + dot(x, slope);
  r.far_squared = dot(back, back);
  r.edge_squared = dot(edge, edge);
}

}  // namespace usuzumi::firmware
