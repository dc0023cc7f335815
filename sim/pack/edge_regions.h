// The author's values of edges, region by region.
#pragma once

#include "sim/pack/model.h"

namespace usuzumi::sim {

/// Sets the edge values of meshes whose tags have regions, where their method is edge removal; a note tells of the
/// others. A region is the vertices of a group of the mesh (case of letters ignored, as exporters change it), or a
/// whole mesh or node of that name (an OBJ file's `g`), or the vertices of a material's faces. A later region counts
/// over an earlier one. Throws Error kBadInput for a region that is in none of the meshes it is given to.
void apply_regions(Model& model);

}  // namespace usuzumi::sim
