// Connectivity of a triangle mesh while edges collapse: every vertex knows the corners of the faces around it.
//
// A corner is 4 * face + k, k = 0..2 (the code never divides by three). The corners of a vertex form a list through
// `links`, in no geometric order, so that any input has a sound structure: open borders, edges of three or more
// faces, fans that touch in a point, faces turned the other way. Merging two vertices joins two lists.
//
// Corner k also stands for the half-edge from vertex k to vertex k + 1 of its face. Of all the half-edges of an edge
// exactly one is its representative; the edge's number in its key is that corner.
//
// A wedge is one entry of the vertex arrays: a position with a normal and a colour. A vertex is all wedges of the same
// position; it goes by the number of the first of them. Indices always name wedges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/simplify/quadric.h"
#include "hal/vec.h"

namespace usuzumi::firmware {

using Corner = std::uint32_t;

inline constexpr Corner kCornerMask = 0x3FFFFFFFu;  // bits 29-0 of a link
inline constexpr Corner kNoCorner = kCornerMask;    // ends a list
inline constexpr std::uint32_t kRepresentative = 1u << 30;  // in links: this half-edge stands for its edge
inline constexpr std::uint32_t kRefused = 1u << 31;  // in links: its collapse was refused and nothing near has changed
inline constexpr std::uint32_t kTouchesRefused = 1u << 31;  // in Place::mark: an edge here may be marked kRefused
// In Place::mark: an edge here has not two faces that run opposite ways.
inline constexpr std::uint32_t kSingular = 1u << 30;
inline constexpr std::uint32_t kPlaceFlags = kTouchesRefused | kSingular;
inline constexpr std::uint32_t kDeadFace = 0xFFFFFFFFu;     // in the first index of a face that is gone
inline constexpr std::uint32_t kMostFaces = (1u << 28) - 1;

constexpr std::size_t corner_index(Corner c) { return c - (c >> 2); }
constexpr Corner next_in_face(Corner c) { return (c & 3) == 2 ? c - 2 : c + 1; }
constexpr Corner previous_in_face(Corner c) { return (c & 3) == 0 ? c + 2 : c - 1; }

/// What a walk around a vertex needs of its neighbours, four to a cache line.
struct Place {
  Vec3 position;           // in working units
  std::uint32_t mark = 0;  // kPlaceFlags; the rest is scratch of whoever walks a neighbourhood, see each user
};
static_assert(sizeof(Place) == 16);

/// What is needed of a vertex itself.
struct Vertex {
  Quadric quadric;
  Corner first_corner = kNoCorner;
};
static_assert(sizeof(Vertex) == 44);

/// Non-owning view of the mesh and its connectivity. Vertex arrays are as long as the wedge arrays; only entries that
/// are vertices are meaningful.
struct Surface {
  Place* places = nullptr;
  std::uint32_t* indices = nullptr;     // 3 per face: wedges
  std::uint32_t* links = nullptr;       // 4 per face: by corner, the link and flags; then facing()
  Vertex* vertices = nullptr;
  const std::uint32_t* vertex_of_wedge = nullptr;  // null where every wedge is its own vertex
  std::uint32_t vertex_count = 0;
  std::uint32_t face_count = 0;  // dead ones included

  std::uint32_t vertex_at(Corner c) const {
    const std::uint32_t wedge = indices[corner_index(c)];
    return vertex_of_wedge == nullptr ? wedge : vertex_of_wedge[wedge];
  }
  Vec3 position(std::uint32_t v) const { return places[v].position; }
  Corner first_corner(std::uint32_t v) const { return vertices[v].first_corner; }
  Corner next_corner_of(Corner c) const { return links[c] & kCornerMask; }
  /// Where the face of corner `c` looked before anything was collapsed; bits 0 where it had no area.
  PackedNormal facing(Corner c) const { return {links[c | 3]}; }
  void set_facing(Corner c, PackedNormal normal) { links[c | 3] = normal.bits; }
  bool is_dead(std::uint32_t face) const { return indices[std::size_t{face} * 3] == kDeadFace; }
};

/// Marks faces with two corners at one vertex dead and gives every vertex the list of its corners, lowest first.
/// Returns the number of live faces.
std::uint32_t link_corners(Surface& surface);

/// Takes corner `c` out of the list of vertex `v`.
void unlink_corner(Surface& surface, std::uint32_t v, Corner c);

/// The least and the largest coordinates of `position_of(v)` over the vertices that have a face; zeros without any.
template <class PositionOf>
void find_extent(const Surface& surface, PositionOf position_of, Vec3& low, Vec3& high) {
  low = high = Vec3{};
  bool any = false;
  for (std::uint32_t v = 0; v < surface.vertex_count; ++v) {
    if (surface.first_corner(v) == kNoCorner) continue;
    const Vec3 p = position_of(v);
    if (!any) low = high = p;
    any = true;
    low = {p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y, p.z < low.z ? p.z : low.z};
    high = {p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y, p.z > high.z ? p.z : high.z};
  }
}

inline constexpr std::uint32_t kNoWedge = 0xFFFFFFFFu;
/// What stands for a wedge at its vertex.
struct StandingWedge {
  std::uint32_t wedge = kNoWedge;  // kNoWedge where the vertex has no face
  bool same_texture = true;        // its texture coordinate is the wedge's
};
/// What stands for `wedge` at vertex `v`: itself while a face names it there, else the first that one names with its
/// texture coordinate, else the first that one names. `texture_coordinates`: by wedge; null where there are none.
StandingWedge standing_wedge(const Surface& surface, const TexCoord* texture_coordinates, std::uint32_t v,
                             std::uint32_t wedge);

}  // namespace usuzumi::firmware
