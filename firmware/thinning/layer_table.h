// The table of those meshes that have a chain of layers: found in ROM, made at boot, and where on it each is wanted.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/drawing_data/drawing_data.h"
#include "firmware/layers/layer_chain.h"
#include "firmware/layers/layer_choice.h"
#include "firmware/thinning/layered_mesh.h"
#include "firmware/thinning/policy.h"
#include "hal/arena.h"
#include "hal/status.h"

namespace usuzumi::firmware {

class LayerTable {
 public:
  /// Takes the table from `ram`, and the chains of `boot_layers`: see Thinning::begin().
  Status begin(const DrawingData& data, Arena& ram, std::span<const std::uint32_t> boot_layers);

  /// Rising by mesh; those without a chain have none because it could not be made.
  std::span<LayeredMesh> meshes() { return meshes_; }
  std::span<const LayeredMesh> meshes() const { return meshes_; }
  /// Mesh n's; null where it has no chain.
  LayeredMesh* find(std::uint32_t n);
  const LayeredMesh* find(std::uint32_t n) const { return const_cast<LayerTable*>(this)->find(n); }

 private:
  std::uint64_t make(const MeshView& mesh, std::span<const std::uint32_t> quotas, std::uint64_t needed, Arena& ram,
                     LayeredMesh& layered);

  std::span<LayeredMesh> meshes_;
};

/// Whether a mesh as decided can be drawn from its chain: made by the method and placement that are asked for, and, in
/// LayerMode::kFaces, down to as few faces.
bool chain_serves(const LayeredMesh& layered, LayerMode mode, const Decision& decision);

/// Where the mesh is wanted on its chain; of LayerMode::kAutomatic its memory goes on.
ChainPlace place_wanted(LayeredMesh& layered, const LayerSettings& settings, const Decision& decision,
                        const View& view);

/// What kAutomatic remembers of a mesh that was drawn whole: that it sets out from its first layer.
LayerMemory memory_of_whole(const LayeredMesh& layered, const View& view);

}  // namespace usuzumi::firmware
