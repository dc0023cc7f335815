#include "firmware/simplify/initial_quadrics.h"

#include <cmath>

namespace usuzumi::firmware {
namespace {

// Weights relative to a face's, which is twice its area. The constraint planes' are relative to the edge's squared
// length. Chosen by measuring (tests/bench/simplify).
constexpr float kBorderWeight = 2.0f;
constexpr float kAttributeBorderWeight = 0.5f;
constexpr float kTextureSeamWeight = 8.0f;  // beyond a seam lie texels of another place

// In Place::mark while a vertex looks at its edges to higher vertices: the number of faces still to be met on the edge
// (bits 0-26); faces run along it from here, and to here; its representative is chosen. Then the count alone says which
// edges have two faces, and kTwoFaces remembers it.
constexpr std::uint32_t kCountMask = (1u << 27) - 1;
constexpr std::uint32_t kRunsOut = 1u << 27;
constexpr std::uint32_t kRunsIn = 1u << 28;
constexpr std::uint32_t kChosen = 1u << 29;
constexpr std::uint32_t kTwoFaces = kRunsOut;  // from when kChosen is set

Vec3 face_normal(const Surface& s, std::uint32_t face) {
  const Corner c = face * 4;
  const Vec3 p = s.position(s.vertex_at(c));
  return cross(s.position(s.vertex_at(c + 1)) - p, s.position(s.vertex_at(c + 2)) - p);
}

void add_face_planes(Surface& s) {
  for (std::uint32_t face = 0; face < s.face_count; ++face) {
    if (s.is_dead(face)) continue;
    const Vec3 normal = face_normal(s, face);
    const float twice_area = length(normal);
    if (!(twice_area > 0)) continue;  // no plane, and no side
    s.set_facing(face * 4, pack_normal(normal * (1.0f / twice_area)));
    for (Corner c = face * 4; c < face * 4 + 3; ++c)
      add_plane_through_owner(s.vertices[s.vertex_at(c)].quadric, normal, 1.0f / twice_area);
  }
}

// The plane through the edge of half-edge `c`, at right angles to its face.
void add_constraint_plane(Surface& s, Corner c, float weight) {
  const std::uint32_t a = s.vertex_at(c);
  const std::uint32_t b = s.vertex_at(next_in_face(c));
  const Vec3 normal = face_normal(s, c >> 2);
  const float squared = dot(normal, normal);
  if (!(squared > 0)) return;
  // |edge x normal| = |edge| |normal|, so this scale gives the plane the weight |edge|^2.
  const Vec3 plane = cross(s.position(b) - s.position(a), normal);
  add_plane_through_owner(s.vertices[a].quadric, plane, weight / squared);
  add_plane_through_owner(s.vertices[b].quadric, plane, weight / squared);
}

// The half-edge on the edge between `v` and `other` in the face of `v`'s corner `c`.
Corner half_edge_towards(const Surface& s, Corner c, std::uint32_t other) {
  return s.vertex_at(next_in_face(c)) == other ? c : previous_in_face(c);
}

// The weight of the constraint planes on an edge of two faces: 0 where they agree about the attributes at its ends.
float border_weight(const Surface& s, const std::uint32_t* texture_places, Corner one, Corner other) {
  const std::uint32_t a0 = s.indices[corner_index(one)];
  const std::uint32_t b0 = s.indices[corner_index(next_in_face(one))];
  std::uint32_t a1 = s.indices[corner_index(other)];
  std::uint32_t b1 = s.indices[corner_index(next_in_face(other))];
  if (s.vertex_of_wedge[a1] != s.vertex_of_wedge[a0]) {
    const std::uint32_t swap = a1;
    a1 = b1;
    b1 = swap;
  }
  if (a0 == a1 && b0 == b1) return 0;
  const bool is_seam = texture_places != nullptr &&
                       (texture_places[a0] != texture_places[a1] || texture_places[b0] != texture_places[b1]);
  return is_seam ? kTextureSeamWeight : kAttributeBorderWeight;
}

// The other half-edge of a two-faced edge whose one is `c`, seen from `v`'s corners after `from`.
void add_attribute_border(Surface& s, const std::uint32_t* texture_places, Corner one, Corner from,
                          std::uint32_t other_end) {
  for (Corner c = s.next_corner_of(from); c != kNoCorner; c = s.next_corner_of(c)) {
    if (s.vertex_at(next_in_face(c)) != other_end && s.vertex_at(previous_in_face(c)) != other_end) continue;
    const Corner other = half_edge_towards(s, c, other_end);
    const float weight = border_weight(s, texture_places, one, other);
    if (weight == 0) return;
    add_constraint_plane(s, one, weight);
    add_constraint_plane(s, other, weight);
    return;
  }
}

// One edge as met at corner `c` of its lower end `v`.
void meet_edge(Surface& s, const std::uint32_t* texture_places, std::uint32_t v, Corner c, Corner half_edge,
               std::uint32_t other_end) {
  std::uint32_t& mark = s.places[other_end].mark;
  if ((mark & kChosen) == 0) {
    const bool two_faces = (mark & kCountMask) == 2;
    if (!two_faces || (mark & (kRunsOut | kRunsIn)) != (kRunsOut | kRunsIn)) {
      s.places[v].mark |= kSingular;
      mark |= kSingular;
    }
    mark &= ~(kRunsOut | kRunsIn);
    mark |= kChosen | (two_faces ? kTwoFaces : 0);
    s.links[half_edge] |= kRepresentative;
    if (two_faces && s.vertex_of_wedge != nullptr) add_attribute_border(s, texture_places, half_edge, c, other_end);
  }
  if ((mark & kTwoFaces) == 0) add_constraint_plane(s, half_edge, kBorderWeight);
  --mark;
  if ((mark & kCountMask) == 0) mark &= kPlaceFlags;
}

void choose_representatives(Surface& s, const std::uint32_t* texture_places) {
  for (std::uint32_t v = 0; v < s.vertex_count; ++v) {
    for (Corner c = s.first_corner(v); c != kNoCorner; c = s.next_corner_of(c)) {
      const std::uint32_t out = s.vertex_at(next_in_face(c));
      const std::uint32_t in = s.vertex_at(previous_in_face(c));
      if (out > v) s.places[out].mark = (s.places[out].mark + 1) | kRunsOut;
      if (in > v) s.places[in].mark = (s.places[in].mark + 1) | kRunsIn;
    }
    for (Corner c = s.first_corner(v); c != kNoCorner; c = s.next_corner_of(c)) {
      const std::uint32_t out = s.vertex_at(next_in_face(c));
      const std::uint32_t in = s.vertex_at(previous_in_face(c));
      if (out > v) meet_edge(s, texture_places, v, c, c, out);
      if (in > v) meet_edge(s, texture_places, v, c, previous_in_face(c), in);
    }
  }
}

}  // namespace

void set_initial_quadrics(Surface& surface, const std::uint32_t* texture_places) {
  add_face_planes(surface);
  choose_representatives(surface, texture_places);
}

}  // namespace usuzumi::firmware
