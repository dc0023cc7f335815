// What the collapse of one edge would cost, and where its vertex would go.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/simplify/qem/edge_minimum.h"
#include "firmware/simplify/quadric.h"
#include "firmware/simplify/simplify.h"
#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

struct EdgeCost {
  Quadric quadric;  // of both ends together, relative to the first end
  Vec3 offset;      // of the new vertex from the first end; see refined_offset()
  float cost = 0;   // the quadric there, at least 0
  PulledSystem<float> system;
  bool has_minimum = false;
};

inline float at_least_zero(float x) { return x > 0 ? x : 0.0f; }

/// The edge from `a` to `b`. Where the quadric has no trustworthy minimum: the best of both ends and the middle, the
/// middle on a tie.
EdgeCost cost_edge(const Surface& surface, std::uint32_t a, std::uint32_t b, Placement placement);

/// What cost_edge() makes of the sum of both ends' quadrics; `edge` is from the first end to the second.
EdgeCost cost_of_sum(const QuadricOf<float>& sum, Vec3 edge, Placement placement);

inline QuadricOf<float> lanes_of(const Quadric& q) {
  return {q.xx, q.xy, q.xz, q.yy, q.yz, q.zz, {q.b.x, q.b.y, q.b.z}, q.c};
}

/// Solving once more, with the pull towards the first solution, takes the pull out again where the quadric does have a
/// minimum (iterated Tikhonov regularisation): a cube's corners stay. The cost is that of the first solution, which is
/// a little higher; most edges are costed more often than collapsed, and never get here.
Vec3 refined_offset(const EdgeCost& cost);

/// The same costs, bit for bit, of many half-edges' edges. An edge that nothing has changed therefore has the key it
/// was found with when it comes to the front; that every fill gets something done rests on it.
void cost_edges(const Surface& surface, std::span<const Corner> edges, Placement placement, float* costs);

}  // namespace usuzumi::firmware
