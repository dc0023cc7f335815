// Blocks of the RAM copy that take vertices from ROM as they are: a whole mesh, or a point or a line in its place.
// Private to this folder.
#pragma once

#include <cstdint>

#include "firmware/drawing_data/mesh_view.h"
#include "firmware/thinning/policy.h"
#include "firmware/thinning/ram_copy.h"
#include "hal/clock.h"

namespace usuzumi::firmware {

/// Of one index into so many vertices.
constexpr std::uint32_t index_bytes(std::uint32_t vertex_count) { return vertex_count > 65536 ? 4 : 2; }

/// Of a vertex in the streams that the mesh has; `normals` where some are made for it.
std::uint32_t vertex_bytes(const MeshView& mesh, bool normals);

/// What a mesh's blocks have in common.
CopyMesh described(const MeshView& mesh);

/// Level 1: the mesh as it stands in ROM. False where RAM has no room for it.
bool copy_as_is(const MeshView& mesh, std::uint32_t faces, RamCopy& copy, Clock& clock);

/// Levels 4 and 5 ([0023]), as `action` says. False where RAM has no room for it.
bool keep_vertices(const MeshView& mesh, Action action, RamCopy& copy, Clock& clock);

}  // namespace usuzumi::firmware
