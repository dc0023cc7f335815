// Beside what holds of every method (robustness_test.cc): logs of seamed shapes, the scratch, the same bytes.
#include <gtest/gtest.h>

#include <span>
#include <utility>

#include "firmware/simplify/edge_passes.h"
#include "firmware/simplify/half_edge/half_edge.h"
#include "firmware/simplify/half_edge/half_edge_scratch.h"
#include "hal/crc32.h"
#include "tests/firmware/simplify/half_edge/seamed_shapes.h"
#include "tests/firmware/simplify/replay.h"

namespace usuzumi::testing {
namespace {

using firmware::Method;

Thinned thin_half_edge(const Mesh& mesh, std::uint32_t target, firmware::CollapseLog* log = nullptr) {
  return thin(mesh, {.target_faces = target, .method = Method::kHalfEdge, .log = log});
}

TEST(HalfEdgeRobustness, LogsOfSeamedShapesGiveTheThinnedMeshAndBackwardTheGivenOne) {
  const Mesh shapes[] = {ball_of_islands(3, 9, 7), joined(study::six_sided_cube(5)),
                         joined({study::creased_cylinder(16, 4, 3)}), icosphere(3),
                         with_flat_normals(icosphere(2))};
  for (const Mesh& mesh : shapes) {
    for (const double share : {0.4, 0.05}) {
      RoomyLog room(mesh);
      const auto target = static_cast<std::uint32_t>(static_cast<double>(mesh.face_count()) * share);
      const Thinned thinned = thin_half_edge(mesh, target, &room.log);
      expect_replay_gives(mesh, room.log, thinned.mesh);
      EXPECT_TRUE(room.log.added().empty());
      expect_undoing_gives(mesh, room.log);
      EXPECT_EQ(room.log.steps().back().faces_after, thinned.mesh.face_count());
    }
  }
}

// Nothing that is carved lies beyond what was carved for it, for either kind of mesh.
TEST(HalfEdgeRobustness, EveryArrayOfTheScratchIsThere) {
  for (const auto& [vertices, faces] : {std::pair{3840u, 1280u}, std::pair{642u, 1280u}, std::pair{1u, 0u}}) {
    std::vector<std::byte> memory(firmware::half_edge_scratch_bytes(vertices, faces));
    Arena arena(memory);
    firmware::HalfEdgeScratch scratch;
    ASSERT_TRUE(firmware::carve_half_edge_scratch(arena, vertices, faces, scratch));
    EXPECT_EQ(scratch.surface.links.size(), 4 * faces);
    EXPECT_EQ(scratch.candidates.size(), firmware::edge_candidate_slots(faces));
    EXPECT_EQ(scratch.queue.size(), firmware::edge_queue_slots(faces));
    EXPECT_EQ(scratch.areas.size(), vertices);
    EXPECT_EQ(scratch.refused.size(), faces);
  }
}

// One literal for every compiler, processor and optimisation level. It changes only when the method does; then the new
// value is what the failure prints.
TEST(HalfEdgeRobustness, BytesAreTheSameEverywhere) {
  Mesh mesh = ball_of_islands(4, 40, 5);
  for (const Vec3 p : mesh.positions) mesh.normals.push_back(pack_normal(normalized(p)));
  const Thinned thinned = thin_half_edge(mesh, 60);  // beyond what is free
  std::uint32_t crc = kCrc32Start;
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.positions)));
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.normals)));
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.texture_coordinates)));
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.indices)));
  EXPECT_EQ(crc, 3324704112u);
}

}  // namespace
}  // namespace usuzumi::testing
