#include "firmware/simplify/qem/edge_cost.h"

#include <cstring>

#include "firmware/simplify/qem/edge_minimum.h"

namespace usuzumi::firmware {
namespace {

// A minimum further from the edge's middle than this many edge lengths (squared) is not believed: there the quadric is
// nearly flat, and the planes it sums are not those the vertex would move among. Arbitrary; the turning test would
// refuse most such places anyway.
constexpr float kFarthestMinimumSquared = 4.0f;

Quadric quadric_of(const QuadricOf<float>& q) {
  return {q.xx, q.xy, q.xz, q.yy, q.yz, q.zz, {q.b.x, q.b.y, q.b.z}, q.c};
}

// 32-bit NEON takes denormal numbers for zero; the scalar unit beside it does not.
#if defined(__ARM_NEON) && !defined(__aarch64__)
constexpr bool kFourAtOnce = false;
#else
constexpr bool kFourAtOnce = true;
#endif

// Of one edge: not 0 where its minimum is believed. Of four: -1 there, 0 elsewhere, lane by lane.
template <class F>
[[gnu::always_inline]] inline auto believable(const EdgeMinimum<F>& m) {
  return (m.system.d0 > 0) & (m.system.d1 > 0) & (m.system.d2 > 0) &
         (m.far_squared <= kFarthestMinimumSquared * m.edge_squared);
}

void use_middle(EdgeCost& result, Vec3 edge) {
  result.offset = edge * 0.5f;
  result.cost = at_least_zero(evaluate(result.quadric, result.offset));
}

void use_best_of_ends_and_middle(EdgeCost& result, Vec3 edge) {
  const float cost_a = at_least_zero(result.quadric.c);
  const float cost_b = at_least_zero(evaluate(result.quadric, edge));
  use_middle(result, edge);
  if (cost_a < result.cost && cost_a <= cost_b) {
    result.offset = {0, 0, 0};
    result.cost = cost_a;
  } else if (cost_b < result.cost) {
    result.offset = edge;
    result.cost = cost_b;
  }
}

// Puts one value per lane side by side.
template <class Get>
[[gnu::always_inline]] inline Float4 gather(Get get) {
  return Float4{get(0), get(1), get(2), get(3)};
}

[[gnu::always_inline]] inline QuadricOf<Float4> gather_quadrics(const Quadric* const* q) {
  return {gather([&](int i) { return q[i]->xx; }),
          gather([&](int i) { return q[i]->xy; }),
          gather([&](int i) { return q[i]->xz; }),
          gather([&](int i) { return q[i]->yy; }),
          gather([&](int i) { return q[i]->yz; }),
          gather([&](int i) { return q[i]->zz; }),
          {gather([&](int i) { return q[i]->b.x; }), gather([&](int i) { return q[i]->b.y; }),
           gather([&](int i) { return q[i]->b.z; })},
          gather([&](int i) { return q[i]->c; })};
}

[[gnu::always_inline]] inline EdgeCost cost_of(EdgeMinimum<float>& m, Vec3 edge, Placement placement) {
  const Vec3Of<float> e = {edge.x, edge.y, edge.z};
  EdgeCost result;
  result.quadric = quadric_of(m.sum);
  if (placement == Placement::kMidpoint) {
    use_middle(result, edge);
    return result;
  }
  minimise(e, m);
  if (believable(m) != 0) {
    result.offset = {m.offset.x, m.offset.y, m.offset.z};
    result.cost = at_least_zero(m.cost);
    result.system = m.system;
    result.has_minimum = true;
  } else {
    use_best_of_ends_and_middle(result, edge);
  }
  return result;
}

}  // namespace

EdgeCost cost_edge(const Surface& surface, std::uint32_t a, std::uint32_t b, Placement placement) {
  const Vec3 edge = surface.position(b) - surface.position(a);
  EdgeMinimum<float> m;
  sum_quadrics(lanes_of(surface.vertices[a].quadric), lanes_of(surface.vertices[b].quadric),
               Vec3Of<float>{edge.x, edge.y, edge.z}, m.sum);
  return cost_of(m, edge, placement);
}

EdgeCost cost_of_sum(const QuadricOf<float>& sum, Vec3 edge, Placement placement) {
  EdgeMinimum<float> m;
  m.sum = sum;
  return cost_of(m, edge, placement);
}

Vec3 refined_offset(const EdgeCost& cost) {
  if (!cost.has_minimum) return cost.offset;
  const Vec3Of<float> refined =
      solve(lanes_of(cost.quadric), cost.system, {cost.offset.x, cost.offset.y, cost.offset.z});
  return {refined.x, refined.y, refined.z};
}

void cost_edges(const Surface& surface, std::span<const Corner> edges, Placement placement, float* costs) {
  const auto cost_one = [&](Corner edge) {
    return cost_edge(surface, surface.vertex_at(edge), surface.vertex_at(next_in_face(edge)), placement).cost;
  };
  std::size_t first = 0;
  if (kFourAtOnce && placement == Placement::kOptimal) {
    for (; first + 4 <= edges.size(); first += 4) {
      const Quadric *qa[4], *qb[4];
      Vec3 sides[4];
      for (std::size_t i = 0; i < 4; ++i) {
        const std::uint32_t a = surface.vertex_at(edges[first + i]),
                            b = surface.vertex_at(next_in_face(edges[first + i]));
        qa[i] = &surface.vertices[a].quadric;
        qb[i] = &surface.vertices[b].quadric;
        sides[i] = surface.position(b) - surface.position(a);
      }
      const Vec3Of<Float4> e = {gather([&](int i) { return sides[i].x; }), gather([&](int i) { return sides[i].y; }),
                                gather([&](int i) { return sides[i].z; })};
      EdgeMinimum<Float4> m;
      sum_quadrics(gather_quadrics(qa), gather_quadrics(qb), e, m.sum);
      minimise(e, m);
      const auto believed = believable(m);
      const Float4 least = m.cost > 0 ? m.cost : Float4{};
      std::memcpy(costs + first, &least, sizeof least);
      if ((believed[0] & believed[1] & believed[2] & believed[3]) != 0) [[likely]] continue;
      for (std::size_t i = 0; i < 4; ++i)
        if (believed[i] == 0) costs[first + i] = cost_one(edges[first + i]);
    }
  }
  for (; first < edges.size(); ++first) costs[first] = cost_one(edges[first]);
}

}  // namespace usuzumi::firmware
