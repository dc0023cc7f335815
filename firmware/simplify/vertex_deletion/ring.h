// The faces around a vertex in geometric order, and the polygons that deleting it leaves to be filled.
//
// A ring is closed (an inner vertex) or open (a boundary vertex). It is cut into sectors of faces that agree about the
// wedges of their common edges, so that a fill may name the same wedges: one sector where no seam passes, two where a
// seam of texture coordinates, normals, colours or materials runs through the vertex. Each sector of a seam, and an
// open ring, is closed by a new edge from its last corner to its first: the seam or the boundary, a corner shorter.
#pragma once

#include <cstdint>

#include "firmware/simplify/attributes.h"
#include "firmware/simplify/surface.h"
#include "firmware/simplify/vertex_deletion/fill_patterns.h"

namespace usuzumi::firmware {

inline constexpr std::uint32_t kMostRingFaces = kMostCorners;
inline constexpr std::uint32_t kMostSectorCorners = kMostRingFaces + 2;  // of all sectors of a ring together

struct Sector {
  std::uint32_t first_face = 0, face_count = 0;      // in Ring::corners
  std::uint32_t first_corner = 0, corner_count = 0;  // in Ring::vertices and Ring::wedges
};

struct Ring {
  std::uint32_t vertex = 0;
  bool open = false;
  std::uint32_t face_count = 0;
  Corner corners[kMostRingFaces];  // the vertex's, in order: face i lies between polygon corners i and i + 1
  std::uint32_t sector_count = 0;
  Sector sectors[2];
  std::uint32_t vertices[kMostSectorCorners];  // the polygon's corners, sector by sector ...
  std::uint32_t wedges[kMostSectorCorners];    // ... and their wedges in that sector

  bool has_seam() const { return sector_count == 2; }
  /// True where the sector's polygon is closed by an edge that is not one of its faces'.
  bool has_closing_edge() const { return open || has_seam(); }
  /// True where that edge is new: beside a sector of one face it is that face's.
  bool adds_closing_edge() const {
    return open || (has_seam() && sectors[0].face_count > 1 && sectors[1].face_count > 1);
  }
};

/// False where vertex `v` stays: it has no faces, one face, or more than kMostCorners polygon corners; its faces are
/// not one fan or one half-fan (an edge of three faces, faces that run the same way along an edge, fans that touch in
/// the vertex); one seam or more than two end at it, or any at a boundary vertex; or one side of its seam is a single
/// face whose third edge does not lead on into the same sector.
/// But a seam that comes no further than a neighbour, whose wedges there have one normal and colour and are no further
/// apart on the texture than the vertex is from them (the pole of a globe), is none: the polygon has one of them there,
/// and faces that keep a side of it keep theirs.
bool gather_ring(const Surface& surface, const WedgeAttributes& attributes, std::uint32_t v, Ring& ring);

/// True where a face has the edge a-b.
bool has_edge(const Surface& surface, std::uint32_t a, std::uint32_t b);
/// True where a face other than those at `except` has all three corners.
bool has_face(const Surface& surface, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t except);

}  // namespace usuzumi::firmware
