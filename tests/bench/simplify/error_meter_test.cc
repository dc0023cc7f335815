// The meter is only worth as much as its own tests: distances worked out by hand, and a search through every face.
#include "tests/bench/simplify/error_meter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace usuzumi::bench {
namespace {

using testing::Mesh;

constexpr Point kA{0, 0, 0}, kB{4, 0, 0}, kC{0, 3, 0};

double distance(Point p) { return std::sqrt(squared_distance_to_triangle(p, kA, kB, kC)); }

TEST(PointTriangleDistance, OverTheFaceIsTheHeight) {
  EXPECT_DOUBLE_EQ(distance({1, 1, 2}), 2);
  EXPECT_DOUBLE_EQ(distance({1, 1, -2}), 2);
  EXPECT_DOUBLE_EQ(distance({1, 1, 0}), 0);
}

TEST(PointTriangleDistance, BesideEachCornerIsTheDistanceToIt) {
  EXPECT_DOUBLE_EQ(distance({-3, -4, 0}), 5);
  EXPECT_DOUBLE_EQ(distance({4 + 12, 0, 5}), 13);
  EXPECT_DOUBLE_EQ(distance({-1, 3 + 2, 2}), 3);
}

TEST(PointTriangleDistance, BesideEachEdgeIsTheDistanceToItsLine) {
  EXPECT_DOUBLE_EQ(distance({2, -3, 4}), 5);
  EXPECT_DOUBLE_EQ(distance({-6, 1, 8}), 10);
  // The hypotenuse is 3x + 4y = 12; (2, 1.5) is on it and (3, 4) / 5 is its normal.
  EXPECT_NEAR(distance({2 + 3, 1.5 + 4, 0}), 5, 1e-12);
  EXPECT_NEAR(distance({2 + 3, 1.5 + 4, 12}), 13, 1e-12);
}

TEST(PointTriangleDistance, TriangleWithoutAreaIsASegmentOrAPoint) {
  EXPECT_DOUBLE_EQ(std::sqrt(squared_distance_to_triangle({1, 2, 0}, kA, kB, {2, 0, 0})), 2);
  EXPECT_DOUBLE_EQ(std::sqrt(squared_distance_to_triangle({0, 3, 4}, kA, kA, kA)), 5);
}

TEST(SurfaceIndex, FindsWhatASearchThroughEveryFaceFinds) {
  Mesh mesh = testing::icosphere(2);
  for (std::size_t v = 0; v < mesh.positions.size(); v += 3) mesh.positions[v] = mesh.positions[v] * 1.3f;
  const SurfaceIndex index(mesh);
  for (const Point p : area_uniform_samples(testing::icosphere(1), 500, 7)) {
    const Point q{p.x * 1.7 + 0.1, p.y * 0.4, p.z * 1.1};
    double least = std::numeric_limits<double>::infinity();
    std::set<std::uint32_t> expected;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      Point t[3];
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 v = mesh.positions[mesh.indices[f * 3 + k]];
        t[k] = {v.x, v.y, v.z};
      }
      const double squared = squared_distance_to_triangle(q, t[0], t[1], t[2]);
      least = std::min(least, squared);
      if (squared <= 0.09) expected.insert(static_cast<std::uint32_t>(f));
    }
    EXPECT_EQ(index.nearest(q).squared_distance, least);
    std::set<std::uint32_t> found;
    index.within(q, 0.3, [&](std::uint32_t face) { found.insert(face); });
    EXPECT_EQ(found, expected);
  }
}

TEST(Samples, AreSpreadByArea) {
  // One face of area 0.5 and one of 4.5, apart in z.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}, {3, 0, 5}, {0, 3, 5}};
  mesh.indices = {0, 1, 2, 3, 4, 5};
  std::size_t low = 0;
  double x = 0;
  const auto samples = area_uniform_samples(mesh, 10000, 3);
  ASSERT_EQ(samples.size(), 10000u);
  for (const Point p : samples) {
    if (p.z < 1) ++low;
    else x += p.x;
  }
  EXPECT_NEAR(static_cast<double>(low), 1000, 1);
  EXPECT_NEAR(x / 9000, 1.0, 0.03) << "the mean of a triangle is its centroid";
}

TEST(SurfaceError, OfAShiftedPlaneIsTheShift) {
  const Mesh plane = testing::grid(4, 4);
  Mesh shifted = plane;
  for (Vec3& p : shifted.positions) p.z = 0.25f;
  const SurfaceError error = measure_error(plane, shifted, 1000);
  EXPECT_NEAR(error.rms, 0.25, 1e-12);
  EXPECT_NEAR(error.hausdorff, 0.25, 1e-12);
}

TEST(SurfaceError, LooksBothWays) {
  // A square of side 4 and its quarter: nothing of the quarter is off the square, but the far corner is sqrt(8) off the
  // quarter. Over the square, the mean squared distance is 16/3: by quarters of its area 0, 4/3, 4/3 and 8/3 summed
  // / 4.
  const Mesh square = testing::grid(4, 4), quarter = testing::grid(2, 2);
  const SurfaceError error = measure_error(quarter, square, 100000);
  EXPECT_NEAR(error.hausdorff, std::sqrt(8.0), 1e-6);
  EXPECT_NEAR(error.rms, std::sqrt((4.0 / 3 + 4.0 / 3 + 8.0 / 3) / 4 / 2), 2e-3);
  EXPECT_EQ(measure_error(square, quarter, 100000).hausdorff, error.hausdorff);
}

TEST(FlippedFaces, AreCountedAndSoundOnesAreNot) {
  const Mesh sphere = testing::icosphere(3);
  Mesh coarse = testing::icosphere(1);
  EXPECT_EQ(count_flipped_faces(sphere, coarse, 0.01), 0u);
  std::swap(coarse.indices[0], coarse.indices[1]);
  std::swap(coarse.indices[30], coarse.indices[31]);
  EXPECT_EQ(count_flipped_faces(sphere, coarse, 0.01), 2u);
}

// A bore that was thinned to a square lies within the shaft that turns in it; the shaft looks the other way.
TEST(FlippedFaces, AreLookedForInTheirOwnPartOnly) {
  const auto add_tube = [](Mesh& mesh, int sides, float radius, bool outwards) {
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i < sides; ++i) {
      const float angle = static_cast<float>(i) * 6.2831853f / static_cast<float>(sides);
      for (const float z : {0.0f, 4.0f})
        mesh.positions.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
    for (int i = 0; i < sides; ++i) {
      const std::uint32_t a = base + 2 * static_cast<std::uint32_t>(i),
                          b = base + 2 * static_cast<std::uint32_t>((i + 1) % sides);
      if (outwards) mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
      else mesh.indices.insert(mesh.indices.end(), {a, b + 1, b, a, a + 1, b + 1});
    }
  };
  Mesh original, thinned;
  add_tube(original, 48, 1.0f, true);
  add_tube(original, 48, 1.01f, false);
  add_tube(thinned, 48, 1.0f, true);
  add_tube(thinned, 4, 1.01f, false);
  EXPECT_GT(count_flipped_faces(original, thinned, 0.001), 0u) << "without colours the shaft is what is nearest";
  paint_parts(original);
  paint_parts(thinned);
  std::set<std::uint32_t> parts;
  for (const Rgba8 colour : original.colours) parts.insert(colour.bits);
  EXPECT_EQ(parts.size(), 2u);
  EXPECT_EQ(count_flipped_faces(original, thinned, 0.001), 0u);  // both are painted by their lowest vertices, 0 and 96
}

}  // namespace
}  // namespace usuzumi::bench
