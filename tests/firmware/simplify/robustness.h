// Meshes that no method expects, and what must hold of any thinned mesh.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/firmware/simplify/simplify_fixture.h"

namespace usuzumi::testing {

/// Random triangles over few vertices: edges of many faces, repeated faces, faces without extent, equal positions;
/// normals, colours and texture coordinates come and go with the seed.
inline Mesh soup(unsigned seed) {
  std::mt19937 random(seed);
  Mesh mesh;
  const auto vertices = static_cast<std::uint32_t>(3 + random() % 60),
             faces = static_cast<std::uint32_t>(1 + random() % 200);
  const auto coordinate = [&] { return static_cast<float>(random() % 9) - 4.0f; };
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const float x = coordinate(), y = coordinate(), z = coordinate();
    mesh.positions.push_back({x, y, z});
    if (seed % 2 == 0) {
      const float across = coordinate(), along = coordinate();
      mesh.normals.push_back(pack_normal({across, along, 1}));
    }
    if (seed % 5 == 0) mesh.colours.push_back({static_cast<std::uint32_t>(random() % 3)});
    if (seed % 3 == 0) {
      const float s = static_cast<float>(random() % 2), t = static_cast<float>(random() % 2);
      mesh.texture_coordinates.push_back({s, t});
    }
  }
  for (std::uint32_t i = 0; i < faces * 3; ++i) mesh.indices.push_back(static_cast<std::uint32_t>(random() % vertices));
  return mesh;
}

/// `mesh`, its vertices moved at random by up to `size` along each axis, without `holes` of its faces.
inline Mesh crumpled(Mesh mesh, float size, unsigned holes, std::mt19937& random) {
  const auto share = [&] { return static_cast<float>(random() % 1000) * 1e-3f; };
  for (Vec3& p : mesh.positions) {
    const float x = share(), y = share(), z = share();
    p = p + Vec3{x, y, z} * size;
  }
  for (unsigned i = 0; i < holes; ++i) {
    const auto face = static_cast<std::ptrdiff_t>(random() % mesh.face_count());
    mesh.indices.erase(mesh.indices.begin() + face * 3, mesh.indices.begin() + face * 3 + 3);
  }
  return mesh;
}

/// A closed surface that cuts itself, with five faces missing.
inline Mesh crumpled_ball(unsigned seed) {
  std::mt19937 random(seed);
  return crumpled(icosphere(2), 0.5f, 5, random);
}

inline void expect_sound(const Mesh& before, const Thinned& thinned, std::uint32_t target) {
  ASSERT_TRUE(thinned.status.ok());
  const Mesh& after = thinned.mesh;
  EXPECT_LE(after.face_count(), before.face_count());
  EXPECT_LE(after.positions.size(), before.positions.size());
  std::vector<bool> named(after.positions.size());
  for (const std::uint32_t i : after.indices) {
    ASSERT_LT(i, after.positions.size());
    named[i] = true;
  }
  for (std::size_t v = 0; v < named.size(); ++v) EXPECT_TRUE(named[v]) << "vertex " << v << " is not referenced";
  for (const Vec3 p : after.positions) EXPECT_TRUE(is_finite(p));
  EXPECT_TRUE(std::isfinite(thinned.outcome.max_error));
  EXPECT_EQ(thinned.outcome.stop,
            after.face_count() <= target ? firmware::StopReason::kQuotaReached
                                         : firmware::StopReason::kNoCollapseAllowed);
  const MeshTopology t0 = topology_of(before), t1 = topology_of(after);
  EXPECT_LE(t1.non_manifold_edges, t0.non_manifold_edges);
  EXPECT_EQ(t1.degenerate_faces, 0u);
}

}  // namespace usuzumi::testing
