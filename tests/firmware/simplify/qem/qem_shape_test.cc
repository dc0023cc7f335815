// What thinning must keep of a shape, on meshes whose answer is known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/firmware/simplify/simplify_fixture.h"

namespace usuzumi::testing {
namespace {

using firmware::Placement;
using firmware::StopReason;

TEST(QemShape, ClosedManifoldStaysClosedManifoldAndOriented) {
  const Mesh sphere = icosphere(4);
  for (const std::uint32_t target : {2560u, 1000u, 200u, 40u, 8u}) {
    for (const Placement placement : {Placement::kOptimal, Placement::kMidpoint}) {
      const Thinned thinned = thin(sphere, target, placement);
      ASSERT_TRUE(thinned.status.ok());
      EXPECT_EQ(thinned.outcome.stop, StopReason::kQuotaReached);
      const MeshTopology t = topology_of(thinned.mesh);
      EXPECT_LE(t.faces, target);
      EXPECT_GE(t.faces + 2, target) << "an inner collapse removes two faces, so the quota is missed by one at most";
      EXPECT_EQ(t.euler(), 2);
      EXPECT_EQ(t.border_edges, 0u);
      EXPECT_EQ(t.non_manifold_edges, 0u);
      EXPECT_EQ(t.misoriented_edges, 0u);
      for (std::size_t f = 0; f < thinned.mesh.indices.size(); f += 3) {
        const Vec3 a = thinned.mesh.positions[thinned.mesh.indices[f]],
                   b = thinned.mesh.positions[thinned.mesh.indices[f + 1]],
                   c = thinned.mesh.positions[thinned.mesh.indices[f + 2]];
        EXPECT_GT(dot(cross(b - a, c - a), a + b + c), 0) << "face " << f / 3 << " looks inwards at " << target;
      }
    }
  }
}

// Large meshes are worked off region by region. Wherever the quota is met, no region may be left whole: the sphere is
// the same all over, so each of its eight octants keeps an eighth of the faces.
TEST(QemShape, RegionsOfALargeSphereAreThinnedAlike) {
  const Mesh sphere = icosphere(6);  // some ten batches
  for (const std::uint32_t percent : {90u, 70u, 50u, 30u, 10u}) {
    const auto target = static_cast<std::uint32_t>(sphere.face_count() * percent / 100);
    const Thinned thinned = thin(sphere, target);
    ASSERT_TRUE(thinned.status.ok());
    std::size_t faces[8] = {};
    for (std::size_t f = 0; f < thinned.mesh.indices.size(); f += 3) {
      const Vec3 middle = thinned.mesh.positions[thinned.mesh.indices[f]] +
                          thinned.mesh.positions[thinned.mesh.indices[f + 1]] +
                          thinned.mesh.positions[thinned.mesh.indices[f + 2]];
      ++faces[(middle.x > 0 ? 1 : 0) + (middle.y > 0 ? 2 : 0) + (middle.z > 0 ? 4 : 0)];
    }
    for (const std::size_t in_octant : faces)
      EXPECT_NEAR(static_cast<double>(in_octant), target / 8.0, target / 8.0 * 0.1) << percent;
  }
}

// A face that turns a little in each of many collapses may end up looking the other way. Here every face has wedges and
// a colour of its own, which no collapse mixes with another's, so that what is left can be told from what it was.
TEST(QemShape, NoFaceEndsUpLookingToWhereItsBackWas) {
  const Mesh sphere = icosphere(5);
  Mesh rough;  // up to six edges' lengths up and down
  std::vector<Vec3> normals;
  const auto dented = [&](std::uint32_t v) {
    const std::uint32_t noise = (v * 2654435761u) ^ (v * 40503u << 7);
    return sphere.positions[v] * (1.0f + 0.2f * static_cast<float>(noise >> 8) * 0x1p-24f);
  };
  for (std::size_t i = 0; i < sphere.indices.size(); i += 3) {
    const Vec3 a = dented(sphere.indices[i]), b = dented(sphere.indices[i + 1]), c = dented(sphere.indices[i + 2]);
    normals.push_back(cross(b - a, c - a));
    for (const Vec3 p : {a, b, c}) {
      rough.indices.push_back(static_cast<std::uint32_t>(rough.positions.size()));
      rough.positions.push_back(p);
      rough.colours.push_back({static_cast<std::uint32_t>(i / 3)});
    }
  }
  for (const std::uint32_t target : {10000u, 4000u, 1000u}) {
    const Mesh thinned = thin(rough, target).mesh;
    ASSERT_LE(thinned.face_count(), target);
    std::size_t turned = 0;
    for (std::size_t i = 0; i < thinned.indices.size(); i += 3) {
      const Vec3 a = thinned.positions[thinned.indices[i]], b = thinned.positions[thinned.indices[i + 1]],
                 c = thinned.positions[thinned.indices[i + 2]];
      const Vec3 now = cross(b - a, c - a), before = normals[thinned.colours[thinned.indices[i]].bits];
      // What the simplifier remembers of a face's side is good to a tenth of a degree.
      if (dot(now, before) < -0.01f * length(now) * length(before)) ++turned;
    }
    EXPECT_EQ(turned, 0u) << "at " << target;
  }
}

TEST(QemShape, PlaneThinsToTwoFacesWithoutError) {
  const Thinned thinned = thin(grid(16, 16), 2);
  ASSERT_TRUE(thinned.status.ok());
  EXPECT_EQ(thinned.outcome.stop, StopReason::kQuotaReached);
  EXPECT_EQ(thinned.mesh.face_count(), 2u);
  for (const Vec3 p : thinned.mesh.positions) EXPECT_EQ(p.z, 0.0f);
}

TEST(QemShape, CornersOfACubeSurvive) {
  const Thinned thinned = thin(cube(8), 12);
  ASSERT_TRUE(thinned.status.ok());
  ASSERT_EQ(thinned.mesh.face_count(), 12u);
  ASSERT_EQ(thinned.mesh.positions.size(), 8u);
  for (const float x : {0.0f, 8.0f})
    for (const float y : {0.0f, 8.0f})
      for (const float z : {0.0f, 8.0f}) {
        float nearest = 100;
        for (const Vec3 p : thinned.mesh.positions) nearest = std::min(nearest, length(p - Vec3{x, y, z}));
        EXPECT_LT(nearest, 8.0f / 2000) << x << ' ' << y << ' ' << z;
      }
}

TEST(QemShape, TetrahedronIsNotThinnedForItWouldCollapseToNothing) {
  Mesh tetrahedron;
  tetrahedron.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tetrahedron.indices = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  const Thinned thinned = thin(tetrahedron, 1);
  ASSERT_TRUE(thinned.status.ok());
  EXPECT_EQ(thinned.outcome.stop, StopReason::kNoCollapseAllowed);
  EXPECT_EQ(thinned.mesh.indices, tetrahedron.indices);
  EXPECT_EQ(thinned.mesh.positions, tetrahedron.positions);
}

}  // namespace
}  // namespace usuzumi::testing
