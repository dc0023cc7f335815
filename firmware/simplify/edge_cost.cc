#include "firmware/simplify/edge_cost.h"

#include "firmware/simplify/edge_minimum.h"

namespace usuzumi::firmware {
namespace {

// A minimum further from the edge's middle than this many edge lengths (squared) is not believed: there the quadric is
// nearly flat, and the planes it sums are not those the vertex would move among. Arbitrary; the turning test would refuse
// most such places anyway.
constexpr float kFarthestMinimumSquared = 4.0f;

QuadricOf<float> lanes_of(const Quadric& q) { return {q.xx, q.xy, q.xz, q.yy, q.yz, q.zz, {q.b.x, q.b.y, q.b.z}, q.c}; }
Quadric quadric_of(const QuadricOf<float>& q) { return {q.xx, q.xy, q.xz, q.yy, q.yz, q.zz, {q.b.x, q.b.y, q.b.z}, q.c}; }

bool believable(float d0, float d1, float d2, float far_squared, float edge_squared) {
  return d0 > 0 && d1 > 0 && d2 > 0 && far_squared <= kFarthestMinimumSquared * edge_squared;
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

}  // namespace

EdgeCost cost_edge(const Surface& surface, std::uint32_t a, std::uint32_t b, Placement placement) {
  const Vec3 edge = surface.position(b) - surface.position(a);
  const Vec3Of<float> e = {edge.x, edge.y, edge.z};
  EdgeMinimum<float> m;
  sum_quadrics(lanes_of(surface.vertices[a].quadric), lanes_of(surface.vertices[b].quadric), e, m.sum);
  EdgeCost result;
  result.quadric = quadric_of(m.sum);
  if (placement == Placement::kMidpoint) {
    use_middle(result, edge);
    return result;
  }
  minimise(e, m);
  if (believable(m.system.d0, m.system.d1, m.system.d2, m.far_squared, m.edge_squared)) {
    // Solving once more, with the pull towards the first solution, takes the pull out again where the quadric does have a
    // minimum (iterated Tikhonov regularisation): a cube's corners stay. The cost is that of the first solution, which is
    // a little higher.
    const Vec3Of<float> refined = solve(m.sum, m.system, m.offset);
    result.offset = {refined.x, refined.y, refined.z};
    result.cost = at_least_zero(m.cost);
  } else {
    use_best_of_ends_and_middle(result, edge);
  }
  return result;
}

void cost_four_edges(const Surface& surface, const std::uint32_t* a, const std::uint32_t* b, Placement placement, float* costs) {
  if (placement == Placement::kMidpoint) {
    for (int i = 0; i < 4; ++i) costs[i] = cost_edge(surface, a[i], b[i], placement).cost;
    return;
  }
  const Quadric* qa[4];
  const Quadric* qb[4];
  Vec3 edges[4];
  for (int i = 0; i < 4; ++i) {
    qa[i] = &surface.vertices[a[i]].quadric;
    qb[i] = &surface.vertices[b[i]].quadric;
    edges[i] = surface.position(b[i]) - surface.position(a[i]);
  }
  const Vec3Of<Float4> e = {gather([&](int i) { return edges[i].x; }), gather([&](int i) { return edges[i].y; }),
                            gather([&](int i) { return edges[i].z; })};
  EdgeMinimum<Float4> m;
  sum_quadrics(gather_quadrics(qa), gather_quadrics(qb), e, m.sum);
  minimise(e, m);
  for (int i = 0; i < 4; ++i) {
    costs[i] = believable(m.system.d0[i], m.system.d1[i], m.system.d2[i], m.far_squared[i], m.edge_squared[i])
                   ? at_least_zero(m.cost[i])
                   : cost_edge(surface, a[i], b[i], placement).cost;
  }
}

}  // namespace usuzumi::firmware
