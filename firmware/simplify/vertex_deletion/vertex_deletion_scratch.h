// The memory that simplify_vertex_deletion works in: what lies there, and how much of it.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/simplify/edge_key.h"
#include "firmware/simplify/working_surface.h"
#include "hal/arena.h"

namespace usuzumi::firmware {

/// What is remembered of a vertex between the costing of its deletion and its turn.
struct VertexState {
  float energy = 0;
  float distance = 0;  // Deletion::distance
  std::uint8_t fills[2] = {};  // of least energy, of each sector
  std::uint8_t stage = 0;      // the first whose limits the terms keep; kNever
  std::uint8_t reserved = 0;
};
static_assert(sizeof(VertexState) == 12);
inline constexpr std::uint8_t kNever = 0xFF;

struct VertexDeletionScratch {
  SurfaceMemory surface;
  std::span<VertexState> states;
  std::span<EdgeKey> heap_slots;
  std::span<std::uint32_t> heap_places;
};

/// Takes vertex_deletion_scratch_bytes (vertex_deletion.h) from `arena`. False, and nothing taken, where they do not
/// fit.
bool carve_vertex_deletion_scratch(Arena& arena, std::uint32_t vertex_count, std::uint32_t face_count,
                                   VertexDeletionScratch& scratch);

}  // namespace usuzumi::firmware
