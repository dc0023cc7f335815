#include "firmware/simplify/qem/texture_error.h"

#include <cmath>

namespace usuzumi::firmware {
namespace {

// How much a shift of the texture along the surface counts against the surface's own shift by the same length. The
// length of a texture unit is the mean over the mesh, the root of the surface's area by the texture's, so that neither
// the model's scale nor the texture's matters. Chosen by measuring drift and distance together: four times as much
// hardly holds a texture better, and costs shape.
constexpr float kTextureWeight = 0.5f;

// A face over which the texture runs this many times as fast as in the mean is one of bad coordinates, or a sliver, and
// says nothing about its neighbourhood. Arbitrary.
constexpr float kSteepest = 100;
// Differences between two places of the texture are counted no higher than this many working units, a few times the
// model's extent: no sum leaves the range of a single, whatever the coordinates.
constexpr float kLargestDifference = 0x1p14f;
constexpr float kMostScale = 0x1p60f;

bool is_finite(float x) { return x - x == 0; }

float clamped_difference(float x) {
  if (!(x < kLargestDifference)) return kLargestDifference;  // or no number
  return x > -kLargestDifference ? x : -kLargestDifference;
}

void add_squared(QuadricOf<float>& q, Vec3 n, float d, float weight) {
  const Vec3 s = n * weight;
  q.xx += s.x * n.x;
  q.xy += s.x * n.y;
  q.xz += s.x * n.z;
  q.yy += s.y * n.y;
  q.yz += s.y * n.z;
  q.zz += s.z * n.z;
  q.b = {q.b.x + s.x * d, q.b.y + s.y * d, q.b.z + s.z * d};
  q.c += weight * d * d;
}

}  // namespace

std::uint32_t TextureError::Match::find(std::uint32_t place) const {
  for (std::uint32_t i = 0; i < member_count; ++i)
    if (members[i] == place) return group_of_member[i];
  return kNone;
}

void TextureError::Match::add(std::uint32_t place, std::uint32_t group) {
  members[member_count] = place;
  group_of_member[member_count++] = group;
}

/// From the areas of the surface and of the texture it takes up.
bool TextureError::find_scale(const Surface& s) {
  float area = 0, texture_area = 0;
  for (std::uint32_t face = 0; face < s.face_count; ++face) {
    if (s.is_dead(face)) continue;
    const std::uint32_t* w = &s.indices[std::size_t{face} * 3];
    const Vec3 p = s.position(s.vertex_at(face * 4));
    area += length(cross(s.position(s.vertex_at(face * 4 + 1)) - p, s.position(s.vertex_at(face * 4 + 2)) - p));
    const TexCoord a = coordinates_[w[0]], b = coordinates_[w[1]], c = coordinates_[w[2]];
    const float twice = (b.s - a.s) * (c.t - a.t) - (c.s - a.s) * (b.t - a.t);
    texture_area += twice < 0 ? -twice : twice;
  }
  if (!(area > 0) || !(texture_area > 0)) return false;
  scale_ = std::sqrt(area / texture_area);
  return scale_ < kMostScale && scale_ > 1 / kMostScale;
}

/// Joins the face's function to the mean at each of its corners.
void TextureError::add_face(Surface& s, std::uint32_t face) {
  const std::uint32_t* w = &s.indices[std::size_t{face} * 3];
  const Vec3 p = s.position(s.vertex_at(face * 4));
  const Vec3 e1 = s.position(s.vertex_at(face * 4 + 1)) - p, e2 = s.position(s.vertex_at(face * 4 + 2)) - p;
  const Vec3 normal = cross(e1, e2);
  const float squared = dot(normal, normal);
  if (!(squared > 0)) return;
  const Vec3 g1 = cross(e2, normal) * (1.0f / squared), g2 = cross(normal, e1) * (1.0f / squared);
  const TexCoord a = coordinates_[w[0]], b = coordinates_[w[1]], c = coordinates_[w[2]];
  PlacedFit of_face;
  of_face.fit = {g1 * (b.s - a.s) + g2 * (c.s - a.s), g1 * (b.t - a.t) + g2 * (c.t - a.t), std::sqrt(squared)};
  const Vec3 s_scaled = of_face.fit.s_slope * scale_, t_scaled = of_face.fit.t_slope * scale_;
  if (!(dot(s_scaled, s_scaled) < kSteepest * kSteepest && dot(t_scaled, t_scaled) < kSteepest * kSteepest)) return;
  for (std::uint32_t k = 0; k < 3; ++k) {
    Quadric& quadric = s.vertices[s.vertex_at(face * 4 + k)].quadric;
    QuadricOf<float> sum = lanes_of(quadric);
    PlacedFit mean;  // both are 0 at the vertex, relative to the coordinate there
    mean.fit = fits_[place_of(w[k])];
    join(mean, of_face, &sum);
    fits_[place_of(w[k])] = mean.fit;
    quadric = {sum.xx, sum.xy, sum.xz, sum.yy, sum.yz, sum.zz, {sum.b.x, sum.b.y, sum.b.z}, sum.c};
  }
}

void TextureError::set_up(Surface& surface, TexCoord* coordinates, std::span<std::uint32_t> places,
                          std::span<TextureFit> fits) {
  coordinates_ = coordinates;
  places_ = places.data();
  fits_ = fits.data();
  active_ = coordinates != nullptr && surface.vertex_count <= kPlaceMask && find_scale(surface);
  if (!active_) return;
  for (TextureFit& fit : fits) fit = TextureFit{};
  for (std::uint32_t face = 0; face < surface.face_count; ++face) {
    if (surface.is_dead(face)) continue;
    add_face(surface, face);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t v = surface.vertex_at(face * 4 + k);
      if (surface.indices[std::size_t{face} * 3 + k] != v) places_[v] |= kSeveralWedges;
    }
  }
}

/// What the wedge stands for, seen from the edge's first end; its own vertex lies at `from_first`.
TextureError::PlacedFit TextureError::fit_at(std::uint32_t wedge, Vec3 from_first) const {
  PlacedFit r;
  r.fit = fits_[place_of(wedge)];
  r.s = coordinates_[wedge].s - dot(r.fit.s_slope, from_first);
  r.t = coordinates_[wedge].t - dot(r.fit.t_slope, from_first);
  return r;
}

void TextureError::add_squared_difference(const PlacedFit& one, const PlacedFit& other, QuadricOf<float>& sum) const {
  const float both = one.fit.weight + other.fit.weight;
  if (!(both > 0)) return;
  const float weight = kTextureWeight * (one.fit.weight * (other.fit.weight / both));
  add_squared(sum, (other.fit.s_slope - one.fit.s_slope) * scale_, clamped_difference((other.s - one.s) * scale_),
              weight);
  add_squared(sum, (other.fit.t_slope - one.fit.t_slope) * scale_, clamped_difference((other.t - one.t) * scale_),
              weight);
}

/// `into` becomes the mean of both; the square of their difference is added to `sum` where that is not null.
void TextureError::join(PlacedFit& into, const PlacedFit& from, QuadricOf<float>* sum) const {
  if (sum != nullptr) add_squared_difference(into, from, *sum);
  const float both = into.fit.weight + from.fit.weight;
  const float share = both > 0 ? from.fit.weight / both : 0.5f;
  into.fit.s_slope = into.fit.s_slope + (from.fit.s_slope - into.fit.s_slope) * share;
  into.fit.t_slope = into.fit.t_slope + (from.fit.t_slope - into.fit.t_slope) * share;
  into.fit.weight = both;
  into.s += (from.s - into.s) * share;
  into.t += (from.t - into.t) * share;
}

void TextureError::match_face(const Surface& surface, Corner at_a, Corner at_b, Vec3 edge, Match& match,
                              QuadricOf<float>* sum) const {
  const std::uint32_t wedge_a = surface.indices[corner_index(at_a)], wedge_b = surface.indices[corner_index(at_b)];
  const std::uint32_t place_a = place_of(wedge_a), place_b = place_of(wedge_b);
  std::uint32_t group_a = match.find(place_a);
  const std::uint32_t group_b = match.find(place_b);
  if (group_a == kNone && group_b == kNone) {
    if (match.group_count == kMostFacesOnEdge) return;
    group_a = match.group_count++;
    match.groups[group_a] = fit_at(wedge_a, {});
    match.owners[group_a] = place_a;
    match.add(place_a, group_a);
  } else if (group_a == kNone) {  // the seam ends here, or another begins
    join(match.groups[group_b], fit_at(wedge_a, {}), sum);
    match.add(place_a, group_b);
    return;
  }
  if (group_b == kNone) {
    join(match.groups[group_a], fit_at(wedge_b, edge), sum);
    match.add(place_b, group_a);
  } else if (group_a != group_b) {
    join(match.groups[group_a], match.groups[group_b], sum);
    for (std::uint32_t i = 0; i < match.member_count; ++i)
      if (match.group_of_member[i] == group_b) match.group_of_member[i] = group_a;
  }
}

void TextureError::match_edge(const Surface& surface, Corner half_edge, Match& match, QuadricOf<float>* sum) const {
  const std::uint32_t a = surface.vertex_at(half_edge), b = surface.vertex_at(next_in_face(half_edge));
  const Vec3 edge = surface.position(b) - surface.position(a);
  match.group_count = match.member_count = 0;
  match_face(surface, half_edge, next_in_face(half_edge), edge, match, sum);
  if (!has_several(a) && !has_several(b)) return;
  for (Corner c = surface.first_corner(a); c != kNoCorner; c = surface.next_corner_of(c)) {
    if (c == half_edge) continue;
    if (surface.vertex_at(next_in_face(c)) == b) match_face(surface, c, next_in_face(c), edge, match, sum);
    else if (surface.vertex_at(previous_in_face(c)) == b) match_face(surface, c, previous_in_face(c), edge, match, sum);
    if (match.member_count + 2 > kMostMembers) return;  // more faces than a collapse is allowed to have
  }
}

EdgeCost TextureError::cost_edge(const Surface& surface, Corner half_edge, Placement placement) const {
  const std::uint32_t a = surface.vertex_at(half_edge), b = surface.vertex_at(next_in_face(half_edge));
  const Vec3 edge = surface.position(b) - surface.position(a);
  QuadricOf<float> sum;
  sum_quadrics(lanes_of(surface.vertices[a].quadric), lanes_of(surface.vertices[b].quadric),
               Vec3Of<float>{edge.x, edge.y, edge.z}, sum);
  if (has_several(a) || has_several(b)) {
    Match match;
    match_edge(surface, half_edge, match, &sum);
  } else {
    add_squared_difference(fit_at(surface.indices[corner_index(half_edge)], {}),
                           fit_at(surface.indices[corner_index(next_in_face(half_edge))], edge), sum);
  }
  return cost_of_sum(sum, edge, placement);
}

void TextureError::set_coordinate(std::uint32_t wedge, float s, float t) {
  if (is_finite(s) && is_finite(t)) coordinates_[wedge] = {s, t};
}

/// The wedges of vertex `v` that nothing at the edge's other end is joined to.
void TextureError::move_others(const Surface& surface, std::uint32_t v, Vec3 position) {
  if (!has_several(v)) return;
  const Vec3 moved = position - surface.position(v);
  for (Corner c = surface.first_corner(v); c != kNoCorner; c = surface.next_corner_of(c)) {
    const std::uint32_t wedge = surface.indices[corner_index(c)];
    if ((places_[wedge] & kMoved) != 0 || match_.find(place_of(wedge)) != kNone) continue;
    places_[wedge] |= kMoved;
    const TextureFit& fit = fits_[place_of(wedge)];
    set_coordinate(wedge, coordinates_[wedge].s + dot(fit.s_slope, moved),
                   coordinates_[wedge].t + dot(fit.t_slope, moved));
  }
}

void TextureError::begin_collapse(const Surface& surface, Corner half_edge, Vec3 position) {
  const std::uint32_t a = surface.vertex_at(half_edge), b = surface.vertex_at(next_in_face(half_edge));
  offset_ = position - surface.position(a);
  match_edge(surface, half_edge, match_, nullptr);
  move_others(surface, a, position);
  move_others(surface, b, position);
}

void TextureError::end_collapse(const Surface& surface, std::uint32_t vertex) {
  for (std::uint32_t i = 0; i < match_.group_count; ++i) fits_[match_.owners[i]] = match_.groups[i].fit;
  const Corner first = surface.first_corner(vertex);
  bool several = false;
  for (Corner c = first; c != kNoCorner; c = surface.next_corner_of(c)) {
    const std::uint32_t wedge = surface.indices[corner_index(c)];
    several = several || wedge != surface.indices[corner_index(first)];
    std::uint32_t& place = places_[wedge];
    const std::uint32_t group = match_.find(place & kPlaceMask);
    place &= ~kMoved;
    if (group == kNone) continue;
    place = (place & ~kPlaceMask) | match_.owners[group];
    const PlacedFit& placed = match_.groups[group];
    set_coordinate(wedge, placed.s + dot(placed.fit.s_slope, offset_), placed.t + dot(placed.fit.t_slope, offset_));
  }
  places_[vertex] = (places_[vertex] & ~kSeveralWedges) | (several ? kSeveralWedges : 0);
}

}  // namespace usuzumi::firmware
