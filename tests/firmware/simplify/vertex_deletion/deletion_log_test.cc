// What is told of deletions is all there is to them: followed step by step it gives the thinned mesh, backwards the one
// that was given.
#include <gtest/gtest.h>

#include "tests/firmware/simplify/replay.h"
#include "tests/firmware/simplify/vertex_deletion/seamed_meshes.h"

namespace usuzumi::testing {
namespace {

using namespace firmware;

Thinned delete_logged(const Mesh& mesh, std::uint32_t target, CollapseLog& log) {
  return thin(mesh, {.target_faces = target, .method = Method::kVertexDeletion, .log = &log});
}

void expect_told(const Mesh& mesh, std::uint32_t target) {
  RoomyLog room(mesh);
  const Thinned thinned = delete_logged(mesh, target, room.log);
  ASSERT_TRUE(thinned.status.ok());
  EXPECT_LT(thinned.mesh.face_count(), mesh.face_count());
  EXPECT_EQ(room.log.steps().size(), thinned.outcome.work.collapses);
  EXPECT_TRUE(room.log.added().empty()) << "no vertex is made";
  expect_replay_gives(mesh, room.log, thinned.mesh);
  expect_undoing_gives(mesh, room.log);
}

TEST(VertexDeletionLog, ReplayOfAClosedSurfaceGivesTheThinnedOne) { expect_told(icosphere(3), 100); }
TEST(VertexDeletionLog, ReplayOfABorderGivesTheThinnedMesh) { expect_told(grid(16, 16), 10); }
TEST(VertexDeletionLog, ReplayOfSeamsGivesTheThinnedMesh) {
  expect_told(two_charts(16), 20);
  expect_told(capped_cylinder(48, 12), 150);
  expect_told(with_flat_normals(cube(8)), 12);
}

TEST(VertexDeletionLog, SuccessorsStayOnTheSeamAndOnTheBorder) {
  const Mesh mesh = two_charts(16);
  RoomyLog room(mesh);
  ASSERT_TRUE(delete_logged(mesh, 20, room.log).status.ok());
  std::vector<std::uint32_t> heirs(mesh.positions.size());
  for (std::uint32_t v = 0; v < heirs.size(); ++v) heirs[v] = v;
  for (const Succession& s : room.log.successions()) {
    heirs[s.from] = s.to;
    const Vec3 from = mesh.positions[s.from], to = mesh.positions[s.to];
    if (from.x == 8) { EXPECT_EQ(to.x, 8) << "on the seam"; }
    if (from.y == 0 || from.y == 16) { EXPECT_EQ(to.y, from.y) << "on the border"; }
    EXPECT_EQ(mesh.texture_coordinates[s.from].s > 1.5f, mesh.texture_coordinates[s.to].s > 1.5f) << "in its chart";
  }
  // Both wedges of a seam vertex end at one place. The right chart's vertices begin half-way.
  for (std::uint32_t y = 0; y <= 16; ++y) {
    std::uint32_t left = y * 9 + 8, right = 17 * 9 + y * 9;
    ASSERT_EQ(mesh.positions[left], mesh.positions[right]);
    while (heirs[left] != left) left = heirs[left];
    while (heirs[right] != right) right = heirs[right];
    EXPECT_EQ(mesh.positions[left], mesh.positions[right]);
  }
}

TEST(VertexDeletionLog, FullLogStopsWithAStatusAndASoundMesh) {
  const Mesh mesh = icosphere(3);
  RoomyLog room(mesh, 100);
  const Thinned thinned = delete_logged(mesh, 100, room.log);
  EXPECT_EQ(thinned.status.code, StatusCode::kResourceExhausted);
  EXPECT_TRUE(room.log.full());
}

}  // namespace
}  // namespace usuzumi::testing
