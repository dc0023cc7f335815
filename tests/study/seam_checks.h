// What may go wrong with a textured surface that was thinned: seams torn, holes opened.
#pragma once

#include <cstddef>

#include "tests/support/mesh_shapes.h"

namespace usuzumi::study {

/// Positions at which the faces around disagree about the texture coordinate, or about the colour where the mesh has
/// any: colours tell images apart.
std::size_t count_seam_vertices(const testing::Mesh& mesh);

/// Holes that thinning has torn: per part (colour; all faces where there are none), how many more borders `thinned` has
/// than `original`, a border being edges of one face alone, by position, that hang together; and one for a part that
/// has no more of them but whose borders are longer than `original`'s by more than three tenths: a tear that begins at
/// a border is no border of its own. 0 where nothing was torn open: a border of few corners is longer than the round
/// one that it stands for, but not by that much.
std::size_t count_holes(const testing::Mesh& original, const testing::Mesh& thinned);

/// Faces of `thinned` that look to the back of what they stand for: of all faces of the same part (colour) of
/// `original` that are no further than the nearest plus the part's Hausdorff distance to `original`, at the face's
/// centroid and half-way from there to its corners, none has a normal less than 90 degrees from its own. So the back of
/// a plate that was thinned into its front is no flipped face, and a side wall that was laid over the front is one.
std::size_t count_flipped(const testing::Mesh& original, const testing::Mesh& thinned);

}  // namespace usuzumi::study
