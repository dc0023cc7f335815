#include "firmware/simplify/vertex_deletion/vertex_deletion_scratch.h"

#include "firmware/simplify/scratch_layout.h"
#include "firmware/simplify/vertex_deletion/vertex_deletion.h"

namespace usuzumi::firmware {
namespace {

void lay_out(ScratchLayout& layout, std::uint32_t vertex_count, std::uint32_t face_count,
             VertexDeletionScratch& scratch) {
  lay_out_vertices(layout, vertex_count, scratch.surface);
  lay_out_links(layout, vertex_count, face_count, scratch.surface);
  layout.array(scratch.states, vertex_count);
  layout.array(scratch.heap_slots, vertex_count);
  layout.array(scratch.heap_places, vertex_count);
}

}  // namespace

std::uint64_t vertex_deletion_scratch_bytes(std::uint32_t vertex_count, std::uint32_t face_count) {
  VertexDeletionScratch scratch;
  return layout_bytes(kScratchAlignment,
                      [&](ScratchLayout& layout) { lay_out(layout, vertex_count, face_count, scratch); });
}

bool carve_vertex_deletion_scratch(Arena& arena, std::uint32_t vertex_count, std::uint32_t face_count,
                                   VertexDeletionScratch& scratch) {
  return carve_layout(arena, kScratchAlignment,
                      [&](ScratchLayout& layout) { lay_out(layout, vertex_count, face_count, scratch); });
}

}  // namespace usuzumi::firmware
