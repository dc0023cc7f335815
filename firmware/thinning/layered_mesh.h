// Blocks of the RAM copy that keep a mesh's chain of layers at hand: built once, then moved along the chain by replay.
//
// The block holds every slot's corners and the counts of live faces (layer_chain.h); the whole store of vertices too
// where they move, or where the chain has vertices that ROM has not. So it is larger than a thinned copy, and any
// number of faces is a replay away.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/drawing_data/mesh_view.h"
#include "firmware/layers/layer_chain.h"
#include "firmware/layers/layer_choice.h"
#include "firmware/thinning/mesh_builder.h"
#include "firmware/thinning/ram_copy.h"
#include "hal/clock.h"
#include "hal/status.h"

namespace usuzumi::firmware {

/// A place on a chain: the faces after `step` steps, their vertices `weight` of the way from layer `layer` to the next.
struct ChainPlace {
  std::uint32_t step = 0;
  std::uint32_t layer = 0;  // the last that is not beyond `step`
  float weight = 0;         // 0 to 1; 0 where the vertices do not move
  friend bool operator==(const ChainPlace&, const ChainPlace&) = default;
};

/// The first place with at most `faces` faces, its vertices where they are in ROM or were put by the method.
ChainPlace place_of_faces(const LayerChainView& chain, std::uint32_t faces);
/// The middle layer `layer`, in [0, layer_count() - 1]; 1.25 is a quarter of the way from layer 1 to layer 2.
ChainPlace place_of_layer(const LayerChainView& chain, float layer);
/// The other way round; where the vertices do not move, by the number of faces.
float layer_of_place(const LayerChainView& chain, const ChainPlace& place);

/// A level-3 mesh with a chain, in the table that Thinning keeps of them.
struct LayeredMesh {
  std::uint32_t mesh = 0;             // its number
  std::span<const std::byte> chain;   // in ROM, or in RAM where it was made at boot
  Box box;
  LayerMemory memory;                 // of LayerMode::kAutomatic
  ChainPlace place;                   // of the mesh's block, while it is one of a chain
  bool sound = true;                  // false: it contradicts itself, and is not used
  bool tried = false;                 // `sound` is known by LayerReplay::check()

  LayerChainView view() const { return LayerChainView::of_checked(chain); }
};

/// Bytes of the block. `vertices_move`, or ROM not on the bus: with vertices in RAM, whatever the method.
std::uint64_t layered_bytes(const MeshView& mesh, const LayerChainView& chain, bool vertices_move, bool rom_on_bus);

/// Adds the block of `mesh` to the copy, at the chain's beginning. False, with nothing added, where RAM has no room, or
/// the chain turns out to contradict itself (layered.sound).
bool copy_layered(const MeshView& mesh, LayeredMesh& layered, bool vertices_move, RamCopy& copy, Clock& clock,
                  BuildReport& report);

/// Moves the mesh's block, which copy_layered() has added, to `place`. Linear in what changes. Whether anything did.
bool move_layered(const MeshView& mesh, LayeredMesh& layered, const ChainPlace& place, RamCopy& copy, Clock& clock);

}  // namespace usuzumi::firmware
