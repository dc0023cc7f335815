// Beside what holds of every method (robustness_test.cc): any settings, and how much scratch.
#include <gtest/gtest.h>

#include <limits>

#include "firmware/simplify/edge_removal/edge_removal.h"
#include "tests/firmware/simplify/robustness.h"

namespace usuzumi::testing {
namespace {

using namespace firmware;

TEST(EdgeRemovalRobustness, SettingsThatAreNoNumbersAreSurvived) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const Mesh mesh = icosphere(2);
  for (const float bad : {nan, infinity, -1.0f, 3e38f}) {
    for (int field = 0; field < 6; ++field) {
      SimplifyOptions options{.target_faces = 100, .method = Method::kEdgeRemoval};
      options.edge_removal.neighbour_weight = 0.5f;
      float* fields[] = {&options.edge_removal.a,           &options.edge_removal.b,
                         &options.edge_removal.neighbour_weight, &options.edge_removal.computed_weight,
                         &options.edge_removal.user_weight, &options.edge_removal.boundary_limit};
      *fields[field] = bad;
      const Thinned thinned = thin(mesh, options);
      expect_sound(mesh, thinned, 100);
    }
  }
}

TEST(EdgeRemovalRobustness, SizeOfScratchIsWhatWasSaid) {
  const Mesh mesh = icosphere(3);
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const auto faces = static_cast<std::uint32_t>(mesh.face_count());
  EXPECT_LE(edge_removal_scratch_bytes(vertices, faces), 72u * vertices + 68u * faces + 160u);
}

}  // namespace
}  // namespace usuzumi::testing
