// Counts on the CPU, in double precision, the triangles that leave something to rasterize; OpenGL has no query for it.
#pragma once

#include <cstdint>

#include "gfx_subsystem/engine/state.h"

namespace usuzumi::gfx {

/// Triangles of the draw left after clipping to the view volume, culling and zero area. A triangle cut into several
/// counts once. Area is that of the corners snapped to 1/256 pixel, so that slivers no rasterizer can see count as
/// empty.
std::uint64_t count_faces_drawn(const EngineState& state, const DrawCall& call);

}  // namespace usuzumi::gfx
