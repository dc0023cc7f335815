#include "firmware/simplify/edge_removal/removal_scratch.h"

#include "firmware/simplify/edge_removal/edge_removal.h"
#include "firmware/simplify/scratch_layout.h"

namespace usuzumi::firmware {
namespace {

void lay_out(ScratchLayout& layout, std::uint32_t vertex_count, std::uint32_t face_count, RemovalScratch& scratch) {
  lay_out_vertices(layout, vertex_count, scratch.surface);
  layout.array(scratch.vertices, vertex_count);
  lay_out_links(layout, vertex_count, face_count, scratch.surface);
  layout.array(scratch.heap_slots, std::uint64_t{face_count} * 3);
  layout.array(scratch.heap_place_of, std::uint64_t{face_count} * 4);
}

}  // namespace

std::uint64_t edge_removal_scratch_bytes(std::uint32_t vertex_count, std::uint32_t face_count) {
  RemovalScratch scratch;
  return layout_bytes(kScratchAlignment,
                      [&](ScratchLayout& layout) { lay_out(layout, vertex_count, face_count, scratch); });
}

bool carve_removal_scratch(Arena& arena, std::uint32_t vertex_count, std::uint32_t face_count,
                           RemovalScratch& scratch) {
  return carve_layout(arena, kScratchAlignment,
                      [&](ScratchLayout& layout) { lay_out(layout, vertex_count, face_count, scratch); });
}

}  // namespace usuzumi::firmware
