#include "firmware/simplify/half_edge/half_edge_scratch.h"

#include "firmware/simplify/edge_passes.h"
#include "firmware/simplify/half_edge/half_edge.h"
#include "firmware/simplify/scratch_layout.h"

namespace usuzumi::firmware {
namespace {

constexpr std::size_t kAlignment = 64;  // of every array: a cache line on most processors, and one size everywhere

void lay_out(ScratchLayout& layout, std::uint32_t vertex_count, std::uint32_t face_count, HalfEdgeScratch& scratch) {
  lay_out_vertices(layout, vertex_count, scratch.surface);
  layout.array(scratch.seam_words, vertex_count);
  layout.array(scratch.areas, vertex_count);
  layout.array(scratch.refused, face_count);
  lay_out_links(layout, vertex_count, face_count, scratch.surface);
  layout.array(scratch.candidates, edge_candidate_slots(face_count));
  layout.array(scratch.queue, edge_queue_slots(face_count));
}

}  // namespace

std::uint64_t half_edge_scratch_bytes(std::uint32_t vertex_count, std::uint32_t face_count) {
  HalfEdgeScratch scratch;
  return layout_bytes(kAlignment, [&](ScratchLayout& layout) { lay_out(layout, vertex_count, face_count, scratch); });
}

bool carve_half_edge_scratch(Arena& arena, std::uint32_t vertex_count, std::uint32_t face_count,
                             HalfEdgeScratch& scratch) {
  return carve_layout(arena, kAlignment,
                      [&](ScratchLayout& layout) { lay_out(layout, vertex_count, face_count, scratch); });
}

}  // namespace usuzumi::firmware
