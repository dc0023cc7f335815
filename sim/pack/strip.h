// Triangles as one triangle strip, which is all that the bare layout can say about faces.
#pragma once

#include <vector>

#include "sim/pack/model.h"

namespace usuzumi::sim {

/// Positions in strip order. Face k of the strip (odd faces with their first two vertices swapped) is, in some order,
/// each face of `mesh` once with its winding, and faces between the runs that repeat a position and so draw nothing.
/// Faces of `mesh` that repeat a position are left out.
std::vector<Vec3> triangle_strip(const Mesh& mesh);

}  // namespace usuzumi::sim
