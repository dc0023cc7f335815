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
// place. A faint pull towards the edge's middle chooses instead; its strength relative to the quadric's weight. Solving
// once more with the pull towards the first solution takes it out again where the quadric does have a minimum (iterated
// Tikhonov regularisation). Chosen by measuring.
inline constexpr float kPull = 3e-4f;

template <class F>
struct EdgeMinimum {
  QuadricOf<F> sum;         // relative to the first end
  Vec3Of<F> offset;         // from the first end
  F cost;                   // sum(offset), before clamping at zero
  F far_squared;            // from the edge's middle
  F edge_squared;
  F d0, d1, d2;             // pivots: not above zero (or not a number) where there is no minimum
};

template <class F>
inline Vec3Of<F> multiply(const QuadricOf<F>& q, const Vec3Of<F>& x) {
  return {q.xx * x.x + q.xy * x.y + q.xz * x.z, q.xy * x.x + q.yy * x.y + q.yz * x.z,
          q.xz * x.x + q.yz * x.y + q.zz * x.z};
}

/// `b`'s owner lies at `edge` from `a`'s.
template <class F>
inline void sum_quadrics(const QuadricOf<F>& a, const QuadricOf<F>& b, const Vec3Of<F>& edge, QuadricOf<F>& sum) {
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

/// Solves (A + pull I) x = pull m - b by L D L' (A is positive semidefinite: no pivoting needed), m the edge's middle and
/// then the first solution.
template <class F>
inline void minimise(const Vec3Of<F>& edge, EdgeMinimum<F>& r) {
  const QuadricOf<F>& q = r.sum;
  const F pull = (q.xx + q.yy + q.zz) * kPull;
  const Vec3Of<F> middle = {edge.x * 0.5f, edge.y * 0.5f, edge.z * 0.5f};
  r.d0 = q.xx + pull;
  const F r0 = 1.0f / r.d0;
  const F l10 = q.xy * r0;
  const F l20 = q.xz * r0;
  r.d1 = (q.yy + pull) - l10 * q.xy;
  const F e21 = q.yz - l10 * q.xz;
  const F r1 = 1.0f / r.d1;
  const F l21 = e21 * r1;
  r.d2 = ((q.zz + pull) - l20 * q.xz) - l21 * e21;
  const F r2 = 1.0f / r.d2;
  Vec3Of<F> x = middle;
  for (int pass = 0; pass < 2; ++pass) {
    const F y0 = pull * x.x - q.b.x;
    const F y1 = (pull * x.y - q.b.y) - l10 * y0;
    const F y2 = ((pull * x.z - q.b.z) - l20 * y0) - l21 * y1;
    x.z = y2 * r2;
    x.y = y1 * r1 - l21 * x.z;
    x.x = (y0 * r0 - l10 * x.y) - l20 * x.z;
  }
  r.offset = x;
  const Vec3Of<F> ax = multiply(q, x);
  const Vec3Of<F> slope = {ax.x + q.b.x * 2.0f, ax.y + q.b.y * 2.0f, ax.z + q.b.z * 2.0f};
  r.cost = dot(x, slope) + q.c;
  const Vec3Of<F> away = {x.x - middle.x, x.y - middle.y, x.z - middle.z};
  r.far_squared = dot(away, away);
  r.edge_squared = dot(edge, edge);
}

}  // namespace usuzumi::firmware
