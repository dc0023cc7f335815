#include "firmware/simplify/qem/qem_scratch.h"

#include "firmware/simplify/edge_passes.h"
#include "firmware/simplify/qem/qem.h"
#include "firmware/simplify/scratch_layout.h"

namespace usuzumi::firmware {
namespace {

void lay_out(ScratchLayout& layout, std::uint32_t vertex_count, std::uint32_t face_count, bool has_texture_coordinates,
             QemScratch& scratch) {
  lay_out_vertices(layout, vertex_count, scratch.surface);
  if (has_texture_coordinates) {
    layout.array(scratch.surface.texture_places, vertex_count);
    layout.array(scratch.texture_fits, vertex_count);
  }
  lay_out_links(layout, vertex_count, face_count, scratch.surface);
  layout.array(scratch.candidates, edge_candidate_slots(face_count));
  layout.array(scratch.queue, edge_queue_slots(face_count));
}

}  // namespace

std::uint64_t qem_scratch_bytes(std::uint32_t vertex_count, std::uint32_t face_count, bool has_texture_coordinates) {
  QemScratch scratch;
  return layout_bytes(kScratchAlignment, [&](ScratchLayout& layout) {
    lay_out(layout, vertex_count, face_count, has_texture_coordinates, scratch);
  });
}

bool carve_qem_scratch(Arena& arena, std::uint32_t vertex_count, std::uint32_t face_count, bool has_texture_coordinates,
                       QemScratch& scratch) {
  scratch.batch_size = static_cast<std::size_t>(edge_batch_size(face_count));
  return carve_layout(arena, kScratchAlignment, [&](ScratchLayout& layout) {
    lay_out(layout, vertex_count, face_count, has_texture_coordinates, scratch);
  });
}

}  // namespace usuzumi::firmware
