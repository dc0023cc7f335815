#include "firmware/simplify/vertex_deletion/delete_vertex.h"

namespace usuzumi::firmware {
namespace {

constexpr std::uint32_t kNoFace = 0xFFFFFFFFu, kNoCornerOfSector = 0xFFFFFFFFu;

void link_corner(Surface& s, std::uint32_t v, Corner c) {
  s.links[c] = s.first_corner(v);
  s.vertices[v].first_corner = c;
}

void unlink_rim(Surface& s, Corner at_vertex) {
  for (const Corner c : {next_in_face(at_vertex), previous_in_face(at_vertex)}) unlink_corner(s, s.vertex_at(c), c);
}

void name(Surface& s, Corner c, std::uint32_t wedge, std::uint32_t v, CollapseLog* log) {
  std::uint32_t& index = s.indices[corner_index(c)];
  if (log != nullptr && index != wedge) log->change(static_cast<std::uint32_t>(corner_index(c)), index, wedge);
  index = wedge;
  link_corner(s, v, c);
}

PackedNormal face_direction(const Surface& s, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const Vec3 normal = cross(s.position(b) - s.position(a), s.position(c) - s.position(a));
  const float l = length(normal);
  return l > 0 ? pack_normal(normal * (1.0f / l)) : PackedNormal{0};
}

// A side of the polygon, which is a face's, and the corner across from it.
struct SideOfFill {
  std::uint32_t face = kNoFace, apex = 0;
};

// The side that triangle `f` has: its face names the apex in the vertex's stead and keeps its other wedges. A fan's is
// the one that its heir is not on: what that face becomes while the vertex moves to the heir.
SideOfFill side_of(const FillTriangle& f, const Sector& sector, std::uint32_t heir) {
  const bool closed = sector.corner_count == sector.face_count;  // the last side is that of the last face
  if (f.b == f.a + 1 && heir != f.a && heir != f.b) return {f.a, f.c};
  if (f.c == f.b + 1 && heir != f.b && heir != f.c) return {f.b, f.a};
  if (closed && f.a == 0 && f.c + 1u == sector.face_count && heir != f.c && heir != f.a) return {f.c, f.b};
  return {};
}

// One sector's fill. `heir` is the corner of the sector that the vertex moves to where the fill is a fan, else
// kNoCornerOfSector. Faces whose slots are left over go to `dead`; returns how many.
std::uint32_t fill_sector(Surface& s, const Ring& ring, const Sector& sector, std::uint32_t fill, std::uint32_t heir,
                          Corner* dead, CollapseLog* log) {
  const std::uint32_t* wedges = ring.wedges + sector.first_corner;
  const std::uint32_t* vertices = ring.vertices + sector.first_corner;
  const Corner* corners = ring.corners + sector.first_face;
  bool taken[kMostRingFaces] = {};
  FillTriangle inner[kMostCorners];  // without a side on the polygon
  std::uint32_t inner_count = 0;
  for (std::uint32_t t = 0; t + 2 < sector.corner_count; ++t) {
    const FillTriangle f = fill_triangle(sector.corner_count, fill, t);
    const SideOfFill side = side_of(f, sector, heir);
    if (side.face == kNoFace) {
      inner[inner_count++] = f;
      continue;
    }
    taken[side.face] = true;
    name(s, corners[side.face], wedges[side.apex], vertices[side.apex], log);
  }
  std::uint32_t dead_count = 0;
  for (std::uint32_t face = 0; face < sector.face_count; ++face) {
    if (taken[face]) continue;
    const Corner c = corners[face];
    unlink_rim(s, c);
    if (inner_count == 0) {
      dead[dead_count++] = c;
      continue;
    }
    const FillTriangle f = inner[--inner_count];
    name(s, c, wedges[f.a], vertices[f.a], log);
    name(s, next_in_face(c), wedges[f.b], vertices[f.b], log);
    name(s, previous_in_face(c), wedges[f.c], vertices[f.c], log);
    s.set_facing(c, face_direction(s, vertices[f.a], vertices[f.b], vertices[f.c]));
  }
  return dead_count;
}

// The polygon corner, within the first sector, where the vertex moves to: the one that its fan meets in, else the
// nearest. Three corners are filled by one triangle, whatever fan that is.
std::uint32_t heir_of(const Surface& s, const Ring& ring, std::uint32_t fill) {
  const std::uint32_t last = ring.sectors[0].corner_count - 1;
  if (is_fan(fill) && (last != 2 || ring.has_closing_edge())) return fill - kFirstFan;
  const std::uint32_t step = ring.has_closing_edge() ? last : 1;
  std::uint32_t nearest = 0;
  float least = 0;
  for (std::uint32_t i = 0; i <= last; i += step) {
    const Vec3 way = s.position(ring.vertices[i]) - s.position(ring.vertex);
    const float squared = dot(way, way);
    if (i > 0 && !(squared < least)) continue;
    nearest = i;
    least = squared;
  }
  return nearest;
}

// The same corner in the second sector, which runs along the seam the other way.
std::uint32_t heir_across(const Ring& ring, std::uint32_t heir) {
  return heir == 0 ? ring.sectors[1].corner_count - 1 : 0;
}

void tell_successions(const Surface& s, const Ring& ring, std::uint32_t heir, CollapseLog& log) {
  const std::uint32_t one = s.indices[corner_index(ring.corners[0])];
  log.succeed(one, ring.wedges[heir]);
  if (!ring.has_seam()) return;
  const Sector& sector = ring.sectors[1];
  const std::uint32_t other = s.indices[corner_index(ring.corners[sector.first_face])];
  if (other != one) log.succeed(other, ring.wedges[sector.first_corner + heir_across(ring, heir)]);
}

// What the ring's faces name at the polygon's corners.
struct RimWedges {
  std::uint32_t count = 0;
  std::uint32_t vertices[2 * kMostRingFaces], wedges[2 * kMostRingFaces];
};

RimWedges rim_wedges(const Surface& s, const Ring& ring) {
  RimWedges rim;
  for (std::uint32_t i = 0; i < ring.face_count; ++i) {
    for (const Corner c : {next_in_face(ring.corners[i]), previous_in_face(ring.corners[i])}) {
      rim.vertices[rim.count] = s.vertex_at(c);
      rim.wedges[rim.count++] = s.indices[corner_index(c)];
    }
  }
  return rim;
}

// Those that no face names any more go where their vertex goes.
void tell_left_wedges(const Surface& s, const TexCoord* texture_coordinates, const RimWedges& rim, CollapseLog& log) {
  for (std::uint32_t i = 0; i < rim.count; ++i) {
    const StandingWedge stands = standing_wedge(s, texture_coordinates, rim.vertices[i], rim.wedges[i]);
    if (stands.wedge != rim.wedges[i] && stands.wedge != kNoWedge)
      log.follow(rim.wedges[i], stands.wedge, stands.same_texture);
  }
}

}  // namespace

std::uint32_t delete_vertex(Surface& surface, const TexCoord* texture_coordinates, const Ring& ring,
                            const std::uint8_t fills[2], CollapseLog* log) {
  const std::uint32_t heir = heir_of(surface, ring, fills[0]);
  RimWedges rim;
  if (log != nullptr) {
    log->begin_step();
    tell_successions(surface, ring, heir, *log);
    rim = rim_wedges(surface, ring);
  }
  Corner dead[kMostRingFaces];
  std::uint32_t dead_count = 0;
  for (std::uint32_t k = 0; k < ring.sector_count; ++k) {
    const std::uint32_t in_sector = k == 0 ? heir : heir_across(ring, heir);
    dead_count += fill_sector(surface, ring, ring.sectors[k], fills[k],
                              is_fan(fills[k]) ? in_sector : kNoCornerOfSector, dead + dead_count, log);
  }
  for (std::uint32_t i = 0; i < dead_count; ++i) {
    const std::uint32_t face = dead[i] >> 2;
    surface.indices[std::size_t{face} * 3] = kDeadFace;
    for (std::uint32_t k = 0; k < 3; ++k) surface.links[face * 4 + k] = kNoCorner;
    if (log != nullptr) log->remove_face(face);
  }
  surface.vertices[ring.vertex].first_corner = kNoCorner;
  if (log != nullptr) {
    tell_left_wedges(surface, texture_coordinates, rim, *log);
    log->end_step();
  }
  return dead_count;
}

}  // namespace usuzumi::firmware
