// Normals for meshes that came without: the patent's records have none, and light needs them.
#pragma once

#include <cstdint>
#include <span>

#include "hal/arena.h"
#include "hal/vec.h"

namespace usuzumi::firmware {

/// Smooth normals: each vertex takes the sum of its faces' area vectors. `indices` hold three numbers a face, each
/// below positions.size(); vertices without a face of any area point along +z. False when `scratch` has no room for 12
/// bytes a vertex; `out` (as long as positions) is then untouched. `scratch` is left as it was found.
bool make_smooth_normals(std::span<const Vec3> positions, std::span<const std::uint32_t> indices,
                         std::span<PackedNormal> out, Arena& scratch);

}  // namespace usuzumi::firmware
