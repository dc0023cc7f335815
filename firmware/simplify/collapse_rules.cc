#include "firmware/simplify/collapse_rules.h"

namespace usuzumi::firmware {
namespace {

// Vertex::mark here: faces shared with a (bits 0-3), with b (4-7), is an apex (8), number of the trial (10-31).
constexpr std::uint32_t kOneOfA = 1u << 0;
constexpr std::uint32_t kOneOfB = 1u << 4;
constexpr std::uint32_t kCountMask = 15;
constexpr std::uint32_t kApex = 1u << 8;
constexpr std::uint32_t kEpochShift = 10;
constexpr std::uint32_t kLastEpoch = (1u << (32 - kEpochShift)) - 1;

constexpr std::uint32_t count_a(std::uint32_t mark) { return mark & kCountMask; }
constexpr std::uint32_t count_b(std::uint32_t mark) { return (mark >> 4) & kCountMask; }

// A face may turn by at most acos(0.2), about 78 degrees, in one collapse. Arbitrary.
constexpr float kLeastCosineSquared = 0.2f * 0.2f;
// Squared ratio of twice a face's area to the square of its longest side, below which it is a sliver: the height is less
// than 1/100 of that side. A face may become one only where it was no better before. Arbitrary.
constexpr float kSliverSquared = 1e-4f;

float longest_side_squared(Vec3 u, Vec3 v) {
  const Vec3 w = v - u;
  const float uu = dot(u, u), vv = dot(v, v), ww = dot(w, w);
  const float larger = uu > vv ? uu : vv;
  return larger > ww ? larger : ww;
}

// Neighbours of one end, each once, and those reached by exactly two faces.
struct EdgeCounts {
  std::uint32_t edges = 0;
  std::uint32_t regular = 0;
  void met(std::uint32_t times) {
    if (times == 1) ++edges;
    else if (times == 2) ++regular;
    else if (times == 3) --regular;
  }
  bool has_singular() const { return edges != regular; }
};

}  // namespace

void CollapseRules::start_marks() {
  if (epoch_ == kLastEpoch) {
    for (std::uint32_t v = 0; v < surface_.vertex_count; ++v) surface_.vertices[v].mark = 0;
    epoch_ = 0;
  }
  ++epoch_;
}

bool CollapseRules::keeps_topology(Neighbourhood& n) {
  start_marks();
  const Surface& s = surface_;
  Vertex* vertices = surface_.vertices;
  const std::uint32_t fresh = epoch_ << kEpochShift;
  std::uint32_t faces_on_edge = 0;
  std::uint32_t flags = vertices[n.a].first_corner | vertices[n.b].first_corner;

  // Around a: count faces per neighbour, find the apexes.
  EdgeCounts at_a;
  const Vec3 origin = s.positions[n.a];
  n.apex_count = 0;
  std::uint32_t faces_of_apex[kMostFacesOnEdge] = {};
  auto count_for_a = [&](std::uint32_t v) {
    std::uint32_t& mark = vertices[v].mark;
    if (mark >> kEpochShift != epoch_) mark = fresh;
    if (count_a(mark) == kCountMask) return false;
    mark += kOneOfA;
    at_a.met(count_a(mark));
    flags |= vertices[v].first_corner;
    return true;
  };
  Vec3 area{0, 0, 0};
  for (Corner c = s.first_corner(n.a); c != kNoCorner; c = s.next_corner_of(c)) {
    const std::uint32_t p = s.vertex_at(next_in_face(c));
    const std::uint32_t q = s.vertex_at(previous_in_face(c));
    if (!count_for_a(p) || !count_for_a(q)) return false;
    area = area + cross(s.positions[p] - origin, s.positions[q] - origin);
    if (p != n.b && q != n.b) continue;
    if (++faces_on_edge > kMostFacesOnEdge) return false;
    const std::uint32_t apex = p == n.b ? q : p;
    std::uint32_t i = 0;
    while (i < n.apex_count && n.apexes[i] != apex) ++i;
    if (i == n.apex_count) n.apexes[n.apex_count++] = apex;
    ++faces_of_apex[i];
  }
  for (std::uint32_t i = 0; i < n.apex_count; ++i) vertices[n.apexes[i]].mark |= kApex;

  // Around b: a common neighbour that is no apex would close a hole or a tunnel.
  EdgeCounts at_b;
  const Vec3 end = s.positions[n.b];
  const Vec3 edge = end - origin;
  bool b_spans_apexes = false;
  auto count_for_b = [&](std::uint32_t v) {
    std::uint32_t& mark = vertices[v].mark;
    if (mark >> kEpochShift != epoch_) mark = fresh;
    if (count_a(mark) > 0 && (mark & kApex) == 0) return false;
    if (count_b(mark) == kCountMask) return false;
    mark += kOneOfB;
    at_b.met(count_b(mark));
    flags |= vertices[v].first_corner;
    return true;
  };
  float swept = 0;
  for (Corner c = s.first_corner(n.b); c != kNoCorner; c = s.next_corner_of(c)) {
    const std::uint32_t p = s.vertex_at(next_in_face(c));
    const std::uint32_t q = s.vertex_at(previous_in_face(c));
    if (!count_for_b(p) || !count_for_b(q)) return false;
    if (p == n.a || q == n.a) continue;
    const Vec3 normal = cross(s.positions[p] - end, s.positions[q] - end);
    area = area + normal;
    swept += dot(normal, edge);
    b_spans_apexes = b_spans_apexes || (vertices[p].mark & vertices[q].mark & kApex) != 0;
  }

  // An inner edge between two borders would pinch the surface.
  if (faces_on_edge == 2 && at_a.has_singular() && at_b.has_singular()) return false;
  // Every apex edge keeps a face, and none gains faces beyond two.
  for (std::uint32_t i = 0; i < n.apex_count; ++i) {
    const std::uint32_t mark = vertices[n.apexes[i]].mark;
    const std::uint32_t from_a = count_a(mark), from_b = count_b(mark);
    const std::uint32_t left = from_a + from_b - 2 * faces_of_apex[i];
    const std::uint32_t most = from_a > from_b ? from_a : from_b;
    if (left == 0 || (left > 2 && left > most)) return false;
  }
  // Faces (a, x, y) and (b, x, y) would fall onto each other.
  if (b_spans_apexes) {
    for (Corner c = s.first_corner(n.a); c != kNoCorner; c = s.next_corner_of(c)) {
      const std::uint32_t p = s.vertex_at(next_in_face(c));
      const std::uint32_t q = s.vertex_at(previous_in_face(c));
      if (p != n.b && q != n.b && (vertices[p].mark & vertices[q].mark & kApex) != 0) return false;
    }
  }
  n.touches_refused = (flags & kTouchesRefused) != 0;
  n.area_normal = area;
  n.swept = swept;
  return true;
}

bool CollapseRules::turns_a_face_at(std::uint32_t v, std::uint32_t other, Vec3 position) const {
  const Surface& s = surface_;
  const Vec3 old_position = s.positions[v];
  for (Corner c = s.first_corner(v); c != kNoCorner; c = s.next_corner_of(c)) {
    const std::uint32_t p = s.vertex_at(next_in_face(c));
    const std::uint32_t q = s.vertex_at(previous_in_face(c));
    if (p == other || q == other) continue;
    const Vec3 u0 = s.positions[p] - old_position, v0 = s.positions[q] - old_position;
    const Vec3 u1 = s.positions[p] - position, v1 = s.positions[q] - position;
    const Vec3 before = cross(u0, v0);
    const Vec3 after = cross(u1, v1);
    const float squared_before = dot(before, before);
    const float squared_after = dot(after, after);
    const float along = dot(before, after);
    // A face that had no area has no side to be turned to.
    if (squared_before > 0 && !(along > 0 && along * along > kLeastCosineSquared * squared_before * squared_after)) return true;
    const float side_after = longest_side_squared(u1, v1);
    const float limit = kSliverSquared * side_after * side_after;
    if (squared_after < limit) {
      const float side_before = longest_side_squared(u0, v0);
      if (squared_after * (side_before * side_before) < squared_before * (side_after * side_after)) return true;
    }
  }
  return false;
}

bool CollapseRules::turns_a_face(const Neighbourhood& n, Vec3 position) const {
  return turns_a_face_at(n.a, n.b, position) || turns_a_face_at(n.b, n.a, position);
}

}  // namespace usuzumi::firmware
