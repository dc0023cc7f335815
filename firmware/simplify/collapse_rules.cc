#include "firmware/simplify/collapse_rules.h"

namespace usuzumi::firmware {
namespace {

// Place::mark here: faces shared with a (bits 0-3), with b (4-7), is an apex (8), number of the trial (10-29).
constexpr std::uint32_t kOneOfA = 1u << 0;
constexpr std::uint32_t kOneOfB = 1u << 4;
constexpr std::uint32_t kCountMask = 15;
constexpr std::uint32_t kApex = 1u << 8;
constexpr std::uint32_t kEpochShift = 10;
constexpr std::uint32_t kEpochMask = ~kPlaceFlags >> kEpochShift << kEpochShift;
constexpr std::uint32_t kLastEpoch = kEpochMask >> kEpochShift;

constexpr std::uint32_t count_a(std::uint32_t mark) { return mark & kCountMask; }
constexpr std::uint32_t count_b(std::uint32_t mark) { return (mark >> 4) & kCountMask; }

// A face may turn by at most acos(0.2), about 78 degrees, in one collapse (arbitrary), and by less than 90 in all:
// turned by 90, the side of a plate would lie on its front and look backwards. How much less is arbitrary, but more
// than the tenth of a degree of a packed normal. A face without area had no side.
constexpr float kLeastCosineSquared = 0.2f * 0.2f;
constexpr float kLeastCosineInAllSquared = 0.02f * 0.02f;
// Squared ratio of twice a face's area to the square of its longest side, below which it is a sliver: the height is
// less than 1/100 of that side. A face may become one only where it was hardly better before: long thin parts (a rod of
// 48 sides) are made of slivers, and every collapse there changes some of them a little. Arbitrary.
constexpr float kSliverSquared = 1e-4f;
constexpr float kSliverWorseSquared = 0.25f;

float larger(float a, float b) { return a > b ? a : b; }

// `facing` is a unit vector, to a tenth of a degree, or nothing where the face had no area.
bool looks_as_in_model(Vec3 facing, Vec3 after, float squared_after) {
  const float along = dot(facing, after);
  return along * (along < 0 ? -along : along) >= kLeastCosineInAllSquared * dot(facing, facing) * squared_after;
}

float longest_side_squared(Vec3 u, Vec3 v) {
  const Vec3 w = v - u;
  return larger(larger(dot(u, u), dot(v, v)), dot(w, w));
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
    for (std::uint32_t v = 0; v < surface_.vertex_count; ++v) surface_.places[v].mark &= kPlaceFlags;
    epoch_ = 0;
  }
  ++epoch_;
}

bool CollapseRules::keeps_topology(Neighbourhood& n) {
  start_marks();
  if (((surface_.places[n.a].mark | surface_.places[n.b].mark) & kSingular) == 0) {
    bool decided = false;
    const bool keeps = keeps_regular_topology(n, decided);
    if (decided) return keeps;
    start_marks();
  }
  return keeps_any_topology(n);
}

// Both ends have only edges of two faces that run opposite ways: then every neighbour comes after the end in exactly
// one face, the edge has two apexes, and they must be the only common neighbours. An end of three faces is left to the
// general rule, which also looks for faces that would fall onto each other.
bool CollapseRules::keeps_regular_topology(Neighbourhood& n, bool& decided) {
  const Surface& s = surface_;
  Place* places = surface_.places;
  const std::uint32_t fresh = epoch_ << kEpochShift;
  const Vec3 origin = s.position(n.a), end = s.position(n.b);
  const Vec3 edge = end - origin;
  std::uint32_t flags = places[n.a].mark | places[n.b].mark;
  std::uint32_t faces_at_a = 0, faces_at_b = 0;
  Vec3 area{0, 0, 0};
  faces_.count = 0;
  n.apex_count = 0;
  for (Corner c = s.first_corner(n.a); c != kNoCorner; c = s.next_corner_of(c)) {
    const std::uint32_t p = s.vertex_at(next_in_face(c));
    const std::uint32_t q = s.vertex_at(previous_in_face(c));
    flags |= places[p].mark;
    places[p].mark = (places[p].mark & kPlaceFlags) | fresh;
    ++faces_at_a;
    const Vec3 pp = places[p].position, qq = places[q].position;
    const Vec3 normal = cross(pp - origin, qq - origin);
    area = area + normal;
    if (p == n.b || q == n.b) {
      if (n.apex_count < 2) n.apexes[n.apex_count++] = p == n.b ? q : p;
    } else {
      faces_.add(pp, qq, normal, s.facing(c));
    }
  }
  std::uint32_t common = 0;
  float swept = 0;
  for (Corner c = s.first_corner(n.b); c != kNoCorner; c = s.next_corner_of(c)) {
    const std::uint32_t p = s.vertex_at(next_in_face(c));
    const std::uint32_t q = s.vertex_at(previous_in_face(c));
    flags |= places[p].mark;
    common += (places[p].mark & kEpochMask) == fresh ? 1u : 0u;
    ++faces_at_b;
    if (p == n.a || q == n.a) continue;
    const Vec3 pp = places[p].position, qq = places[q].position;
    const Vec3 normal = cross(pp - end, qq - end);
    area = area + normal;
    swept += dot(normal, edge);
    faces_.add(pp, qq, normal, s.facing(c));
  }
  decided = faces_at_a > 3 && faces_at_b > 3;
  n.touches_refused = (flags & kTouchesRefused) != 0;
  n.area_normal = area;
  n.swept = swept;
  return common == 2;
}

bool CollapseRules::keeps_any_topology(Neighbourhood& n) {
  const Surface& s = surface_;
  Place* places = surface_.places;
  const std::uint32_t fresh = epoch_ << kEpochShift;
  std::uint32_t faces_on_edge = 0;
  std::uint32_t flags = places[n.a].mark | places[n.b].mark;
  auto refreshed = [&](std::uint32_t v) -> std::uint32_t& {
    std::uint32_t& mark = places[v].mark;
    flags |= mark;
    if ((mark & kEpochMask) != fresh) mark = (mark & kPlaceFlags) | fresh;
    return mark;
  };

  // Around a: count faces per neighbour, find the apexes.
  EdgeCounts at_a;
  const Vec3 origin = s.position(n.a);
  n.apex_count = 0;
  faces_.count = 0;
  std::uint32_t faces_of_apex[kMostFacesOnEdge] = {};
  auto count_for_a = [&](std::uint32_t v) {
    std::uint32_t& mark = refreshed(v);
    if (count_a(mark) == kCountMask) return false;
    mark += kOneOfA;
    at_a.met(count_a(mark));
    return true;
  };
  Vec3 area{0, 0, 0};
  for (Corner c = s.first_corner(n.a); c != kNoCorner; c = s.next_corner_of(c)) {
    const std::uint32_t p = s.vertex_at(next_in_face(c));
    const std::uint32_t q = s.vertex_at(previous_in_face(c));
    if (!count_for_a(p) || !count_for_a(q)) return false;
    const Vec3 pp = s.position(p), qq = s.position(q);
    const Vec3 normal = cross(pp - origin, qq - origin);
    area = area + normal;
    if (p != n.b && q != n.b) {
      faces_.add(pp, qq, normal, s.facing(c));
      continue;
    }
    if (++faces_on_edge > kMostFacesOnEdge) return false;
    const std::uint32_t apex = p == n.b ? q : p;
    std::uint32_t i = 0;
    while (i < n.apex_count && n.apexes[i] != apex) ++i;
    if (i == n.apex_count) n.apexes[n.apex_count++] = apex;
    ++faces_of_apex[i];
  }
  for (std::uint32_t i = 0; i < n.apex_count; ++i) places[n.apexes[i]].mark |= kApex;

  // Around b: a common neighbour that is no apex would close a hole or a tunnel.
  EdgeCounts at_b;
  const Vec3 end = s.position(n.b);
  const Vec3 edge = end - origin;
  bool b_spans_apexes = false;
  auto count_for_b = [&](std::uint32_t v) {
    std::uint32_t& mark = refreshed(v);
    if (count_a(mark) > 0 && (mark & kApex) == 0) return false;
    if (count_b(mark) == kCountMask) return false;
    mark += kOneOfB;
    at_b.met(count_b(mark));
    return true;
  };
  float swept = 0;
  for (Corner c = s.first_corner(n.b); c != kNoCorner; c = s.next_corner_of(c)) {
    const std::uint32_t p = s.vertex_at(next_in_face(c));
    const std::uint32_t q = s.vertex_at(previous_in_face(c));
    if (!count_for_b(p) || !count_for_b(q)) return false;
    if (p == n.a || q == n.a) continue;
    const Vec3 pp = s.position(p), qq = s.position(q);
    const Vec3 normal = cross(pp - end, qq - end);
    area = area + normal;
    swept += dot(normal, edge);
    faces_.add(pp, qq, normal, s.facing(c));
    b_spans_apexes = b_spans_apexes || (places[p].mark & places[q].mark & kApex) != 0;
  }

  // An inner edge between two borders would pinch the surface.
  if (faces_on_edge == 2 && at_a.has_singular() && at_b.has_singular()) return false;
  // Every apex edge keeps a face, and none gains faces beyond two.
  for (std::uint32_t i = 0; i < n.apex_count; ++i) {
    const std::uint32_t mark = places[n.apexes[i]].mark;
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
      if (p != n.b && q != n.b && (places[p].mark & places[q].mark & kApex) != 0) return false;
    }
  }
  n.touches_refused = (flags & kTouchesRefused) != 0;
  n.area_normal = area;
  n.swept = swept;
  return true;
}

bool CollapseRules::turns_a_face_at(std::uint32_t v, std::uint32_t other, Vec3 position) const {
  const Surface& s = surface_;
  const Vec3 old_position = s.position(v);
  for (Corner c = s.first_corner(v); c != kNoCorner; c = s.next_corner_of(c)) {
    const std::uint32_t p = s.vertex_at(next_in_face(c));
    const std::uint32_t q = s.vertex_at(previous_in_face(c));
    if (p == other || q == other) continue;
    const Vec3 u0 = s.position(p) - old_position, v0 = s.position(q) - old_position;
    const Vec3 u1 = s.position(p) - position, v1 = s.position(q) - position;
    const Vec3 before = cross(u0, v0);
    const Vec3 after = cross(u1, v1);
    const float squared_before = dot(before, before);
    const float squared_after = dot(after, after);
    const float along = dot(before, after);
    if (!looks_as_in_model(unpack(s.facing(c)), after, squared_after)) return true;
    // A face that had no area has no side to be turned to.
    if (squared_before > 0 && !(along > 0 && along * along > kLeastCosineSquared * squared_before * squared_after))
      return true;
    const float side_after = longest_side_squared(u1, v1);
    if (squared_after < kSliverSquared * side_after * side_after) {
      const float side_before = longest_side_squared(u0, v0);
      if (squared_after * (side_before * side_before) <
          kSliverWorseSquared * squared_before * (side_after * side_after))
        return true;
    }
  }
  return false;
}

bool CollapseRules::turns_a_face(const Neighbourhood& n, Vec3 position) const {
  if (faces_.count <= kMostFacesAtHand) {
    // Without branches; what may be a sliver, or had no area, is looked at one by one below.
    const FacesAtHand& f = faces_;
    std::uint32_t doubtful = 0;
    for (std::uint32_t i = 0; i < f.count; ++i) {
      const Vec3 u = Vec3{f.px[i], f.py[i], f.pz[i]} - position, v = Vec3{f.qx[i], f.qy[i], f.qz[i]} - position;
      const Vec3 before{f.nx[i], f.ny[i], f.nz[i]};
      const Vec3 after = cross(u, v);
      const float squared_before = dot(before, before), squared_after = dot(after, after), along = dot(before, after);
      const float side = longest_side_squared(u, v);
      const std::uint32_t faces_on = along > 0 ? 1u : 0u;
      const std::uint32_t as_in_model = looks_as_in_model(unpack(f.facing[i]), after, squared_after) ? 1u : 0u;
      const std::uint32_t within_limit = along * along > kLeastCosineSquared * squared_before * squared_after ? 1u : 0u;
      const std::uint32_t no_sliver = squared_after >= kSliverSquared * side * side ? 1u : 0u;
      doubtful |= (faces_on & as_in_model & within_limit & no_sliver) ^ 1u;
    }
    if (doubtful == 0) return false;
  }
  return turns_a_face_at(n.a, n.b, position) || turns_a_face_at(n.b, n.a, position);
}

}  // namespace usuzumi::firmware
