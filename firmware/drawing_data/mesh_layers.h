// Chains of layers of meshes as they lie in drawing data: checking one that is there, making one that is not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/drawing_data/mesh_view.h"
#include "firmware/layers/layer_chain.h"
#include "firmware/simplify/simplify.h"
#include "hal/arena.h"
#include "hal/status.h"

namespace usuzumi::firmware {

/// What a chain of `mesh` must agree with. `faces` is its proper_face_count().
LayerChainMesh layer_chain_mesh(const MeshView& mesh, std::uint32_t faces);

/// LayerChainView::open() on mesh.layers, and that every face's slot lies in its own group. `where` counts from the
/// chain's first byte.
Status check_mesh_layers(const MeshView& mesh);

/// Puts the proper faces of `mesh` into the index buffer of a replay, which is then at state 0.
void begin_replay(const MeshView& mesh, LayerReplay& replay);

/// Thins `mesh` by its own method, down to the last of `quotas_millionths`, and leaves its chain in `arena`: what is
/// allocated there on return. `quotas_millionths` are those of LayerChainInput; `placement` is that of QEM.
/// kUnsupported: the mesh has no normals, or repeats vertices (pack joins them), or has too many faces for its method.
/// kResourceExhausted: `arena` is too small. kInvalidArgument: the quotas do not fall. Then `arena` is as it was.
Result<std::span<const std::byte>> make_mesh_layers(const MeshView& mesh, std::uint32_t faces,
                                                    std::span<const std::uint32_t> quotas_millionths,
                                                    Placement placement, Arena& arena);

/// Bytes of arena that make_mesh_layers() needs in practice.
std::uint64_t mesh_layers_bytes(const MeshView& mesh, std::uint32_t faces);

}  // namespace usuzumi::firmware
