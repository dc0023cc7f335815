// The log that thinning by quadric error writes gives the thinned mesh when followed, and the given one when undone.
#include <gtest/gtest.h>

#include "tests/firmware/simplify/replay.h"

namespace usuzumi::testing {
namespace {

using firmware::Placement;

void expect_logged(const Mesh& mesh, std::uint32_t target, Placement placement = Placement::kOptimal) {
  RoomyLog room(mesh);
  const Thinned thinned = thin(mesh, {.target_faces = target, .placement = placement, .log = &room.log});
  ASSERT_TRUE(thinned.status.ok());
  EXPECT_EQ(room.log.steps().size(), thinned.outcome.work.collapses);
  expect_replay_gives(mesh, room.log, thinned.mesh);
  expect_undoing_gives(mesh, room.log);
  const Thinned without = thin(mesh, target, placement);
  EXPECT_EQ(without.mesh.positions, thinned.mesh.positions) << "the log changes nothing";
  EXPECT_EQ(without.mesh.indices, thinned.mesh.indices);
}

Mesh with_texture(Mesh mesh) {
  for (const Vec3 p : mesh.positions) mesh.texture_coordinates.push_back({p.x + 0.1f * p.y, p.z - 0.2f * p.x * p.y});
  return mesh;
}

TEST(QemLog, ReplayGivesTheThinnedMeshAndUndoingTheGivenOne) {
  expect_logged(icosphere(3), 100);
  expect_logged(icosphere(3), 100, Placement::kMidpoint);
  expect_logged(grid(12, 12), 20);
}

TEST(QemLog, ReplayKeepsNormalsAndTextureCoordinates) {
  expect_logged(with_flat_normals(cube(6)), 12);
  expect_logged(with_texture(icosphere(3)), 100);
  expect_logged(with_texture(with_flat_normals(icosphere(3))), 200);
  expect_logged(with_texture(with_flat_normals(icosphere(2))), 40, Placement::kMidpoint);
}

// A jump of the texture on every second face's edges: wedges that are left over, joined by threes, or come to an end.
TEST(QemLog, ReplayKeepsSeamsThatEndAnywhere) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Mesh mesh = with_flat_normals(icosphere(2));
    mesh.normals.clear();
    std::uint32_t state = seed;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      state = state * 1664525u + 1013904223u;
      const float jump = (state >> 24) % 4 == 0 ? 0.25f : 0;
      mesh.texture_coordinates.push_back({mesh.positions[v].x + jump, mesh.positions[v].y});
    }
    expect_logged(mesh, 60);
  }
}

TEST(QemLog, FullLogEndsThinningWithASoundMesh) {
  const Mesh mesh = icosphere(3);
  for (const std::size_t entries : {0u, 1u, 50u, 500u}) {
    RoomyLog room(mesh, entries);
    const Thinned thinned = thin(mesh, {.target_faces = 20, .log = &room.log});
    EXPECT_EQ(thinned.status.code, StatusCode::kResourceExhausted) << entries;
    EXPECT_GT(thinned.mesh.face_count(), 20u);
    EXPECT_EQ(topology_of(thinned.mesh).euler(), 2);
  }
}

}  // namespace
}  // namespace usuzumi::testing
