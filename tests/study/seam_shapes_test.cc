// The shapes are what they are said to be.
#include "tests/study/seam_shapes.h"

#include <gtest/gtest.h>

#include "tests/study/seam_checks.h"

namespace usuzumi::study {
namespace {

// Textures lie side by side, so that a border between two of them is one also where both coordinates happen to agree.
testing::Mesh joined(const std::vector<TexturedPart>& parts) {
  testing::Mesh mesh;
  float offset = 0;
  for (const TexturedPart& part : parts) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
    for (const TexCoord c : part.coordinates) mesh.texture_coordinates.push_back({c.s + offset, c.t});
    offset += 2;
    for (const std::uint32_t v : part.indices) mesh.indices.push_back(first + v);
  }
  return mesh;
}

double volume(const testing::Mesh& mesh) {
  double six_times = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    six_times += dot(mesh.positions[mesh.indices[i]],
                     cross(mesh.positions[mesh.indices[i + 1]], mesh.positions[mesh.indices[i + 2]]));
  return six_times / 6;
}

TEST(SeamShapes, CubeIsClosedFacesOutwardsAndHasASeamAlongEveryEdge) {
  const testing::Mesh cube = joined(six_sided_cube(4));
  EXPECT_EQ(cube.face_count(), 6u * 4 * 4 * 2);
  const testing::MeshTopology topology = testing::topology_of(testing::welded(cube));
  EXPECT_EQ(topology.border_edges, 0u);
  EXPECT_EQ(topology.non_manifold_edges, 0u);
  EXPECT_NEAR(volume(cube), 8, 1e-5);
  EXPECT_EQ(count_seam_vertices(cube), 8u + 12 * 3) << "corners, and three vertices inside each edge";
  for (std::uint32_t n = 1; n < 20; ++n)
    EXPECT_EQ(testing::topology_of(joined(six_sided_cube(n))).border_edges, 0u) << n << " cells a side";
}

TEST(SeamShapes, CylinderIsClosedFacesOutwardsAndHasItsCreasesAndItsSeam) {
  const testing::Mesh cylinder = joined({creased_cylinder(24, 6, 3)});
  EXPECT_EQ(cylinder.face_count(), 24u * 6 * 2 + 2 * 24 * (1 + 2 * 2));
  const testing::MeshTopology topology = testing::topology_of(testing::welded(cylinder));
  EXPECT_EQ(topology.border_edges, 0u);
  EXPECT_EQ(topology.non_manifold_edges, 0u);
  // A prism over a regular polygon of 24 corners, height 2.
  EXPECT_NEAR(volume(cylinder), 2 * 12 * 0.258819, 1e-4);
  EXPECT_EQ(count_seam_vertices(cylinder), 24u * 2 + 5) << "both rims, and the mantle's seam between them";
}

TEST(SeamShapes, TestCardsDifferFromEachOtherAndWithinThemselves) {
  const auto card = test_card(64, 0);
  EXPECT_EQ(card.size(), 64u * 64);
  EXPECT_NE(card, test_card(64, 1));
  EXPECT_NE(card[0], card[7]) << "a ramp across a field";
  EXPECT_NE(card[0], card[8]) << "another shade in the next field";
}

}  // namespace
}  // namespace usuzumi::study
