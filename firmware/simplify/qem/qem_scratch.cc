#include "firmware/simplify/qem/qem_scratch.h"

#include "firmware/simplify/edge_passes.h"
#include "firmware/simplify/qem/qem.h"
#include "firmware/simplify/weld.h"

namespace usuzumi::firmware {
namespace {

constexpr std::size_t kAlignment = 16;  // of each array, so that the sizes add up whatever the arena's start

// Counts from ROM may ask for more bytes than a 32-bit device can address: sizes are 64 bits wide until they are
// compared.
constexpr std::uint64_t aligned(std::uint64_t bytes) { return (bytes + kAlignment - 1) / kAlignment * kAlignment; }

constexpr std::uint64_t links_and_keys_bytes(std::uint32_t vertex_count, std::uint64_t face_count) {
  const std::uint64_t later = aligned(face_count * 16) + aligned(edge_candidate_slots(face_count) * sizeof(EdgeKey)) +
                              aligned(edge_queue_slots(face_count) * sizeof(EdgeKey));
  const std::uint64_t table = weld_table_slots(vertex_count) * 4;
  return later > table ? later : table;
}

}  // namespace

std::uint64_t qem_scratch_bytes(std::uint32_t vertex_count, std::uint32_t face_count, bool has_texture_coordinates) {
  const std::uint64_t texture = has_texture_coordinates ? aligned(std::uint64_t{vertex_count} * 4) +
                                                              aligned(std::uint64_t{vertex_count} * sizeof(TextureFit))
                                                        : 0;
  return kAlignment + aligned(std::uint64_t{vertex_count} * 4) + aligned(std::uint64_t{vertex_count} * sizeof(Place)) +
         aligned(std::uint64_t{vertex_count} * sizeof(Vertex)) + texture +
         links_and_keys_bytes(vertex_count, face_count);
}

bool carve_qem_scratch(Arena& arena, std::uint32_t vertex_count, std::uint32_t face_count, bool has_texture_coordinates,
                       QemScratch& scratch) {
  const std::uint64_t bytes = qem_scratch_bytes(vertex_count, face_count, has_texture_coordinates) - kAlignment;
  if (bytes > arena.available()) return false;
  const std::span<std::byte> memory = arena.allocate<std::byte>(static_cast<std::size_t>(bytes), kAlignment);
  if (memory.data() == nullptr) return false;
  Arena rest(memory);  // from here on everything fits: the sizes above are the sum of these
  scratch.surface.vertex_of_wedge = rest.allocate<std::uint32_t>(vertex_count, kAlignment);
  scratch.surface.places = rest.allocate<Place>(vertex_count, kAlignment);
  scratch.surface.vertices = rest.allocate<Vertex>(vertex_count, kAlignment);
  if (has_texture_coordinates) {
    scratch.surface.texture_places = rest.allocate<std::uint32_t>(vertex_count, kAlignment);
    scratch.texture_fits = rest.allocate<TextureFit>(vertex_count, kAlignment);
  }
  const std::size_t mark = rest.used();
  scratch.surface.weld_table =
      rest.allocate<std::uint32_t>(static_cast<std::size_t>(weld_table_slots(vertex_count)), kAlignment);
  rest.rewind(mark);
  scratch.surface.links = rest.allocate<std::uint32_t>(std::size_t{face_count} * 4, kAlignment);
  scratch.candidates = rest.allocate<EdgeKey>(static_cast<std::size_t>(edge_candidate_slots(face_count)), kAlignment);
  scratch.queue = rest.allocate<EdgeKey>(static_cast<std::size_t>(edge_queue_slots(face_count)), kAlignment);
  scratch.batch_size = static_cast<std::size_t>(edge_batch_size(face_count));
  return true;
}

}  // namespace usuzumi::firmware
