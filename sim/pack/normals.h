// Normals where a file has none, or none that can be used.
#pragma once

#include "sim/pack/model.h"

namespace usuzumi::sim {

/// Gives every vertex a unit normal. Normals that the file has are kept (and made unit). The others are the
/// area-weighted mean of the normals of the faces that meet at the vertex's position and lie within 60 degrees of the
/// face in hand: a smooth surface is shaded smooth, a box keeps its edges. Vertices are parted where their faces want
/// different normals. 60 degrees is arbitrary; it is a little under the angle of a hexagonal bolt head's sides.
void complete_normals(Mesh& mesh);

/// Whether some edge has one face only, so that the back of the surface can be seen. By position, not by vertex number.
bool has_open_border(const Mesh& mesh);

}  // namespace usuzumi::sim
