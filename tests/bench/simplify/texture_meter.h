// How far a texture has shifted on a thinned surface: texture coordinates against the original's at the same place.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tests/support/mesh_shapes.h"

namespace usuzumi::bench {

struct TextureDrift {  // in texture units
  double rms = 0;
  double largest = 0;
  double beyond = 0;  // share of the samples that drifted by more than `limit`
};

/// At `samples` points spread evenly over `thinned`, the difference between its texture coordinate and the original's:
/// the least among the points of `original`'s faces that are no further than the nearest plus `tolerance` (model
/// units), each taken at the face's point nearest to the sample. The tolerance tells a seam that lies a little beside
/// its old place from a texture that shows something else. Both meshes have texture coordinates.
TextureDrift measure_texture_drift(const testing::Mesh& original, const testing::Mesh& thinned, double tolerance,
                                   double limit, std::size_t samples = 50000, std::uint64_t seed = 1);

}  // namespace usuzumi::bench
