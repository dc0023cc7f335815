// The triangulations that a polygon may be filled with, stored beforehand.
//
// Polygons of 3 to 6 corners have all of theirs: 1, 2, 5, 14. Above, Sato et al. take "combinations that even out the
// number of triangles that share each corner", and we take the most even there are: the zigzags, in which no corner has
// more than three new triangles. From 7 corners on these are all such triangulations: a triangle without a side on the
// polygon would give each of its corners three already, and leave room for one triangle beyond each of its sides, which
// is a hexagon. A polygon of n corners has n zigzags.
#pragma once

#include <cstdint>

namespace usuzumi::firmware {

inline constexpr std::uint32_t kMostCorners = 19;           // polygons of 20 corners and more are not made
inline constexpr std::uint32_t kMostCornersOfAllFills = 6;  // up to this many corners, every triangulation is tried
inline constexpr std::uint32_t kMostFills = 19;
inline constexpr std::uint32_t kMostTriples = 20;  // of corners of a hexagon

/// Three corners of a polygon, rising: they run around the triangle the way the polygon's corners run around it. A
/// whole word, so that a copy is one: of three bytes the compiler makes a memcpy(), and libraries' read half-words at
/// odd addresses, which a processor may be told to refuse.
struct alignas(4) FillTriangle {
  std::uint8_t a = 0, b = 0, c = 0;
  friend constexpr bool operator==(FillTriangle, FillTriangle) = default;
};

/// The number of fills of a polygon of 2 to kMostCorners corners. Two corners (an edge) have one, without triangles.
std::uint32_t fill_count(std::uint32_t corners);

/// Fills kFirstFan to kFirstFan + corners - 1 are fans: all triangles meet in corner `fill - kFirstFan`, where the
/// deleted vertex can be drawn moving to.
inline constexpr std::uint8_t kFirstFan = 64;
constexpr bool is_fan(std::uint32_t fill) { return fill >= kFirstFan; }

/// The `t`-th triangle, t < corners - 2, of the polygon's `fill`-th fill.
FillTriangle fill_triangle(std::uint32_t corners, std::uint32_t fill, std::uint32_t t);

/// For polygons of up to 6 corners: all triples (a, b, c), of which a polygon of n corners has the first
/// n (n - 1) (n - 2) / 6; and, fill by fill, the numbers of its n - 2 triangles in that list, kTriplesOfFill apart.
inline constexpr std::uint32_t kTriplesOfFill = kMostCornersOfAllFills - 2;
const FillTriangle* triples();
const std::uint8_t* triples_of_fills(std::uint32_t corners);

}  // namespace usuzumi::firmware
