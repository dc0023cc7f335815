// A whole model thinned in the host's memory by the firmware's own methods, for pictures and for the checks on seams.
#pragma once

#include <cstdint>
#include <vector>

#include "firmware/simplify/simplify.h"
#include "sim/pack/model.h"
#include "tests/support/mesh_shapes.h"

namespace usuzumi::study {

struct ThinnedModel {
  sim::Model model;
  /// By mesh: which vertex of the mesh as given each vertex that is left was.
  std::vector<std::vector<std::uint32_t>> sources;
  std::uint32_t target_faces = 0;  // asked for, of all meshes together
  std::uint32_t faces = 0;         // left
};

/// Every mesh to `share` of its faces, by the method's default settings. A mesh of several materials is thinned as one,
/// in groups, so that no crack opens between them; meshes without a texture are thinned as well.
ThinnedModel thin_model(const sim::Model& model, firmware::Method method, double share);

/// The model as it stands, as though thinned to all of its faces.
ThinnedModel unthinned(const sim::Model& model);

/// What colours the vertices of surface_of() tell apart.
enum class Paint {
  kImages,  // materials: where two meet there is a seam even where texture coordinates agree
  kParts,   // what of a mesh as given hung together by its places
};

/// All meshes as one surface, painted. `original` is what `thinned` was thinned from.
testing::Mesh surface_of(const sim::Model& original, const ThinnedModel& thinned, Paint paint);

}  // namespace usuzumi::study
