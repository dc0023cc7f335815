#include "firmware/simplify/vertex_deletion/ring.h"

namespace usuzumi::firmware {
namespace {

struct Spokes {
  std::uint32_t count = 0;
  Corner corners[kMostRingFaces];
  std::uint32_t after[kMostRingFaces], before[kMostRingFaces];  // the face's vertices after and before this one
};

bool collect(const Surface& s, std::uint32_t v, Spokes& spokes) {
  for (Corner c = s.first_corner(v); c != kNoCorner; c = s.next_corner_of(c)) {
    if (spokes.count == kMostRingFaces) return false;
    spokes.corners[spokes.count] = c;
    spokes.after[spokes.count] = s.vertex_at(next_in_face(c));
    spokes.before[spokes.count] = s.vertex_at(previous_in_face(c));
    ++spokes.count;
  }
  return spokes.count >= 2;
}

// Puts the faces in order; false where they are not one fan or one half-fan.
bool arrange(const Spokes& spokes, Ring& ring) {
  const std::uint32_t n = spokes.count;
  // No two faces run along an edge the same way.
  for (std::uint32_t i = 1; i < n; ++i)
    for (std::uint32_t j = 0; j < i; ++j)
      if (spokes.after[i] == spokes.after[j] || spokes.before[i] == spokes.before[j]) return false;
  std::uint32_t order[kMostRingFaces];
  for (std::uint32_t i = 0; i < n; ++i) order[i] = i;
  const auto swap = [&](std::uint32_t i, std::uint32_t j) {
    const std::uint32_t kept = order[i];
    order[i] = order[j];
    order[j] = kept;
  };
  // On from any face as far as it goes, then back from it, towards the end of the array.
  std::uint32_t ahead = 1;
  for (bool found = true; found && ahead < n;) {
    const std::uint32_t wanted = spokes.before[order[ahead - 1]];
    std::uint32_t j = ahead;
    while (j < n && spokes.after[order[j]] != wanted) ++j;
    found = j < n;
    if (found) swap(ahead++, j);
  }
  std::uint32_t behind = n;
  for (std::uint32_t first = order[0]; behind > ahead; first = order[behind]) {
    std::uint32_t j = ahead;
    while (j < behind && spokes.before[order[j]] != spokes.after[first]) ++j;
    if (j == behind) return false;
    swap(--behind, j);
  }
  ring.open = spokes.before[order[ahead - 1]] != spokes.after[order[behind % n]];
  ring.face_count = n;
  std::uint32_t next = 0;
  for (std::uint32_t i = behind; i < n; ++i) ring.corners[next++] = spokes.corners[order[i]];
  for (std::uint32_t i = 0; i < ahead; ++i) ring.corners[next++] = spokes.corners[order[i]];
  return true;
}

std::uint32_t wedge_at(const Surface& s, Corner c) { return s.indices[corner_index(c)]; }

// True where two neighbouring faces of the ring name different wedges on the edge between them.
bool is_seam(const Surface& s, Corner one, Corner following) {
  return wedge_at(s, one) != wedge_at(s, following) ||
         wedge_at(s, previous_in_face(one)) != wedge_at(s, next_in_face(following));
}

float squared_distance(TexCoord a, TexCoord b) { return (a.s - b.s) * (a.s - b.s) + (a.t - b.t) * (a.t - b.t); }

// The faces of corners `before` and `after` name one wedge at the vertex and two at the other end of the edge between
// them, where a seam ends. The polygon will have one of the two for both: it may where that shifts a texture a little,
// as at the pole of a globe, but bends no shading.
bool is_mere_pole(const Surface& s, const WedgeAttributes& a, Corner before, Corner after) {
  const std::uint32_t at_vertex = wedge_at(s, after);
  const std::uint32_t one = wedge_at(s, previous_in_face(before)), other = wedge_at(s, next_in_face(after));
  if (a.texture_coordinates == nullptr) return false;
  if (a.normals != nullptr && !(a.normals[one] == a.normals[other])) return false;
  if (a.colours != nullptr && !(a.colours[one] == a.colours[other])) return false;
  const TexCoord* t = a.texture_coordinates;
  return squared_distance(t[one], t[other]) <= squared_distance(t[at_vertex], t[one]);
}

// Cuts the ring at its seams, and turns it so that it begins at one.
bool cut(const Surface& s, const WedgeAttributes& attributes, Ring& ring) {
  ring.sector_count = 1;
  ring.sectors[0] = {.first_face = 0, .face_count = ring.face_count, .first_corner = 0, .corner_count = 0};
  if (s.vertex_of_wedge == nullptr) return true;
  const std::uint32_t n = ring.face_count;
  std::uint32_t seams = 0, at[2] = {};  // faces that begin a sector
  for (std::uint32_t i = ring.open ? 1 : 0; i < n; ++i) {
    if (!is_seam(s, ring.corners[i == 0 ? n - 1 : i - 1], ring.corners[i])) continue;
    if (ring.open || seams == 2) return false;
    at[seams++] = i;
  }
  if (seams == 0) return true;
  // At the vertex wedges change twice or not at all.
  if (seams == 1) return is_mere_pole(s, attributes, ring.corners[at[0] == 0 ? n - 1 : at[0] - 1], ring.corners[at[0]]);
  Corner turned[kMostRingFaces];
  for (std::uint32_t i = 0; i < n; ++i) turned[i] = ring.corners[(at[0] + i) % n];
  for (std::uint32_t i = 0; i < n; ++i) ring.corners[i] = turned[i];
  const std::uint32_t first = at[1] - at[0];
  ring.sector_count = 2;
  ring.sectors[0].face_count = first;
  ring.sectors[1] = {.first_face = first, .face_count = n - first, .first_corner = 0, .corner_count = 0};
  return true;
}

void name_corners(const Surface& s, Ring& ring) {
  std::uint32_t next = 0;
  for (std::uint32_t k = 0; k < ring.sector_count; ++k) {
    Sector& sector = ring.sectors[k];
    sector.first_corner = next;
    sector.corner_count = sector.face_count + (ring.has_closing_edge() ? 1 : 0);
    for (std::uint32_t i = 0; i < sector.corner_count; ++i) {
      const Corner c = i < sector.face_count ? next_in_face(ring.corners[sector.first_face + i])
                                             : previous_in_face(ring.corners[sector.first_face + i - 1]);
      ring.vertices[next] = s.vertex_at(c);
      ring.wedges[next] = wedge_at(s, c);
      ++next;
    }
  }
}

// A sector of one face goes without being filled, and the seam moves onto that face's third edge: there must be one
// face beyond it, of the same sector's wedges.
bool leads_on(const Surface& s, const Ring& ring, const Sector& sector) {
  const Corner at_vertex = ring.corners[sector.first_face];
  const Corner from = next_in_face(at_vertex), to = previous_in_face(at_vertex);
  const std::uint32_t b = s.vertex_at(to);
  std::uint32_t faces = 0, fitting = 0;
  for (Corner c = s.first_corner(s.vertex_at(from)); c != kNoCorner; c = s.next_corner_of(c)) {
    if (s.vertex_at(next_in_face(c)) == b || s.vertex_at(previous_in_face(c)) == b) ++faces;
    if (s.vertex_at(previous_in_face(c)) == b && wedge_at(s, c) == wedge_at(s, from) &&
        wedge_at(s, previous_in_face(c)) == wedge_at(s, to))
      ++fitting;
  }
  return faces == 2 && fitting == 1;
}

}  // namespace

bool gather_ring(const Surface& surface, const WedgeAttributes& attributes, std::uint32_t v, Ring& ring) {
  Spokes spokes;
  if (!collect(surface, v, spokes) || !arrange(spokes, ring)) return false;
  if (ring.face_count + (ring.open ? 1 : 0) < 3 || ring.face_count + (ring.open ? 1 : 0) > kMostCorners) return false;
  ring.vertex = v;
  if (!cut(surface, attributes, ring)) return false;
  name_corners(surface, ring);
  for (std::uint32_t k = 0; ring.has_seam() && k < 2; ++k)
    if (ring.sectors[k].face_count == 1 && !leads_on(surface, ring, ring.sectors[k])) return false;
  return true;
}

bool has_edge(const Surface& surface, std::uint32_t a, std::uint32_t b) {
  for (Corner c = surface.first_corner(a); c != kNoCorner; c = surface.next_corner_of(c))
    if (surface.vertex_at(next_in_face(c)) == b || surface.vertex_at(previous_in_face(c)) == b) return true;
  return false;
}

bool has_face(const Surface& surface, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t except) {
  for (Corner at = surface.first_corner(a); at != kNoCorner; at = surface.next_corner_of(at)) {
    const std::uint32_t p = surface.vertex_at(next_in_face(at)), q = surface.vertex_at(previous_in_face(at));
    if (p == except || q == except) continue;
    if ((p == b && q == c) || (p == c && q == b)) return true;
  }
  return false;
}

}  // namespace usuzumi::firmware
