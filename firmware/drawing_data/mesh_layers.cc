#include "firmware/drawing_data/mesh_layers.h"

#include <algorithm>
#include <cstring>

#include "firmware/layers/layer_chain_builder.h"
#include "firmware/simplify/collapse_log.h"

namespace usuzumi::firmware {
namespace {

/// Calls visit(f, corners, group) for the proper faces in order; f counts them.
template <class Visit>
void for_each_proper_face(const MeshView& mesh, Visit&& visit) {
  std::uint32_t proper = 0, corners[3], g = 0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    while (g + 1 < mesh.group_count() && f >= mesh.groups[g].face_end) ++g;
    if (mesh.proper_face(f, corners)) visit(proper++, corners, g);
  }
}

/// The mesh unpacked as the method wants it; false where it does not fit.
bool unpack(const MeshView& mesh, std::uint32_t faces, Arena& arena, WorkingMesh& work) {
  bool fits = true;
  const auto copied = [&](auto from) {
    const auto to = arena.allocate<typename decltype(from)::value_type>(from.size());
    fits = fits && to.size() == from.size();
    if (fits) std::copy(from.begin(), from.end(), to.begin());
    return to;
  };
  work.positions = copied(mesh.positions);
  work.normals = copied(mesh.normals);
  work.colours = copied(mesh.colours);
  work.texture_coordinates = copied(mesh.texture_coordinates);
  work.edge_values = mesh.edge_values;
  work.groups = arena.allocate<MaterialGroup>(mesh.groups.size());
  work.indices = arena.allocate<std::uint32_t>(std::size_t{3} * faces);
  if (!fits || work.groups.size() != mesh.groups.size() || work.indices.size() != std::size_t{3} * faces) return false;
  mesh.write_proper_faces(work.indices, work.groups);
  work.vertex_count = static_cast<std::uint32_t>(mesh.positions.size());
  work.face_count = faces;
  return true;
}

Status no_room() { return {StatusCode::kResourceExhausted, "no room to make a mesh's layers; faces", 0}; }

/// Everything that is done in memory that is given back: the chain is at the front of `chain` on return, its bytes are
/// the answer.
Result<std::uint32_t> make_chain(const MeshView& mesh, std::uint32_t faces, std::span<const std::uint32_t> quotas,
                                 Placement placement, Arena& arena, std::span<std::byte>& chain) {
  WorkingMesh work;
  CollapseLog::Memory memory;
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  if (!unpack(mesh, faces, arena, work) || !allocate_collapse_log(arena, vertices, faces, memory)) return no_room();
  CollapseLog log(memory, vertices, faces);
  const auto groups = arena.allocate<MaterialGroup>(work.groups.size());
  if (groups.size() != work.groups.size()) return no_room();
  std::copy(work.groups.begin(), work.groups.end(), groups.begin());

  SimplifyOptions options;
  options.target_faces = layer_faces(faces, quotas.back());
  options.placement = placement;
  options.method = mesh.method;
  options.edge_removal = mesh.edge_removal();
  options.vertex_deletion = mesh.vertex_deletion();
  options.for_layers = true;
  options.log = &log;
  const auto outcome = simplify(work, options, arena);
  if (!outcome.ok()) return outcome.status();

  // The working indices are spent: they serve to try the chain.
  const auto live = arena.allocate<std::uint32_t>(mesh.group_count());
  const std::size_t half = arena.available() / 8 * 4;
  chain = arena.allocate<std::byte>(half, 4);
  if (live.size() != mesh.group_count() || chain.size() != half) return no_room();
  const LayerChainInput input{layer_chain_mesh(mesh, faces), groups, quotas, mesh.method, placement, &log};
  const auto bytes = build_layer_chain(input, arena, chain);
  if (!bytes.ok()) return bytes;
  const LayerChainView view = LayerChainView::of_checked(chain);
  LayerReplay replay(view, std::as_writable_bytes(work.indices), 4, live);
  begin_replay(mesh, replay);
  const Status status = replay.check();
  if (!status.ok())
    return Status{StatusCode::kUnsupported, "vertices that are alike in everything must be joined before layers; step",
                  status.where};
  return bytes;
}

}  // namespace

LayerChainMesh layer_chain_mesh(const MeshView& mesh, std::uint32_t faces) {
  const auto bit = [](bool there, std::uint32_t stream) { return there ? stream : 0; };
  return {static_cast<std::uint32_t>(mesh.positions.size()), faces, mesh.group_count(),
          bit(!mesh.normals.empty(), format::kLayerNormals) | bit(!mesh.colours.empty(), format::kLayerColours) |
              bit(!mesh.texture_coordinates.empty(), format::kLayerTextureCoordinates)};
}

Status check_mesh_layers(const MeshView& mesh) {
  const auto opened = LayerChainView::open(mesh.layers, layer_chain_mesh(mesh, mesh.proper_face_count()));
  if (!opened.ok()) return opened.status();
  Status status = ok_status();
  for_each_proper_face(mesh, [&](std::uint32_t f, const std::uint32_t*, std::uint32_t g) {
    if (opened->slot(f) >= opened->group_begin(g) && opened->slot(f) < opened->group_end(g)) return;
    status = {StatusCode::kDataLoss, "chain of layers has a face among those of another material; chain at byte offset",
              0};
  });
  return status;
}

void begin_replay(const MeshView& mesh, LayerReplay& replay) {
  replay.begin();
  for_each_proper_face(
      mesh, [&](std::uint32_t f, const std::uint32_t* corners, std::uint32_t) { replay.set_face(f, corners); });
}

Result<std::span<const std::byte>> make_mesh_layers(const MeshView& mesh, std::uint32_t faces,
                                                    std::span<const std::uint32_t> quotas, Placement placement,
                                                    Arena& arena) {
  if (mesh.normals.empty())
    return Status{StatusCode::kUnsupported, "a mesh without normals has no layers; mesh number", mesh.number};
  if (!layer_quotas_fall(quotas))
    return Status{StatusCode::kInvalidArgument, "layers must fall from 1,000,000 millionths; their number is",
                  static_cast<std::uint32_t>(quotas.size())};
  const std::size_t mark = arena.used();
  std::span<std::byte> made;
  const auto bytes = make_chain(mesh, faces, quotas, placement, arena, made);
  arena.rewind(mark);
  if (!bytes.ok()) return bytes.status();
  const auto chain = arena.allocate<std::byte>(*bytes, 4);  // in front of where it was made
  std::memmove(chain.data(), made.data(), *bytes);
  return std::span<const std::byte>(chain);
}

std::uint64_t mesh_layers_bytes(const MeshView& mesh, std::uint32_t faces) {
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const CollapseLogSizes log = collapse_log_sizes(vertices, faces);
  const std::uint64_t work = std::uint64_t{vertices} * 32 + std::uint64_t{faces} * 12;
  const std::uint64_t logged = std::uint64_t{log.steps} * sizeof(CollapseStep) +
                               std::uint64_t{log.changes} * sizeof(CornerChange) +
                               std::uint64_t{log.successions} * sizeof(Succession) +
                               std::uint64_t{log.added} * sizeof(StoreVertex) + 4 * (std::uint64_t{faces} + vertices);
  const std::uint64_t scratch =
      simplify_scratch_bytes(mesh.method, vertices, faces, !mesh.texture_coordinates.empty());
  // Half of what is left when the method is done takes the chain, which is no larger than the log and the store.
  const std::uint64_t chain = 2 * (logged + std::uint64_t{faces} * 8);
  return work + logged + (scratch > chain ? scratch : chain) + 4096;
}

}  // namespace usuzumi::firmware
