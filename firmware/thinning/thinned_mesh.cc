#include "firmware/thinning/thinned_mesh.h"

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>

#include "firmware/thinning/block_writer.h"
#include "firmware/thinning/normals.h"
#include "firmware/thinning/whole_mesh.h"
#include "hal/arena.h"

namespace usuzumi::firmware {
namespace {

/// Whether the thinned mesh may be drawn with its vertices in ROM: then their old numbers are asked for.
bool may_leave_vertices(const Decision& decision, const RamCopy& copy) {
  return copy.rom_on_bus() && keeps_vertices(decision.method);
}

/// Halves the indices in place where all vertex numbers fit 16 bits. Returns the bytes of one index.
std::uint32_t narrow_indices(std::span<std::uint32_t> indices, std::uint32_t vertex_count) {
  if (vertex_count > 65536) return 4;
  auto* bytes = reinterpret_cast<std::byte*>(indices.data());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const auto narrow = static_cast<std::uint16_t>(indices[i]);
    std::memcpy(bytes + 2 * i, &narrow, 2);
  }
  return 2;
}

/// The mesh unpacked into the free memory as the methods want it, each stream behind the one before; not all of it is
/// there where it does not fit.
struct Unpacked {
  WorkingMesh work;
  std::span<PackedNormal> normals;  // room for them even where the mesh has none yet
  bool fits = false;
};

Unpacked unpack_mesh(const MeshView& mesh, std::uint32_t faces, bool with_sources, Arena& arena) {
  Unpacked u;
  bool fits = true;
  const auto take = [&](auto& stream, std::size_t count) {
    stream = arena.allocate<typename std::remove_reference_t<decltype(stream)>::value_type>(count);
    fits = fits && stream.size() == count;
  };
  const std::size_t vertices = mesh.positions.size();
  take(u.work.positions, vertices);
  take(u.normals, vertices);
  take(u.work.colours, mesh.colours.size());
  take(u.work.texture_coordinates, mesh.textured ? vertices : 0);
  take(u.work.indices, std::size_t{3} * faces);
  take(u.work.groups, mesh.groups.size());
  take(u.work.source_vertices, with_sources ? vertices : 0);
  u.fits = fits;
  if (!fits) return u;
  const auto fill = [](auto to, auto from) {
    for (std::size_t i = 0; i < from.size(); ++i) to[i] = from[i];
  };
  fill(u.work.positions, mesh.positions);
  fill(u.normals, mesh.normals);
  fill(u.work.colours, mesh.colours);
  if (mesh.textured) fill(u.work.texture_coordinates, mesh.texture_coordinates);
  if (!mesh.normals.empty()) u.work.normals = u.normals;
  u.work.edge_values = mesh.edge_values;
  u.work.vertex_count = static_cast<std::uint32_t>(vertices);
  u.work.face_count = faces;
  mesh.write_proper_faces(u.work.indices, u.work.groups);
  return u;
}

/// Whether indices into ROM take less RAM than the vertices that are left with indices of their own. Of a mesh without
/// normals in ROM all those made count, as they are numbered like its vertices.
bool smaller_in_place(const MeshView& mesh, const WorkingMesh& work) {
  const auto all = static_cast<std::uint32_t>(mesh.positions.size());
  const std::uint64_t indices = std::uint64_t{3} * work.face_count;
  const std::uint64_t in_place = indices * index_bytes(all) + (mesh.normals.empty() ? std::uint64_t{4} * all : 0);
  const std::uint64_t apart =
      indices * index_bytes(work.vertex_count) + std::uint64_t{work.vertex_count} * vertex_bytes(mesh, true);
  return in_place <= apart;
}

/// Indices and group words, the last of every block here; they slide down in memory.
void append_faces(const WorkingMesh& work, CopyMesh& out, BlockWriter& block) {
  out.topology = command::Topology::kTriangles;
  out.index_count = 3 * work.face_count;
  out.faces = work.face_count;
  const auto wide = work.indices.first(out.index_count);
  const std::uint32_t size = narrow_indices(wide, out.vertex_count);
  out.index_format = size == 2 ? command::IndexFormat::kU16 : command::IndexFormat::kU32;
  out.index_offset = block.append(
      std::span<const std::byte>(reinterpret_cast<const std::byte*>(wide.data()), std::size_t{out.index_count} * size));
  if (out.index_offset == kNoStream) out.index_offset = 0;  // no faces: the empty stream may stand anywhere
  out.has_group_words = !work.groups.empty();
  for (const MaterialGroup& group : work.groups) {
    const std::uint32_t face_end = group.face_end;
    block.append(std::span<const std::uint32_t>(&face_end, 1));
  }
}

/// Slides what is left of the working mesh's streams together at the start of the free memory, where its positions
/// stand already: each stream moves to a lower address than it had.
void add_with_vertices(const MeshView& mesh, const WorkingMesh& work, RamCopy& copy) {
  BlockWriter block(copy.free_memory());
  CopyMesh out = described(mesh);
  out.vertex_count = work.vertex_count;
  const auto append_left = [&](auto stream) {
    return block.append(
        std::span<const typename decltype(stream)::element_type>(stream.first(stream.empty() ? 0 : work.vertex_count)));
  };
  append_left(work.positions);
  out.normal_offset = append_left(work.normals);
  out.colour_offset = append_left(work.colours);
  out.texture_coordinate_offset = append_left(work.texture_coordinates);
  append_faces(work, out, block);
  copy.add(mesh.number, out, block.bytes());
}

/// The faces alone, of vertices in ROM; with normals, numbered as those are, where ROM has none.
void add_in_place(const MeshView& mesh, const Unpacked& u, Arena& arena, RamCopy& copy) {
  const auto indices = u.work.indices.first(std::size_t{3} * u.work.face_count);
  for (std::uint32_t& v : indices) v = u.work.source_vertices[v];
  const bool made = mesh.normals.empty() && make_smooth_normals(mesh.positions, indices, u.normals, arena);
  copy.note_use(arena.high_water());
  BlockWriter block(copy.free_memory());
  CopyMesh out = described(mesh);
  out.vertices_in_rom = true;
  out.vertex_count = static_cast<std::uint32_t>(mesh.positions.size());
  if (made) out.normal_offset = block.append(std::span<const PackedNormal>(u.normals));
  append_faces(u.work, out, block);
  copy.add(mesh.number, out, block.bytes());
}

void add_thinned(const MeshView& mesh, Unpacked& u, Arena& arena, RamCopy& copy, BuildReport& report) {
  if (!u.work.source_vertices.empty() && smaller_in_place(mesh, u.work)) {
    report.bytes_left_in_rom = u.work.vertex_count * vertex_bytes(mesh, !mesh.normals.empty());
    add_in_place(mesh, u, arena, copy);
    return;
  }
  const auto positions = u.work.positions.first(u.work.vertex_count);
  const auto indices = u.work.indices.first(std::size_t{3} * u.work.face_count);
  if (u.work.normals.empty() && make_smooth_normals(positions, indices, u.normals.first(positions.size()), arena))
    u.work.normals = u.normals;
  copy.note_use(arena.high_water());
  add_with_vertices(mesh, u.work, copy);
}

}  // namespace

bool copy_thinned(const MeshView& mesh, std::uint32_t faces, const Decision& decision, RamCopy& copy, Clock& clock,
                  BuildReport& report) {
  Arena arena(copy.free_memory());
  Unpacked u = unpack_mesh(mesh, faces, may_leave_vertices(decision, copy), arena);
  if (!u.fits) return false;
  const SimplifyOptions options{.target_faces = decision.target_faces,
                                .placement = decision.placement,
                                .method = decision.method,
                                .edge_removal = mesh.edge_removal(),
                                .vertex_deletion = mesh.vertex_deletion()};
  const auto outcome = simplify(u.work, options, arena);
  if (!outcome.ok()) return false;
  report.outcome = outcome->stop == StopReason::kQuotaReached ? BuildOutcome::kBuilt : BuildOutcome::kQuotaNotReached;
  report.collapsed = true;
  report.max_error = outcome->max_error;
  clock.charge(CpuWork::kVertexCopied, mesh.positions.size());
  clock.charge(CpuWork::kConnectivityBuilt, faces);
  clock.charge(CpuWork::kEdgeCosted, outcome->work.edges_costed);
  clock.charge(CpuWork::kQueueOperation, outcome->work.queue_operations);
  clock.charge(CpuWork::kEdgeCollapsed, outcome->work.collapses);
  // A mesh whose faces were all degenerate leaves nothing.
  if (u.work.vertex_count > 0) add_thinned(mesh, u, arena, copy, report);
  return true;
}

std::uint64_t unpacked_bytes(const MeshView& mesh, std::uint32_t faces, const Decision& decision, const RamCopy& copy) {
  return std::uint64_t{faces} * 12 + mesh.groups.size() * sizeof(MaterialGroup) +
         (may_leave_vertices(decision, copy) ? std::uint64_t{4} * mesh.positions.size() : 0);
}

}  // namespace usuzumi::firmware
