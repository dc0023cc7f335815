// What the collapse of one edge would cost, and where its vertex would go.
#pragma once

#include <cstdint>

#include "firmware/simplify/quadric.h"
#include "firmware/simplify/simplify.h"
#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

// In a flat or straight neighbourhood the quadric is least along a whole plane or line, and rounding would choose the
// place. A faint pull towards the edge's middle chooses instead; its strength relative to the quadric's weight. Solving
// once more with the pull towards the first solution takes it out again where the quadric does have a minimum (iterated
// Tikhonov regularisation). Chosen by measuring.
inline constexpr float kPull = 1e-3f;

// A minimum further from the edge's middle than this many edge lengths (squared) is not believed: there the quadric is
// nearly flat, and the planes it sums are not those the vertex would move among. Arbitrary; the flip test would refuse
// most such places anyway.
inline constexpr float kFarthestMinimumSquared = 4.0f;

struct EdgeCost {
  Quadric quadric;  // of both ends together, relative to the first end
  Vec3 offset;      // of the new vertex from the first end
  float cost = 0;   // the quadric there, at least 0
};

inline float at_least_zero(float x) { return x > 0 ? x : 0.0f; }

/// The edge from `a` to `b`. Where the quadric has no trustworthy minimum: the best of both ends and the middle, the
/// middle on a tie.
inline EdgeCost cost_edge(const Surface& surface, std::uint32_t a, std::uint32_t b, Placement placement) {
  const Vec3 edge = surface.position(b) - surface.position(a);
  const Vec3 middle = edge * 0.5f;
  EdgeCost result;
  result.quadric = sum_with_neighbour(surface.vertices[a].quadric, surface.vertices[b].quadric, edge);
  const Quadric& q = result.quadric;
  if (placement == Placement::kOptimal) {
    const PulledSystem system(q, kPull * weight_of(q));
    if (system.usable()) {
      const Vec3 minimum = system.minimum(q, system.minimum(q, middle));
      const Vec3 away = minimum - middle;
      if (dot(away, away) <= kFarthestMinimumSquared * dot(edge, edge)) {
        result.offset = minimum;
        result.cost = at_least_zero(evaluate(q, minimum));
        return result;
      }
    }
    const float cost_a = at_least_zero(q.c);
    const float cost_b = at_least_zero(evaluate(q, edge));
    const float cost_middle = at_least_zero(evaluate(q, middle));
    if (cost_a < cost_middle && cost_a <= cost_b) {
      result.offset = {0, 0, 0};
      result.cost = cost_a;
      return result;
    }
    if (cost_b < cost_middle) {
      result.offset = edge;
      result.cost = cost_b;
      return result;
    }
  }
  result.offset = middle;
  result.cost = at_least_zero(evaluate(q, middle));
  return result;
}

}  // namespace usuzumi::firmware
