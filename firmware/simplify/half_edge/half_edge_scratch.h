// The memory that simplify_half_edge works in: what lies there, and how much of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/simplify/edge_key.h"
#include "firmware/simplify/working_surface.h"
#include "hal/arena.h"

namespace usuzumi::firmware {

struct HalfEdgeScratch {
  SurfaceMemory surface;
  std::span<std::uint32_t> seam_words;  // one per vertex
  std::span<float> areas;               // one per vertex
  std::span<std::uint8_t> refused;      // one per face
  std::span<EdgeKey> candidates;
  std::span<EdgeKey> queue;
};

/// Takes half_edge_scratch_bytes (half_edge.h) from `arena`. False, and nothing taken, where they do not fit.
bool carve_half_edge_scratch(Arena& arena, std::uint32_t vertex_count, std::uint32_t face_count,
                             HalfEdgeScratch& scratch);

}  // namespace usuzumi::firmware
