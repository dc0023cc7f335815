// Tiny literal meshes, each with the reason why it must or must not be thinned.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/firmware/simplify/simplify_fixture.h"
#include "tests/study/seam_checks.h"

namespace usuzumi::testing {
namespace {

using firmware::Placement;
using firmware::StopReason;

Mesh tetrahedron(Vec3 at = {0, 0, 0}) {
  Mesh mesh;
  mesh.positions = {at, at + Vec3{1, 0, 0}, at + Vec3{0, 1, 0}, at + Vec3{0, 0, 1}};
  mesh.indices = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  return mesh;
}

void append(Mesh& mesh, const Mesh& other) {
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const std::uint32_t i : other.indices) mesh.indices.push_back(base + i);
}

void expect_unchanged(const Mesh& mesh, const Thinned& thinned) {
  ASSERT_TRUE(thinned.status.ok());
  EXPECT_EQ(thinned.mesh.indices, mesh.indices);
  EXPECT_EQ(thinned.mesh.positions, mesh.positions);
}

TEST(QemRules, OneTriangleStays) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.indices = {0, 1, 2};
  const Thinned thinned = thin(mesh, 0);
  expect_unchanged(mesh, thinned);
  EXPECT_EQ(thinned.outcome.stop, StopReason::kNoCollapseAllowed);
}

TEST(QemRules, EmptyMeshIsThinnedToNothing) {
  const Thinned thinned = thin(Mesh{}, 0);
  ASSERT_TRUE(thinned.status.ok());
  EXPECT_EQ(thinned.outcome.stop, StopReason::kQuotaReached);
  EXPECT_EQ(thinned.mesh.face_count(), 0u);
}

TEST(QemRules, TwoTrianglesBackToBackStay) {
  // A pillow: any collapse would leave nothing.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.indices = {0, 1, 2, 0, 2, 1};
  const Thinned thinned = thin(mesh, 0);
  expect_unchanged(mesh, thinned);
  EXPECT_EQ(thinned.outcome.stop, StopReason::kNoCollapseAllowed);
}

TEST(QemRules, MeshWithinItsQuotaKeepsItsFaces) {
  const Mesh mesh = tetrahedron();
  const Thinned thinned = thin(mesh, 4);
  expect_unchanged(mesh, thinned);
  EXPECT_EQ(thinned.outcome.stop, StopReason::kQuotaReached);
  EXPECT_EQ(thinned.outcome.max_error, 0.0f);
  EXPECT_EQ(thinned.outcome.work.collapses, 0u);
}

TEST(QemRules, EachOfManyTetrahedraStays) {
  Mesh mesh;
  for (int i = 0; i < 10; ++i) append(mesh, tetrahedron({static_cast<float>(3 * i), 0, 0}));
  const Thinned thinned = thin(mesh, 5);
  expect_unchanged(mesh, thinned);
  EXPECT_EQ(thinned.outcome.stop, StopReason::kNoCollapseAllowed);
}

TEST(QemRules, HoleOfThreeEdgesIsNotClosed) {
  // A flat ring of six faces around a triangular hole: collapsing an inner border edge would close the hole, and a
  // spoke would pinch the ring. What may go is the outer border, one face each.
  Mesh mesh;
  for (const float radius : {1.0f, 3.0f})
    for (const float turn : {0.0f, 1.0f, 2.0f}) {
      const float x[] = {1, -0.5f, -0.5f}, y[] = {0, 0.8660254f, -0.8660254f};
      const auto i = static_cast<std::size_t>(turn);
      mesh.positions.push_back({radius * x[i], radius * y[i], 0});
    }
  mesh.indices = {0, 3, 4, 0, 4, 1, 1, 4, 5, 1, 5, 2, 2, 5, 3, 2, 3, 0};
  const Thinned thinned = thin(mesh, 1);
  ASSERT_TRUE(thinned.status.ok());
  EXPECT_EQ(thinned.outcome.stop, StopReason::kNoCollapseAllowed);
  const MeshTopology before = topology_of(mesh), after = topology_of(thinned.mesh);
  EXPECT_EQ(before.euler(), 0);
  EXPECT_EQ(after.euler(), 0) << "still a ring";
  EXPECT_EQ(after.non_manifold_edges, 0u);
}

TEST(QemRules, TorusKeepsItsHole) {
  Mesh mesh;
  constexpr std::uint32_t kAround = 24, kAcross = 12;
  for (std::uint32_t i = 0; i < kAround; ++i)
    for (std::uint32_t j = 0; j < kAcross; ++j) {
      const double u = 2 * 3.14159265358979 * i / kAround, v = 2 * 3.14159265358979 * j / kAcross;
      mesh.positions.push_back({static_cast<float>((3 + std::cos(v)) * std::cos(u)),
                                static_cast<float>((3 + std::cos(v)) * std::sin(u)), static_cast<float>(std::sin(v))});
    }
  for (std::uint32_t i = 0; i < kAround; ++i)
    for (std::uint32_t j = 0; j < kAcross; ++j) {
      const std::uint32_t i1 = (i + 1) % kAround, j1 = (j + 1) % kAcross;
      const std::uint32_t a = i * kAcross + j, b = i1 * kAcross + j, c = i1 * kAcross + j1, d = i * kAcross + j1;
      for (const std::uint32_t k : {a, b, c, a, c, d}) mesh.indices.push_back(k);
    }
  for (const std::uint32_t target : {200u, 60u, 4u}) {
    const MeshTopology t = topology_of(thin(mesh, target).mesh);
    EXPECT_EQ(t.euler(), 0);
    EXPECT_EQ(t.border_edges, 0u);
    EXPECT_EQ(t.non_manifold_edges, 0u);
    EXPECT_EQ(t.misoriented_edges, 0u);
    EXPECT_GE(t.faces, 14u) << "no torus has fewer";
  }
}

TEST(QemRules, BorderOfAFlatSheetKeepsItsOutline) {
  const Thinned thinned = thin(grid(12, 7), 2);
  ASSERT_TRUE(thinned.status.ok());
  ASSERT_EQ(thinned.mesh.face_count(), 2u);
  double area = 0;
  for (std::size_t f = 0; f < 6; f += 3) {
    const auto& p = thinned.mesh.positions;
    const auto& i = thinned.mesh.indices;
    area += cross(p[i[f + 1]] - p[i[f]], p[i[f + 2]] - p[i[f]]).z / 2;
  }
  EXPECT_NEAR(area, 12 * 7, 0.01);
  EXPECT_LT(thinned.outcome.max_error, 0.01f);
}

// A bracket beside much that is worth more: a thin square pipe, open at the near end, with a foot at the far one.
TEST(QemRules, MouthOfAThinPipeIsNotDrawnIn) {
  Mesh mesh = grid(30, 30);
  for (Vec3& p : mesh.positions) p.z = 2 * std::sin(p.x * 1.1f) * std::cos(p.y * 0.9f);
  const auto sheet = static_cast<std::uint32_t>(mesh.positions.size());
  constexpr struct {
    float z, width;
  } kRings[] = {{0, 0.03f}, {0.2f, 0.03f}, {0.2f, 0.2f}, {0.25f, 0.2f}};
  for (const auto& ring : kRings)
    for (const auto& [x, y] : {std::pair{-0.5f, -0.5f}, {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}})
      mesh.positions.push_back({50 + x * ring.width, y * ring.width, ring.z});
  for (std::uint32_t ring = sheet; ring < sheet + 12; ring += 4)
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t a = ring + i, b = ring + (i + 1) % 4;
      mesh.indices.insert(mesh.indices.end(), {a, b, b + 4, a, b + 4, a + 4});
    }
  mesh.indices.insert(mesh.indices.end(), {sheet + 12, sheet + 13, sheet + 14, sheet + 12, sheet + 14, sheet + 15});
  mesh.colours.assign(mesh.positions.size(), {1});
  for (std::uint32_t v = sheet; v < mesh.positions.size(); ++v) mesh.colours[v] = {2};
  for (const std::uint32_t target : {900u, 600u, 300u, 100u}) {
    const Thinned thinned = thin(mesh, target);
    ASSERT_TRUE(thinned.status.ok());
    EXPECT_EQ(study::count_holes(mesh, thinned.mesh), 0u) << target;
  }
}

TEST(QemRules, StripGivesUpItsCheapestEndEdgeIntoItsMiddle) {
  // Ten vertices, eight faces, as in the patent's figure 5. Moving a vertex costs the squared length of its border
  // edges: the last edge has only short neighbours, every other edge has a long one.
  Mesh strip;
  strip.positions = {{0.928f, -0.04754f, 0},
                     {0.679f, -0.17241f, 0},
                     {3, 1, 0},
                     {-2, -1, 0},
                     {4, 2, 0},
                     {-3, -3, 0},
                     {1.2f, -0.3f, 0},
                     {1.25f, -0.6f, 0},
                     {0.948f, -0.2894f, 0},
                     {0.973f, -0.61348f, 0}};
  for (std::uint32_t i = 0; i < 8; ++i) {
    const bool odd = i % 2 == 1;
    for (const std::uint32_t k : {i, odd ? i + 2 : i + 1, odd ? i + 1 : i + 2}) strip.indices.push_back(k);
  }
  const Thinned thinned = thin(strip, 7, Placement::kMidpoint);
  ASSERT_TRUE(thinned.status.ok());
  EXPECT_EQ(thinned.outcome.stop, StopReason::kQuotaReached);
  EXPECT_EQ(thinned.mesh.face_count(), 7u);
  ASSERT_EQ(thinned.mesh.positions.size(), 9u);
  for (std::size_t v = 0; v < 8; ++v) EXPECT_EQ(thinned.mesh.positions[v], strip.positions[v]);
  EXPECT_NEAR(thinned.mesh.positions[8].x, 0.9605f, 1e-6f);
  EXPECT_NEAR(thinned.mesh.positions[8].y, -0.45144f, 1e-6f);
  EXPECT_EQ(thinned.mesh.positions[8].z, 0.0f);
}

TEST(QemRules, UnreferencedDegenerateAndRepeatedInputIsCleanedAway) {
  Mesh mesh = icosphere(2);
  const Mesh clean = mesh;
  // A vertex no face names, faces without extent, a vertex twice (as -0 and 0), and the whole sphere's first face
  // again.
  mesh.positions.push_back({9e30f, 9e30f, 9e30f});
  mesh.positions.push_back(mesh.positions[7]);
  const auto repeated = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  for (std::uint32_t& i : mesh.indices)
    if (i == 7 && (&i - mesh.indices.data()) % 2 == 0) i = repeated;
  for (const std::uint32_t i : {3u, 3u, 4u, 7u, repeated, 9u}) mesh.indices.push_back(i);
  const Thinned thinned = thin(mesh, 100), expected = thin(clean, 100);
  ASSERT_TRUE(thinned.status.ok());
  EXPECT_EQ(thinned.mesh.positions, expected.mesh.positions);
  EXPECT_EQ(thinned.mesh.indices, expected.mesh.indices);
}

TEST(QemRules, MinusZeroIsZero) {
  Mesh mesh = grid(2, 1);
  mesh.positions.push_back({1, 0, 0});
  mesh.positions.back().y = -0.0f;
  mesh.indices = {0, 6, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
  const Thinned thinned = thin(mesh, 4);
  EXPECT_EQ(thinned.mesh.positions.size(), 6u);
  EXPECT_EQ(topology_of(thinned.mesh).border_edges, 6u);
}

TEST(QemRules, EdgeOfThreeFacesGetsNoMoreAndTheSheetsThin) {
  // Three sheets that share a line.
  Mesh mesh;
  for (const Vec3 out : {Vec3{1, 0, 0}, Vec3{-1, 1, 0}, Vec3{-1, -1, 0}}) {
    Mesh sheet = grid(6, 12);
    for (Vec3& p : sheet.positions) p = out * p.x + Vec3{0, 0, 1} * p.y;
    append(mesh, sheet);
  }
  mesh = welded(mesh);
  ASSERT_EQ(topology_of(mesh).non_manifold_edges, 12u);
  const Thinned thinned = thin(mesh, 6);
  ASSERT_TRUE(thinned.status.ok());
  EXPECT_EQ(thinned.outcome.stop, StopReason::kQuotaReached);
  const MeshTopology t = topology_of(thinned.mesh);
  EXPECT_EQ(t.faces, 6u);
  EXPECT_EQ(t.non_manifold_edges, 1u);
  EXPECT_LT(thinned.outcome.max_error, 0.02f);
}

TEST(QemRules, HugeAndTinyCoordinatesThinAlike) {
  const Thinned plain = thin(icosphere(3), 200);
  for (const float scale : {0x1p60f, 0x1p-60f}) {
    Mesh mesh = icosphere(3);
    for (Vec3& p : mesh.positions) p = p * scale;
    const Thinned thinned = thin(mesh, 200);
    ASSERT_TRUE(thinned.status.ok());
    EXPECT_EQ(thinned.mesh.indices, plain.mesh.indices);
    for (std::size_t v = 0; v < plain.mesh.positions.size(); ++v)
      ASSERT_EQ(thinned.mesh.positions[v], plain.mesh.positions[v] * scale);
    EXPECT_EQ(thinned.outcome.max_error, plain.outcome.max_error * scale);
  }
}


TEST(QemRules, SurvivorsKeepTheirOrder) {
  const Mesh mesh = icosphere(3);
  const Thinned thinned = thin(mesh, 1000);
  std::size_t last = 0, untouched = 0;
  for (const Vec3 p : thinned.mesh.positions) {
    const auto found = std::find(mesh.positions.begin(), mesh.positions.end(), p);
    if (found == mesh.positions.end()) continue;
    const auto at = static_cast<std::size_t>(found - mesh.positions.begin());
    EXPECT_TRUE(untouched == 0 || at > last) << "vertex " << at << " comes after " << last;
    last = at;
    ++untouched;
  }
  EXPECT_GT(untouched, 100u);
}

}  // namespace
}  // namespace usuzumi::testing
