#include "firmware/simplify/half_edge/half_edge_cost.h"

namespace usuzumi::firmware {
namespace {

float at_least_zero(float x) { return x > 0 ? x : 0.0f; }

}  // namespace

void HalfEdgeCosts::start() {
  const Surface& s = *surface_;
  Vec3 low, high;
  find_extent(s, [&](std::uint32_t v) { return s.position(v); }, low, high);
  max_dist_ = 2 * dot(high - low, high - low);
  for (std::uint32_t v = 0; v < s.vertex_count; ++v) areas_[v] = 0;
  for (std::uint32_t face = 0; face < s.face_count; ++face) {
    if (s.is_dead(face)) continue;
    const std::uint32_t a = s.vertex_at(face * 4), b = s.vertex_at(face * 4 + 1), c = s.vertex_at(face * 4 + 2);
    const Vec3 p = s.position(a);
    const float area = 0.5f * length(cross(s.position(b) - p, s.position(c) - p));
    areas_[a] += area;
    areas_[b] += area;
    areas_[c] += area;
  }
}

// Quadrics are relative to their vertices: Qs(vt) is Qs at the edge's vector, Qt(vt) its constant.
[[gnu::always_inline]] inline HalfEdgeCosts::BothWays HalfEdgeCosts::both_ways(Corner edge) const {
  const Surface& s = *surface_;
  const std::uint32_t a = s.vertex_at(edge), b = s.vertex_at(next_in_face(edge));
  const Vec3 e = s.position(b) - s.position(a);
  const Quadric& qa = s.vertices[a].quadric;
  const Quadric& qb = s.vertices[b].quadric;
  return {a, b, at_least_zero(evaluate(qa, e) + qb.c), at_least_zero(evaluate(qb, e * -1.0f) + qa.c)};
}

HalfEdge HalfEdgeCosts::cheapest(Corner edge, std::uint32_t refused) const {
  const BothWays ways = both_ways(edge);
  if (refused != 0 || seams_->touches(ways.a, ways.b)) return cheapest_at_seam(ways, edge, refused);
  const bool forward = ways.forward <= ways.backward;
  const float dist = forward ? ways.forward : ways.backward;
  return {edge_key(dist, edge), forward ? ways.a : ways.b, forward ? ways.b : ways.a, dist, forward};
}

EdgeKey HalfEdgeCosts::least_key(Corner edge, std::uint32_t refused) const {
  const BothWays ways = both_ways(edge);
  if (refused != 0 || seams_->touches(ways.a, ways.b)) [[unlikely]] return cheapest_at_seam(ways, edge, refused).key;
  return edge_key(ways.forward <= ways.backward ? ways.forward : ways.backward, edge);
}

HalfEdge HalfEdgeCosts::cheapest_at_seam(const BothWays& ways, Corner edge, std::uint32_t refused) const {
  HalfEdge forward{.from = ways.a, .to = ways.b, .dist = ways.forward, .forward = true};
  HalfEdge backward{.from = ways.b, .to = ways.a, .dist = ways.backward};
  const Seams::Edge seam = seams_->look_at_edge(ways.a, ways.b);
  for (HalfEdge* way : {&forward, &backward}) {
    if ((refused & (way->forward ? kForwardRefused : kBackwardRefused)) != 0) continue;
    const SeamRelation r = seams_->relation(way->from, way->to, seam);
    if (r.leaves_border) continue;
    way->key = edge_key(half_edge_cost(way->dist, alpha(way->from, way->to), r), edge);
    if (r.is_penalised()) way->key |= kPenalised;
  }
  return forward.key <= backward.key ? forward : backward;
}

}  // namespace usuzumi::firmware
