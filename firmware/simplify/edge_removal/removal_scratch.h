// The memory that simplify_edge_removal works in.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/simplify/cost_heap.h"
#include "firmware/simplify/edge_removal/edge_value.h"
#include "firmware/simplify/working_surface.h"
#include "hal/arena.h"

namespace usuzumi::firmware {

struct RemovalScratch {
  SurfaceMemory surface;
  std::span<RemovalVertex> vertices;
  std::span<EdgeLengthKey> heap_slots;     // as many as there can be edges: three a face
  std::span<std::uint32_t> heap_place_of;  // by half-edge, four a face
};

/// Takes edge_removal_scratch_bytes (edge_removal.h) from `arena`. False, and nothing taken, where they do not fit.
bool carve_removal_scratch(Arena& arena, std::uint32_t vertex_count, std::uint32_t face_count, RemovalScratch& scratch);

}  // namespace usuzumi::firmware
