#include "firmware/simplify/half_edge/half_edge_scratch.h"

#include "firmware/simplify/edge_passes.h"
#include "firmware/simplify/half_edge/half_edge.h"
#include "firmware/simplify/weld.h"

namespace usuzumi::firmware {
namespace {

constexpr std::uint64_t kAlignment = 64;  // of every array: a cache line on most processors, and one size everywhere

// 64 bits even where pointers have 32, so that a mesh that cannot fit is seen before anything is allocated.
constexpr std::uint64_t aligned(std::uint64_t bytes) { return (bytes + kAlignment - 1) / kAlignment * kAlignment; }

constexpr std::uint64_t later_bytes(std::uint32_t vertex_count, std::uint64_t face_count) {
  const std::uint64_t later = aligned(face_count * 16) + aligned(edge_candidate_slots(face_count) * sizeof(EdgeKey)) +
                              aligned(edge_queue_slots(face_count) * sizeof(EdgeKey));
  const std::uint64_t table = weld_table_slots(vertex_count) * 4;
  return later > table ? later : table;
}

}  // namespace

std::uint64_t half_edge_scratch_bytes(std::uint32_t vertex_count, std::uint32_t face_count) {
  const std::uint64_t vertices = vertex_count;
  return kAlignment + 3 * aligned(vertices * 4) + aligned(vertices * sizeof(Place)) +
         aligned(vertices * sizeof(Vertex)) + aligned(face_count) + later_bytes(vertex_count, face_count);
}

bool carve_half_edge_scratch(Arena& arena, std::uint32_t vertex_count, std::uint32_t face_count,
                             HalfEdgeScratch& scratch) {
  const std::uint64_t bytes = half_edge_scratch_bytes(vertex_count, face_count) - kAlignment;
  if (bytes > arena.available()) return false;
  const std::span<std::byte> memory = arena.allocate<std::byte>(static_cast<std::size_t>(bytes), kAlignment);
  if (memory.data() == nullptr) return false;
  Arena rest(memory);  // from here on everything fits: the sizes above are the sum of these
  scratch.surface.vertex_of_wedge = rest.allocate<std::uint32_t>(vertex_count, kAlignment);
  scratch.surface.places = rest.allocate<Place>(vertex_count, kAlignment);
  scratch.surface.vertices = rest.allocate<Vertex>(vertex_count, kAlignment);
  scratch.seam_words = rest.allocate<std::uint32_t>(vertex_count, kAlignment);
  scratch.areas = rest.allocate<float>(vertex_count, kAlignment);
  scratch.refused = rest.allocate<std::uint8_t>(face_count, kAlignment);
  const std::size_t mark = rest.used();
  scratch.surface.weld_table =
      rest.allocate<std::uint32_t>(static_cast<std::size_t>(weld_table_slots(vertex_count)), kAlignment);
  rest.rewind(mark);
  scratch.surface.links = rest.allocate<std::uint32_t>(std::size_t{face_count} * 4, kAlignment);
  scratch.candidates = rest.allocate<EdgeKey>(static_cast<std::size_t>(edge_candidate_slots(face_count)), kAlignment);
  scratch.queue = rest.allocate<EdgeKey>(static_cast<std::size_t>(edge_queue_slots(face_count)), kAlignment);
  return true;
}

}  // namespace usuzumi::firmware
