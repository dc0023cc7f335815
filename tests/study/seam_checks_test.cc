// The study's own instruments, on meshes whose answers are plain.
#include "tests/study/seam_checks.h"

#include <gtest/gtest.h>

#include <utility>

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

TEST(SeamChecks, VertexIsOnASeamWhereImagesOfDifferentColoursMeet) {
  testing::Mesh two_images = square({1, 1});
  two_images.colours = {{1}, {1}, {1}, {2}, {2}, {2}};
  EXPECT_EQ(count_seam_vertices(two_images), 2u);
}

TEST(SeamChecks, BorderOfTheOriginalIsNoHole) {
  EXPECT_EQ(count_holes(square({1, 1}), square({1, 1})), 0u);
}

TEST(SeamChecks, ASheetDrawnInToATriangleHasNoHole) {
  testing::Mesh triangle = square({1, 1});
  triangle.indices.resize(3);
  EXPECT_EQ(count_holes(square({1, 1}), triangle), 0u) << "its border is the sheet's, a corner shorter";
}

TEST(SeamChecks, ASurfaceTornInTwoHasAHoleAlongItsLongerBorder) {
  testing::Mesh torn = square({1, 1});
  torn.positions[4] = {0.8f, 1, 0};  // the second face no longer meets the first along the diagonal
  EXPECT_EQ(count_holes(square({1, 1}), torn), 1u) << "one border still, as the halves touch at a corner";
  torn.positions[3] = {-0.2f, 0, 0};
  EXPECT_EQ(count_holes(square({1, 1}), torn), 1u) << "a second border";
}

TEST(SeamChecks, OriginalWithoutBorderMakesEveryBorderAHole) {
  const testing::Mesh ball = testing::icosphere(1);
  testing::Mesh open = ball;
  open.indices.resize(open.indices.size() - 3);
  EXPECT_EQ(count_holes(ball, ball), 0u);
  EXPECT_EQ(count_holes(ball, open), 1u);
  open.indices.erase(open.indices.begin(), open.indices.begin() + 3);
  EXPECT_EQ(count_holes(ball, open), 2u);
}

TEST(SeamChecks, ABorderOfOnePartDoesNotExcuseAHoleInAnother) {
  testing::Mesh two = testing::icosphere(1);
  two.colours.assign(two.positions.size(), {1});
  const testing::Mesh sheet = square({1, 1});
  for (const std::uint32_t v : sheet.indices) {
    two.indices.push_back(static_cast<std::uint32_t>(two.positions.size()));
    two.positions.push_back(sheet.positions[v] + Vec3{5, 0, 0});
    two.colours.push_back({2});
  }
  testing::Mesh thinned = two;
  thinned.indices.erase(thinned.indices.begin(), thinned.indices.begin() + 3);  // opens the ball
  thinned.indices.resize(thinned.indices.size() - 3);                           // half of the sheet is gone
  EXPECT_EQ(count_holes(two, thinned), 1u);
}

// A plate of 4 x 4 x `thick` whose front looks along +z.
testing::Mesh plate(float thick) {
  testing::Mesh mesh = testing::cube(4);
  for (Vec3& p : mesh.positions) p.z *= thick / 4;
  return mesh;
}

TEST(SeamChecks, TheBackOfAPlateThatBecameASheetIsNotFlipped) {
  const testing::Mesh thick = plate(0.5f);
  EXPECT_EQ(count_flipped(thick, plate(0)), 0u) << "both sides lie in one plane now";
  EXPECT_EQ(count_flipped(thick, thick), 0u);
}

TEST(SeamChecks, AFaceThatWasTurnedOverIsFlipped) {
  const testing::Mesh thick = plate(0.5f);
  testing::Mesh turned = thick;
  std::swap(turned.indices[3], turned.indices[4]);
  EXPECT_EQ(count_flipped(thick, turned), 1u);
}

TEST(SeamChecks, ASideThatWasLaidOverTheFrontIsFlipped) {
  const testing::Mesh thick = plate(2);
  testing::Mesh laid = thick;
  const auto first = static_cast<std::uint32_t>(laid.positions.size());
  for (const Vec3 p : {Vec3{0, 0, 2}, Vec3{1, 1, 2}, Vec3{1, 0, 2}}) laid.positions.push_back(p);
  laid.indices.insert(laid.indices.end(), {first, first + 1, first + 2});  // in the front's plane, looking back
  EXPECT_EQ(count_flipped(thick, laid), 1u);
}

}  // namespace
}  // namespace usuzumi::study
