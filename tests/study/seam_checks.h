// What may go wrong with a textured surface that was thinned: seams torn, holes opened.
#pragma once

#include <cstddef>

#include "tests/support/mesh_shapes.h"

namespace usuzumi::study {

/// Positions at which the faces around disagree about the texture coordinate.
std::size_t count_seam_vertices(const testing::Mesh& mesh);

/// Edges of one face alone, by position, that no border of `original` explains: their middle lies further than
/// `tolerance` (model units) from every such edge of `original`. 0 where nothing was torn open.
std::size_t count_hole_edges(const testing::Mesh& original, const testing::Mesh& thinned, double tolerance);

}  // namespace usuzumi::study
