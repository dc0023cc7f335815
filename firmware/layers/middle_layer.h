// Middle layers: the vertices between two layers of a chain (US 6,396,952, p. 31-35, fig. 11).
//
// A middle layer has the faces of layer n. Each vertex of layer n that layer n + 1 has not lies on the straight line to
// its correspondent there; texture coordinates, colours and normals go with it, unless its faces are all gone in layer
// n + 1 and the correspondent is on another piece of the texture: they would show all that lies between in a few
// frames. At weight 0 the picture is layer n's; at weight 1 it is layer n + 1's, as the faces that are not in it have
// shrunk to nothing (which is why vertex deletion for layers fills by fans alone: SimplifyOptions::for_layers).
#pragma once

#include <cstdint>
#include <span>

#include "firmware/layers/layer_chain.h"
#include "hal/vec.h"

namespace usuzumi::firmware {

/// Vertex streams in RAM, store_count() entries each; absent ones are empty.
struct StoreTarget {
  std::span<Vec3> positions;
  std::span<PackedNormal> normals;
  std::span<Rgba8> colours;
  std::span<TexCoord> texture_coordinates;
};

/// The whole store: `given`, the mesh's own streams, then what the chain added.
void write_store(const LayerChainView& chain, const VertexStreams& given, const StoreTarget& out);

/// Writes those vertices of `out`, which holds the store, that move between layers n and n + 1 < layer_count(), as they
/// are at `weight` (0 to 1; beyond is clamped, NaN counts as 0). At 0 they are the store's own again, byte for byte; at
/// 1 they are their correspondents. Returns how many were written. Colours are mixed as they are stored, in steps of
/// 1/256, opacity too; normals turn the shorter way, evenly. Of pairs of a place only (format::kPairPlaceOnly) the
/// position alone is written.
std::uint32_t write_middle_layer(const LayerChainView& chain, const VertexStreams& given, std::uint32_t n, float weight,
                                 const StoreTarget& out);

}  // namespace usuzumi::firmware
