#include "firmware/simplify/edge_removal/edge_value.h"

#include <limits>

namespace usuzumi::firmware {
namespace {

// Twice the area times the unit normal of corner `c`'s face.
Vec3 twice_area_vector(const Surface& s, Corner c) {
  const Vec3 p = s.position(s.vertex_at(c));
  return cross(s.position(s.vertex_at(next_in_face(c))) - p, s.position(s.vertex_at(previous_in_face(c))) - p);
}

constexpr float kMostValue = std::numeric_limits<float>::max();

float absolute(float x) { return x < 0 ? -x : x; }

}  // namespace

// A plane on the edge itself holds E, so that its V_i is nothing: it counts in the second term only, and every other
// plane of S(v1) + S(v2) in the first only.
EdgeShape EdgeValues::shape_of(Corner edge) const {
  const Surface& s = surface_;
  EdgeShape shape;
  shape.a = s.vertex_at(edge);
  shape.b = s.vertex_at(next_in_face(edge));
  const Vec3 from = s.position(shape.a), to = s.position(shape.b);
  const Vec3 e = to - from;
  shape.length = length(e);
  std::uint32_t faces_on_edge = 0;
  Corner one = kNoCorner, two = kNoCorner;  // half-edges from a to b and from b to a
  float twice_sheet = 0;
  for (Corner c = s.first_corner(shape.a); c != kNoCorner; c = s.next_corner_of(c)) {
    const std::uint32_t p = s.vertex_at(next_in_face(c)), q = s.vertex_at(previous_in_face(c));
    const Vec3 n = cross(s.position(p) - from, s.position(q) - from);
    if (p == shape.b || q == shape.b) {
      ++faces_on_edge;
      (p == shape.b ? one : two) = p == shape.b ? c : previous_in_face(c);
      twice_sheet += length(n);
      continue;
    }
    const float v = dot(n, e);
    shape.at_a.volume += absolute(v);
    shape.at_a.net_volume += v;
  }
  for (Corner c = s.first_corner(shape.b); c != kNoCorner; c = s.next_corner_of(c)) {
    const std::uint32_t p = s.vertex_at(next_in_face(c)), q = s.vertex_at(previous_in_face(c));
    if (p == shape.a || q == shape.a) continue;
    const float v = dot(cross(s.position(p) - to, s.position(q) - to), e);
    shape.at_b.volume += absolute(v);
    shape.at_b.net_volume += v;
  }
  for (EndChange* end : {&shape.at_a, &shape.at_b}) {
    end->volume *= 0.5f;
    end->net_volume *= 0.5f;
  }
  shape.sheet = shape.length * twice_sheet * 0.5f;
  if (vertices_[shape.a].border_edges == 0 || vertices_[shape.b].border_edges == 0) return shape;
  shape.border = faces_on_edge != 2 || one == kNoCorner || two == kNoCorner || images_differ(s, images_, one, two);
  if (!shape.border) return shape;
  if (vertices_[shape.a].border_edges == 2) look_at_outline(shape.a, shape.b, e, true, shape.at_a);
  if (vertices_[shape.b].border_edges == 2) look_at_outline(shape.b, shape.a, e, false, shape.at_b);
  return shape;
}

// N_i lies in the surface at right angles to boundary edge i, which also lies in both planes on it; so with M the sum
// of these planes' area vectors, N_i L_i = (M x L) / |M|, to the left of L where M looks at the viewer. Where the
// planes fold back onto each other M is nothing, and either will do.
void EdgeValues::look_at_outline(std::uint32_t end, std::uint32_t other, Vec3 edge, bool at_a,
                                 EndChange& change) const {
  visit_border_edges(surface_, images_, end, [&](const BorderEdge& border) {
    if (border.other == other || !border.here) return;
    const Vec3 first = twice_area_vector(surface_, border.one);
    Vec3 m = border.two == kNoCorner ? first : first + twice_area_vector(surface_, border.two);
    if (!(dot(m, m) > 0)) m = first;
    const float size = length(m);
    if (!(size > 0)) return;
    const Vec3 away = surface_.position(border.other) - surface_.position(end);
    const Vec3 along = at_a ? away * -1.0f : away;  // the way from before a to a, or from b on
    const float area = dot(cross(m, along), edge) / size;
    change.outline += absolute(area);
    change.net_outline += area;
  });
}

// Two boundaries that an edge bridges would be drawn together, so it stays. An end on a boundary keeps its place where
// the edge leaves the boundary; a corner of boundaries always does.
Freedom EdgeValues::freedom_of(const EdgeShape& shape) const {
  const RemovalVertex &a = vertices_[shape.a], &b = vertices_[shape.b];
  if (a.author_value < 0 || b.author_value < 0) return Freedom::kNone;
  const bool a_stays = shape.border ? a.border_edges != 2 : a.border_edges != 0;
  const bool b_stays = shape.border ? b.border_edges != 2 : b.border_edges != 0;
  if (a_stays && b_stays) return Freedom::kNone;
  return a_stays ? Freedom::kAtA : b_stays ? Freedom::kAtB : Freedom::kAlong;
}

// Eq. (1) is a volume, eq. (2) an area: the edge's length makes a volume of it, the sum of the coefficients one that
// stands to the others as they do.
float EdgeValues::own_value(const EdgeShape& shape) const {
  const float volume = shape.at_a.volume + shape.at_b.volume;
  const float outline = (shape.at_a.outline + shape.at_b.outline) * shape.length;
  return settings_.a * volume + settings_.b * shape.sheet + (settings_.a + settings_.b) * outline;
}

float EdgeValues::neighbours_mean(Corner edge, const EdgeShape& shape) const {
  float sum = 0;
  std::uint32_t count = 0;
  for (const std::uint32_t v : {shape.a, shape.b}) {
    for (Corner c = surface_.first_corner(v); c != kNoCorner; c = surface_.next_corner_of(c)) {
      for (const Corner half_edge : {c, previous_in_face(c)}) {
        if (half_edge == edge || (surface_.links[half_edge] & kRepresentative) == 0) continue;
        sum += own_value(shape_of(half_edge));
        ++count;
      }
    }
  }
  return count > 0 ? sum / static_cast<float>(count) : 0.0f;
}

float EdgeValues::computed(Corner edge, const EdgeShape& shape) const {
  float value = own_value(shape);
  if (settings_.neighbour_weight > 0) value += settings_.neighbour_weight * neighbours_mean(edge, shape);
  return value;
}

float EdgeValues::value(Corner edge, const EdgeShape& shape) const {
  float value = settings_.computed_weight * computed(edge, shape);
  const float author = larger_author_value(vertices_[shape.a].author_value, vertices_[shape.b].author_value);
  if (author > 0) value += settings_.user_weight * author * unit_;
  return value >= 0 ? (value < kMostValue ? value : kMostValue) : 0.0f;  // not a number: the settings asked for it
}

}  // namespace usuzumi::firmware
