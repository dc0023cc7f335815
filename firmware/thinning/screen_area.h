// Area of a mesh on the screen, the measure behind levels 2 and 3 (JP2015-22462A [0038], fig. 7 S703).
#pragma once

#include <cstdint>

#include "firmware/drawing_data/drawing_data.h"
#include "firmware/scene/view.h"
#include "hal/vec.h"

namespace usuzumi::firmware {

/// Pixels that the mesh's faces cover: each face is clipped to the view volume and projected, and the areas are summed.
/// Faces of one mesh that hide each other all count, and so does what other meshes hide: the measure needs no picture.
/// Of a one-sided mesh the faces turned away do not count, as they are never drawn. Of a two-sided mesh the facing with
/// the larger sum counts, so that a closed body is not measured twice.
/// The sum ends early once it exceeds `stop_above`: the answer is then a lower bound above it. `faces_measured` rises
/// by the faces looked at.
float screen_area_px(const MeshView& mesh, const View& view, float stop_above, std::uint64_t& faces_measured);

}  // namespace usuzumi::firmware
