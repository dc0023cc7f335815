// Finding vertices in a list of wedges: equal positions are one vertex, whatever their normals, colours and texture
// coordinates.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/simplify/simplify.h"

namespace usuzumi::firmware {

/// Slots of the hash table for `vertex_count` wedges: a power of two, at most two thirds full.
constexpr std::uint64_t weld_table_slots(std::uint32_t vertex_count) {
  std::uint64_t slots = 4;
  while (slots < std::uint64_t{vertex_count} + vertex_count / 2) slots *= 2;
  return slots;
}

/// Points the indices of wedges that are equal in everything (-0 equals 0), group included, at the first of them, and
/// sets vertex_of_wedge[w] to the first wedge at w's position. True when some vertex keeps more than one wedge.
/// `table` has weld_table_slots() entries; `vertex_of_wedge` vertex_count.
bool weld(WorkingMesh& mesh, std::span<std::uint32_t> vertex_of_wedge, std::span<std::uint32_t> table);

/// Sets first[w] to the first vertex of the same position, texture coordinate and group as w: what is one place of one
/// texture, whatever the normals and colours there. `table` as for weld().
void find_texture_places(const WorkingMesh& mesh, std::span<std::uint32_t> first, std::span<std::uint32_t> table);

}  // namespace usuzumi::firmware
