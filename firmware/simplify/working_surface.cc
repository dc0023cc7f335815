#include "firmware/simplify/working_surface.h"

#include "firmware/simplify/weld.h"

namespace usuzumi::firmware {
namespace {

// Coordinates are brought near this by a power of two, exactly, so that neither squared areas nor costs leave the range
// of a single: twice an area squared reaches (2^12)^4, times a squared length (2^12)^2, below 2^128.
constexpr float kWorkingExtent = 4096;

void copy_positions(const WorkingMesh& mesh, WorkingSurface& out) {
  Surface& surface = out.surface;
  Vec3 low, high;
  find_extent(surface, [&](std::uint32_t v) { return mesh.positions[v]; }, low, high);
  // Halves first: the difference of two finite singles may be infinite.
  const Vec3 half = high * 0.5f - low * 0.5f;
  float extent = half.x > half.y ? half.x : half.y;
  extent = extent > half.z ? extent : half.z;
  out.scale = 1;
  if (extent > 0) {
    while (extent * out.scale > kWorkingExtent) out.scale *= 0.5f;
    while (extent * out.scale <= kWorkingExtent / 2 && out.scale < 0x1p100f) out.scale *= 2.0f;
  }
  for (std::uint32_t v = 0; v < surface.vertex_count; ++v) surface.places[v] = {mesh.positions[v] * out.scale, 0};
}

template <class T>
T* data_or_null(std::span<T> stream) {
  return stream.empty() ? nullptr : stream.data();
}

}  // namespace

void lay_out_vertices(ScratchLayout& layout, std::uint32_t vertex_count, SurfaceMemory& memory) {
  layout.array(memory.vertex_of_wedge, vertex_count);
  layout.array(memory.places, vertex_count);
  layout.array(memory.vertices, vertex_count);
}

void lay_out_links(ScratchLayout& layout, std::uint32_t vertex_count, std::uint32_t face_count, SurfaceMemory& memory) {
  layout.array_under_the_rest(memory.weld_table, weld_table_slots(vertex_count));
  layout.array(memory.links, std::uint64_t{face_count} * 4);
}

void build_surface(WorkingMesh& mesh, const SurfaceMemory& memory, WorkingSurface& out) {
  Surface& surface = out.surface;
  surface.places = memory.places.data();
  surface.vertices = memory.vertices.data();
  surface.links = memory.links.data();
  surface.indices = mesh.indices.data();
  surface.vertex_count = mesh.vertex_count;
  surface.face_count = mesh.face_count;
  out.attributes = {data_or_null(mesh.normals), data_or_null(mesh.colours), data_or_null(mesh.texture_coordinates)};
  out.seam_map = weld(mesh, memory.vertex_of_wedge, memory.weld_table) ? memory.vertex_of_wedge.data() : nullptr;
  surface.vertex_of_wedge = out.seam_map;
  if (!memory.texture_places.empty()) find_texture_places(mesh, memory.texture_places, memory.weld_table);
  out.live_faces = link_corners(surface);
  copy_positions(mesh, out);
}

void write_surface(WorkingMesh& mesh, WorkingSurface& from) {
  constexpr std::uint32_t kUnused = 0xFFFFFFFFu, kUsed = 0;
  const Surface& surface = from.surface;
  Place* wedges = surface.places;  // `mark` becomes each wedge's new number
  for (std::uint32_t w = 0; w < mesh.vertex_count; ++w) wedges[w].mark = kUnused;
  std::uint32_t faces = 0;
  std::size_t group = 0;
  for (std::uint32_t face = 0; face < surface.face_count; ++face) {
    for (; group < mesh.groups.size() && face == mesh.groups[group].face_end; ++group)
      mesh.groups[group].face_end = faces;
    if (surface.is_dead(face)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t wedge = mesh.indices[std::size_t{face} * 3 + k];
      wedges[wedge].mark = kUsed;
      mesh.indices[std::size_t{faces} * 3 + k] = wedge;
    }
    ++faces;
  }
  for (; group < mesh.groups.size(); ++group) mesh.groups[group].face_end = faces;
  group = 0;
  std::uint32_t used = 0;
  for (std::uint32_t w = 0; w < mesh.vertex_count; ++w) {
    for (; group < mesh.groups.size() && w == mesh.groups[group].vertex_end; ++group)
      mesh.groups[group].vertex_end = used;
    if (wedges[w].mark == kUnused) continue;
    mesh.positions[used] =
        from.positions_kept ? mesh.positions[w]
                            : wedges[from.seam_map == nullptr ? w : from.seam_map[w]].position * (1.0f / from.scale);
    if (!mesh.normals.empty()) mesh.normals[used] = mesh.normals[w];
    if (!mesh.colours.empty()) mesh.colours[used] = mesh.colours[w];
    if (!mesh.texture_coordinates.empty()) mesh.texture_coordinates[used] = mesh.texture_coordinates[w];
    if (!mesh.source_vertices.empty()) mesh.source_vertices[used] = w;
    wedges[w].mark = used++;
  }
  for (; group < mesh.groups.size(); ++group) mesh.groups[group].vertex_end = used;
  for (std::size_t i = 0; i < std::size_t{faces} * 3; ++i) mesh.indices[i] = wedges[mesh.indices[i]].mark;
  mesh.vertex_count = used;
  mesh.face_count = faces;
}

}  // namespace usuzumi::firmware
