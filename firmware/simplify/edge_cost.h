// What the collapse of one edge would cost, and where its vertex would go.
#pragma once

#include <cstdint>

#include "firmware/simplify/quadric.h"
#include "firmware/simplify/simplify.h"
#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

// A pivot below this part of the weight is rounding noise of single precision (about 2^-20), not shape.
inline constexpr float kLeastPivot = 1e-6f;

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

/// The edge from `a` to `b`. Where the quadric has no trustworthy minimum: the best of both ends and the middle.
inline EdgeCost cost_edge(const Surface& surface, std::uint32_t a, std::uint32_t b, Placement placement) {
  const Vec3 edge = surface.positions[b] - surface.positions[a];
  const Vec3 middle = edge * 0.5f;
  EdgeCost result;
  result.quadric = sum_with_neighbour(surface.vertices[a].quadric, surface.vertices[b].quadric, edge);
  const Quadric& q = result.quadric;
  if (placement == Placement::kOptimal) {
    Vec3 minimum;
    if (minimise(q, kLeastPivot, minimum)) {
      const Vec3 away = minimum - middle;
      if (dot(away, away) <= kFarthestMinimumSquared * dot(edge, edge)) {
        result.offset = minimum;
        result.cost = at_least_zero(q.c + dot(q.b, minimum));
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
