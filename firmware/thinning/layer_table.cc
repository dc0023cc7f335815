#include "firmware/thinning/layer_table.h"

#include <algorithm>
#include <new>

#include "firmware/drawing_data/mesh_layers.h"
#include "firmware/layers/layer_chain_builder.h"
#include "firmware/thinning/ram_copy.h"
#include "firmware/thinning/whole_mesh.h"

namespace usuzumi::firmware {
namespace {

/// Every mesh is copied whole in no more bytes than this.
std::uint64_t whole_bytes(const MeshView& mesh) {
  return std::uint64_t{mesh.positions.size()} * vertex_bytes(mesh, true) + (mesh.indices.size() + 3) / 4 * 4;
}

/// The same with its chain, whatever the mode.
std::uint64_t largest_block_bytes(const MeshView& mesh, std::span<const std::byte> chain) {
  return layered_bytes(mesh, LayerChainView::of_checked(chain), true, false);
}

/// What thinning a mesh by its method takes at most beside the copies of all meshes.
std::uint64_t thinning_bytes(const MeshView& mesh) {
  const std::uint32_t faces = mesh.face_count();
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  return whole_bytes(mesh) + std::uint64_t{faces} * 12 + mesh.groups.size() * sizeof(MaterialGroup) +
         std::uint64_t{vertices} * 4 + simplify_scratch_bytes(mesh.method, vertices, faces, mesh.textured);
}

/// RAM that has to be left for the copy: every mesh whole, or its block of layers where that is larger, and what
/// thinning any one takes.
std::uint64_t bytes_to_leave(const DrawingData& data) {
  std::uint64_t blocks = std::uint64_t{data.mesh_max()} * RamCopy::kTableBytes, largest_thinning = 0;
  data.for_each_mesh([&](const MeshView& mesh) {
    const std::uint64_t block = mesh.layers.empty() ? 0 : largest_block_bytes(mesh, mesh.layers);
    blocks += std::max(whole_bytes(mesh), block);
    if (mesh.level == Level::kCollapse) largest_thinning = std::max(largest_thinning, thinning_bytes(mesh));
  });
  return blocks + largest_thinning;
}

/// Normals are made for each thinned copy anew where ROM has none; a chain knows none of them.
bool may_have_layers(const MeshView& mesh, bool made_at_boot) {
  return mesh.level == Level::kCollapse && !mesh.normals.empty() && (!mesh.layers.empty() || made_at_boot);
}

}  // namespace

Status LayerTable::begin(const DrawingData& data, Arena& ram, std::span<const std::uint32_t> boot_layers) {
  meshes_ = {};
  const bool make_some = !boot_layers.empty();
  if (make_some && !layer_quotas_fall(boot_layers))
    return {StatusCode::kInvalidArgument, "layers must fall from 1,000,000 millionths; their number is",
            static_cast<std::uint32_t>(boot_layers.size())};
  std::uint32_t count = 0;
  data.for_each_mesh([&](const MeshView& mesh) {
    if (may_have_layers(mesh, make_some)) ++count;
  });
  meshes_ = ram.allocate<LayeredMesh>(count);
  if (meshes_.size() != count)
    return {StatusCode::kResourceExhausted, "RAM has no room for the table of meshes with layers; meshes", count};
  std::uint64_t needed = make_some ? bytes_to_leave(data) : 0;
  std::uint32_t i = 0;
  data.for_each_mesh([&](const MeshView& mesh) {
    if (!may_have_layers(mesh, make_some)) return;
    LayeredMesh& layered = *new (&meshes_[i++]) LayeredMesh{};
    layered.mesh = mesh.number;
    layered.box = box_of(mesh.positions);
    layered.chain = mesh.layers;
    if (layered.chain.empty()) needed += make(mesh, boot_layers, needed, ram, layered);
  });
  return ok_status();
}

/// Makes the mesh's chain where RAM then still holds `needed` bytes and what its block is larger than the mesh; returns
/// that difference.
std::uint64_t LayerTable::make(const MeshView& mesh, std::span<const std::uint32_t> quotas, std::uint64_t needed,
                               Arena& ram, LayeredMesh& layered) {
  const std::size_t mark = ram.used();
  const auto made = make_mesh_layers(mesh, mesh.proper_face_count(), quotas, Placement::kOptimal, ram);
  if (!made.ok()) return 0;  // it is thinned by its method whenever asked for
  const std::uint64_t whole = whole_bytes(mesh), block = largest_block_bytes(mesh, *made);
  const std::uint64_t more = block > whole ? block - whole : 0;
  if (needed + more > ram.available()) {
    ram.rewind(mark);
    return 0;
  }
  layered.chain = *made;
  return more;
}

LayeredMesh* LayerTable::find(std::uint32_t n) {
  const auto before = [](const LayeredMesh& layered, std::uint32_t number) { return layered.mesh < number; };
  const auto at = std::lower_bound(meshes_.begin(), meshes_.end(), n, before);
  return at != meshes_.end() && at->mesh == n && !at->chain.empty() ? &*at : nullptr;
}

bool chain_serves(const LayeredMesh& layered, LayerMode mode, const Decision& decision) {
  const LayerChainView chain = layered.view();
  const format::LayerChainHeader& made = chain.header();
  if (made.method != static_cast<std::uint32_t>(decision.method)) return false;
  if (decision.method == Method::kQem && made.placement != static_cast<std::uint32_t>(decision.placement)) return false;
  return mode != LayerMode::kFaces || decision.target_faces >= chain.last_faces();
}

ChainPlace place_wanted(LayeredMesh& layered, const LayerSettings& settings, const Decision& decision,
                        const View& view) {
  const LayerChainView chain = layered.view();
  // Whole faces alone would move a small mesh in steps: by a tenth of a layer on the way from 28 faces to 18.
  const float of_quota = layer_of_faces(chain, static_cast<float>(decision.target_faces) + decision.target_fraction);
  switch (settings.mode) {
    case LayerMode::kFaces: return place_of_faces(chain, decision.target_faces);
    case LayerMode::kQuota: return place_of_layer(chain, of_quota);
    case LayerMode::kAutomatic: break;
  }
  const float coarsest = decision.quota_given ? of_quota : static_cast<float>(chain.layer_count() - 1);
  return place_of_layer(chain, choose_layer(chain, screen_extent(layered.box, view), view, settings.attention,
                                            settings.choice, coarsest, layered.memory));
}

LayerMemory memory_of_whole(const LayeredMesh& layered, const View& view) {
  const ScreenExtent extent = screen_extent(layered.box, view);
  return {true, 0, !extent.beyond_eye, extent.centre_x, extent.centre_y};
}

}  // namespace usuzumi::firmware
