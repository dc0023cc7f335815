// Which vertices are the same: by position alone, and by everything that ROM stores of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/pack/model.h"

namespace usuzumi::sim {

/// Numbers for distinct positions, in order of first appearance; -0 equals 0.
struct PositionIds {
  std::vector<std::uint32_t> of_vertex;     // vertex -> position number
  std::vector<std::uint32_t> first_vertex;  // position number -> the first vertex there
};
PositionIds number_positions(std::span<const Vec3> positions);

/// Sets coordinates to 0 that are nothing beside the mesh's largest: 2^-30 of it and less, a hundredth of what a single
/// can tell there. sin(pi) is not 0 in floating point: the vertices at the pole of a sphere lie 1e-16 apart, and would
/// stay a ring of open edges.
void drop_rounding_noise(Mesh& mesh);

/// Joins vertices of equal position, packed normal, colour and texture coordinate; drops unreferenced ones. Vertices
/// come out in the order in which faces first use them, so neighbours in space are neighbours in ROM. Faces stay as
/// they are. A joined vertex is in a group where one of those joined was.
void weld_vertices(Mesh& mesh);

/// Removes faces with two corners at one position, which draw nothing. Returns how many.
std::uint32_t remove_faces_without_area(Mesh& mesh);

}  // namespace usuzumi::sim
