// Chains of layers, word by word: what lies in section LAYR of drawing data, or in RAM when made at boot. The page
// firmware/drawing_data/README.md has the byte tables.
//
// One run of 32-bit little-endian words, without pointers or offsets, so that it may lie anywhere:
//     LayerChainHeader | Layer per layer | LayerGroup per group | LayerStep per step | slot per face |
//     group per removed face (only with several groups) | LayerChange per change | positions, normals, colours and
//     texture coordinates of the added vertices (those that the mesh has) | LayerPair per pair
#pragma once

#include <cstdint>

namespace usuzumi::firmware::format {

inline constexpr std::uint32_t kMaxLayers = 16;
/// Corner numbers are 3 * face + k in 32 bits.
inline constexpr std::uint32_t kMaxLayerFaces = (1u << 28) - 1;

/// Streams that the added vertices have; positions they always have.
inline constexpr std::uint32_t kLayerNormals = 1, kLayerColours = 2, kLayerTextureCoordinates = 4;

struct LayerChainHeader {            // 56 bytes
  std::uint32_t bytes = 0;           // of the whole chain, this header included
  std::uint32_t vertex_count = 0;    // of the mesh as given
  std::uint32_t face_count = 0;      // proper faces of the mesh as given: those with their corners at three places
  std::uint32_t group_count = 1;     // materials; 1 where the mesh has no groups
  std::uint32_t attributes = 0;      // kLayerNormals and so on: the mesh's own streams
  std::uint32_t method = 0;          // firmware::Method that made it
  std::uint32_t placement = 0;       // firmware::Placement, where the method is QEM
  std::uint32_t layer_count = 0;     // 1 .. kMaxLayers
  std::uint32_t step_count = 0;
  std::uint32_t change_count = 0;
  std::uint32_t added_count = 0;     // vertices that the method made: store vertices from vertex_count on
  std::uint32_t pair_count = 0;
  std::uint32_t reserved[2] = {};    // must be 0
};
static_assert(sizeof(LayerChainHeader) == 56);

/// Layer 0 is the mesh as given, each further one has fewer faces; the last is the end of the chain.
struct Layer {                       // 16 bytes
  std::uint32_t step = 0;            // how many steps lead to it from layer 0
  std::uint32_t faces = 0;           // that it has
  std::uint32_t pair_end = 0;        // its vertices' correspondents in the next layer: pairs from the end before
  std::uint32_t quota_millionths = 0;  // what was asked for; of the mesh's faces
};
static_assert(sizeof(Layer) == 16);

/// Slots of the group's faces: from the end of the group before to this.
struct LayerGroup {                  // 4 bytes
  std::uint32_t face_end = 0;
};
static_assert(sizeof(LayerGroup) == 4);

struct LayerStep {                   // 8 bytes
  std::uint32_t change_end = 0;      // its changes: from the end of the step before to this
  std::uint32_t faces_after = 0;
};
static_assert(sizeof(LayerStep) == 8);

/// Corner 3 * slot + k of a face that outlives the step named store vertex `from` and names `to` after it.
struct LayerChange {                 // 12 bytes
  std::uint32_t corner = 0, from = 0, to = 0;
};
static_assert(sizeof(LayerChange) == 12);

/// Store vertex `from` of a layer is not in the next; what it stood for is at `to` there. Rising by `from` in a layer.
struct LayerPair {                   // 8 bytes
  std::uint32_t from = 0;
  std::uint32_t to = 0;              // a vertex; with kPairPlaceOnly
  std::uint32_t vertex() const;
  bool place_only() const;
};
static_assert(sizeof(LayerPair) == 8);
/// Added to LayerPair::to: `from` goes to that place, but keeps its normal, colour and texture coordinate. None of its
/// faces is in the next layer, and `to` is on another piece of texture.
inline constexpr std::uint32_t kPairPlaceOnly = 1u << 31;
inline constexpr std::uint32_t kMaxStoreVertices = 1u << 31;
inline std::uint32_t LayerPair::vertex() const { return to & ~kPairPlaceOnly; }
inline bool LayerPair::place_only() const { return (to & kPairPlaceOnly) != 0; }

}  // namespace usuzumi::firmware::format
