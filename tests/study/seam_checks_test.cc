// The study's own instruments, on meshes whose answers are plain.
#include "tests/study/seam_checks.h"

#include <gtest/gtest.h>

namespace usuzumi::study {
namespace {

// Two triangles that share the edge from (0, 0) to (1, 1) of the unit square; the second has vertices of its own.
testing::Mesh square(TexCoord at_second_corner) {
  testing::Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.texture_coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, at_second_corner, {0, 1}};
  mesh.indices = {0, 1, 2, 3, 4, 5};
  return mesh;
}

TEST(SeamChecks, VertexIsOnASeamWhereFacesDisagreeAboutItsTextureCoordinate) {
  EXPECT_EQ(count_seam_vertices(square({1, 1})), 0u) << "repeated, but with the same coordinate";
  EXPECT_EQ(count_seam_vertices(square({0.5f, 1})), 1u);
}

TEST(SeamChecks, BorderOfTheOriginalIsNoHole) {
  EXPECT_EQ(count_hole_edges(square({1, 1}), square({1, 1}), 1e-3), 0u);
}

TEST(SeamChecks, EdgeWhoseOtherFaceMovedAwayIsAHole) {
  testing::Mesh torn = square({1, 1});
  torn.positions[4] = {0.8f, 1, 0};  // the second face no longer meets the first along the diagonal
  // Open now: the diagonal from both sides. The border's own edges still lie on the border.
  EXPECT_EQ(count_hole_edges(square({1, 1}), torn, 1e-3), 2u);
}

TEST(SeamChecks, OriginalWithoutBorderMakesEveryOpenEdgeAHole) {
  testing::Mesh ball = testing::icosphere(1);
  testing::Mesh open = ball;
  open.indices.resize(open.indices.size() - 3);
  EXPECT_EQ(count_hole_edges(ball, ball, 1e-3), 0u);
  EXPECT_EQ(count_hole_edges(ball, open, 1e-3), 3u);
}

}  // namespace
}  // namespace usuzumi::study
