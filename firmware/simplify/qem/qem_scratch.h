// The memory that simplify_qem works in: what lies there, and how much of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/simplify/edge_key.h"
#include "firmware/simplify/qem/texture_error.h"
#include "firmware/simplify/working_surface.h"
#include "hal/arena.h"

namespace usuzumi::firmware {

struct QemScratch {
  SurfaceMemory surface;
  std::span<TextureFit> texture_fits;  // vertex_count with texture coordinates, else none; so surface.texture_places
  std::span<EdgeKey> candidates;
  std::span<EdgeKey> queue;
  std::size_t batch_size = 0;  // keys; the rest of `queue` is room for edges that a collapse brings up
};

/// Takes qem_scratch_bytes (qem.h) from `arena`. False, and nothing taken, where they do not fit.
bool carve_qem_scratch(Arena& arena, std::uint32_t vertex_count, std::uint32_t face_count, bool has_texture_coordinates,
                       QemScratch& scratch);

}  // namespace usuzumi::firmware
