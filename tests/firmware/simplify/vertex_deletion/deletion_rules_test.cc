// Tiny literal meshes, each with the reason why a vertex must or must not be deleted.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware/simplify/simplify_fixture.h"
#include "tests/firmware/simplify/vertex_deletion/ring_surface.h"

namespace usuzumi::testing {
namespace {

using firmware::Method;
using firmware::StopReason;
using firmware::VertexDeletionSettings;

constexpr VertexDeletionSettings kNoLimits{.limit_area = 0, .limit_move = 0, .limit_normal = 0, .limit_largest = 0};

Thinned delete_to(const Mesh& mesh, std::uint32_t target, const VertexDeletionSettings& settings = kNoLimits) {
  return thin(mesh, {.target_faces = target, .method = Method::kVertexDeletion, .vertex_deletion = settings});
}

void expect_unchanged(const Mesh& mesh, const Thinned& thinned) {
  ASSERT_TRUE(thinned.status.ok());
  EXPECT_EQ(thinned.mesh.indices, mesh.indices);
  EXPECT_EQ(thinned.mesh.positions, mesh.positions);
  EXPECT_EQ(thinned.outcome.stop, StopReason::kNoCollapseAllowed);
}

TEST(VertexDeletionRules, TetrahedronStays) {
  // The one triangle that would fill a corner's polygon is there already, as the opposite face.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.indices = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  expect_unchanged(mesh, delete_to(mesh, 0));
}

TEST(VertexDeletionRules, OctahedronLosesOneVertex) {
  // Its square is filled by two triangles; five vertices and six faces are left. Two of the vertices have three faces,
  // and deleting either would leave a tetrahedron, which no deletion can make smaller.
  Mesh mesh;
  mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.indices = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  const Thinned six = delete_to(mesh, 6);
  ASSERT_EQ(six.mesh.face_count(), 6u);
  EXPECT_EQ(topology_of(six.mesh).euler(), 2);
  const Thinned least = delete_to(mesh, 0);
  EXPECT_EQ(topology_of(least.mesh).euler(), 2);
  EXPECT_GE(least.mesh.face_count(), 4u);
}

TEST(VertexDeletionRules, TwoTrianglesBackToBackStay) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.indices = {0, 1, 2, 0, 2, 1};
  expect_unchanged(mesh, delete_to(mesh, 0));
}

TEST(VertexDeletionRules, EmptyMeshIsThinnedToNothing) {
  const Thinned thinned = delete_to(Mesh{}, 0);
  ASSERT_TRUE(thinned.status.ok());
  EXPECT_EQ(thinned.outcome.stop, StopReason::kQuotaReached);
}

TEST(VertexDeletionRules, MeshWithinItsQuotaIsLeftAlone) {
  const Mesh mesh = icosphere(1);
  const Thinned thinned = delete_to(mesh, 80);
  EXPECT_EQ(thinned.mesh.indices, mesh.indices);
  EXPECT_EQ(thinned.outcome.stop, StopReason::kQuotaReached);
  EXPECT_EQ(thinned.outcome.work.collapses, 0u);
}

TEST(VertexDeletionRules, HoleOfThreeEdgesIsNotClosed) {
  // A flat ring of six faces around a triangular hole: each inner vertex's two border neighbours are joined already.
  Mesh mesh;
  mesh.positions = {{0, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {0, 3, 0}, {-3, -2, 0}, {3, -2, 0}};
  mesh.indices = {0, 3, 4, 0, 4, 1, 1, 4, 5, 1, 5, 2, 2, 5, 3, 2, 3, 0};
  const Thinned thinned = delete_to(mesh, 0);
  ASSERT_TRUE(thinned.status.ok());
  const MeshTopology t = topology_of(thinned.mesh);
  EXPECT_EQ(t.euler(), 0) << "still a ring";
  EXPECT_EQ(t.non_manifold_edges, 0u);
}

TEST(VertexDeletionRules, EndsOfAnEdgeOfThreeFacesStay) {
  // Three fins of two faces on the edge 0-1. Its ends stay at any quota; what else may go is up to the energy.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 0, 1}, {-1, 1, 0}, {-1, 1, 1}, {-1, -1, 0}, {-1, -1, 1}};
  for (const std::uint32_t a : {2u, 4u, 6u}) mesh.indices.insert(mesh.indices.end(), {0, a, a + 1, 0, a + 1, 1});
  const RingSurface surface(mesh);
  EXPECT_FALSE(surface.ring(0).has_value());
  EXPECT_FALSE(surface.ring(1).has_value());
  EXPECT_TRUE(surface.ring(3).has_value()) << "two faces of one fin";
  const Thinned thinned = delete_to(mesh, 0);
  EXPECT_EQ(topology_of(thinned.mesh).non_manifold_edges, 1u);
  EXPECT_EQ(thinned.mesh.positions[0], mesh.positions[0]);
  EXPECT_EQ(thinned.mesh.positions[1], mesh.positions[1]);
}

TEST(VertexDeletionRules, FansThatTouchInAVertexAndFacesTurnedTheOtherWayStay) {
  Mesh touching;
  touching.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 0, 0}, {-1, -1, 0}, {0, -1, 0}};
  touching.indices = {0, 1, 2, 0, 2, 3, 0, 4, 5, 0, 5, 6};
  EXPECT_FALSE(RingSurface(touching).ring(0).has_value());
  Mesh turned = closed_ring({0, 0, 1}, {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}});
  std::swap(turned.indices[1], turned.indices[2]);
  EXPECT_FALSE(RingSurface(turned).ring(0).has_value());
}

TEST(VertexDeletionRules, FaceThatStandsAloneAtAVertexIsKept) {
  // The tip of an ear: without its only face there would be nothing to fill.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.indices = {0, 1, 2};
  expect_unchanged(mesh, delete_to(mesh, 0));
}

std::vector<Vec3> regular_polygon(std::uint32_t corners) {
  std::vector<Vec3> polygon;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double angle = 6.283185307179586 * i / corners;
    polygon.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0});
  }
  return polygon;
}

TEST(VertexDeletionRules, PolygonOfNineteenCornersIsMadeAndOneOfTwentyIsNot) {
  for (const std::uint32_t corners : {3u, 6u, 7u, 12u, 19u}) {
    const RingSurface surface(closed_ring({0, 0, 0}, regular_polygon(corners)));
    EXPECT_TRUE(surface.least(0, kNoLimits, 1).has_value()) << corners;
  }
  EXPECT_FALSE(RingSurface(closed_ring({0, 0, 0}, regular_polygon(20))).ring(0).has_value());
  // 18 faces of a half-fan have 19 corners.
  std::vector<Vec3> half;
  for (std::uint32_t i = 0; i < 20; ++i) half.push_back(regular_polygon(40)[i]);
  EXPECT_FALSE(RingSurface(open_ring({0, 0, 0}, half)).ring(0).has_value());
  half.pop_back();
  EXPECT_TRUE(RingSurface(open_ring({0, 0, 0}, half)).ring(0).has_value());
}

TEST(VertexDeletionRules, LimitsLeaveVerticesOut) {
  // A pyramid on a sheet: the peak's E_area is 0.2 and E_move 0.75 / root of the mean area, by hand as in the energies.
  Mesh mesh = closed_ring({0, 0, 0.75f}, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
  VertexDeletionSettings limits = kNoLimits;
  limits.limit_area = 0.19f;
  EXPECT_EQ(delete_to(mesh, 2, limits).mesh.positions[0].z, 0.75f) << "0.2 exceeds 0.19 in the last stage too";
  limits.limit_area = 0.21f;
  const Thinned thinned = delete_to(mesh, 2, limits);
  EXPECT_EQ(thinned.mesh.face_count(), 2u);
  EXPECT_NEAR(thinned.outcome.max_error, 0.75, 1e-6) << "how far the peak lay from the new faces";
  limits = kNoLimits;
  limits.limit_normal = 0.039f;  // E_norm is 0.04
  EXPECT_EQ(delete_to(mesh, 2, limits).mesh.positions[0].z, 0.75f);
  limits.limit_normal = 0.041f;
  EXPECT_EQ(delete_to(mesh, 2, limits).mesh.face_count(), 2u);
}

TEST(VertexDeletionRules, LimitsRiseInSixStages) {
  // Two pyramids. The small one, height 3/4, has an E_area of 0.2: with a limit of 0.6 it may go in the second stage.
  // The other, ten times as large and flatter (height 5/12 of its half side: slant 13/12, E_area = 1 - 12/13 = 0.077),
  // may go in the first, although its energy is higher: it is larger.
  Mesh mesh = closed_ring({0, 0, 0.75f}, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
  const float size = 10;
  const Mesh flat = closed_ring({20, 0, 5 * size / 12}, {{20 - size, -size, 0}, {20 + size, -size, 0},
                                                          {20 + size, size, 0}, {20 - size, size, 0}});
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), flat.positions.begin(), flat.positions.end());
  for (const std::uint32_t i : flat.indices) mesh.indices.push_back(base + i);
  VertexDeletionSettings settings = kNoLimits;
  settings.boundary_area = 1000;
  const auto peaks = [](const Thinned& thinned) {
    std::pair<bool, bool> there;
    for (const Vec3 p : thinned.mesh.positions) {
      there.first = there.first || p.z == 0.75f;
      there.second = there.second || p.z > 1;
    }
    return there;
  };
  EXPECT_EQ(peaks(delete_to(mesh, 6, settings)), std::make_pair(false, true)) << "by energy the small one goes first";
  settings.limit_area = 0.601f;
  EXPECT_EQ(peaks(delete_to(mesh, 6, settings)), std::make_pair(true, false)) << "by stages the flat one does";
  EXPECT_EQ(peaks(delete_to(mesh, 4, settings)), std::make_pair(false, false)) << "and the other in the next";
}

TEST(VertexDeletionRules, SidesOfAThinPlateAreNotTurnedOver) {
  // A plate 8 x 8 x 0.01: seen from above it covers 64 before, and after but for what its outline loses. Sides that are
  // turned over would cover more.
  Mesh plate = cube(8);
  for (Vec3& p : plate.positions) p.z *= 0.01f / 8;
  for (const std::uint32_t target : {200u, 60u}) {
    const Thinned thinned = delete_to(plate, target);
    ASSERT_EQ(thinned.mesh.face_count(), target);
    EXPECT_EQ(topology_of(thinned.mesh).euler(), 2);
    double upwards = 0, downwards = 0;
    for (std::size_t f = 0; f < thinned.mesh.face_count(); ++f) {
      const Vec3 a = thinned.mesh.positions[thinned.mesh.indices[3 * f]],
                 b = thinned.mesh.positions[thinned.mesh.indices[3 * f + 1]],
                 c = thinned.mesh.positions[thinned.mesh.indices[3 * f + 2]];
      const double z = static_cast<double>(cross(b - a, c - a).z) / 2;
      (z > 0 ? upwards : downwards) += z;
    }
    EXPECT_NEAR(upwards, 64, 0.5);
    EXPECT_NEAR(downwards, -64, 0.5);
  }
}

}  // namespace
}  // namespace usuzumi::testing
