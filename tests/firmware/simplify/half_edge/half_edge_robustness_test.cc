// Any input, any amount of scratch: the result is sound, repeatable, or the mesh is as it was.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
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
using firmware::StopReason;

Thinned thin_half_edge(const Mesh& mesh, std::uint32_t target, firmware::CollapseLog* log = nullptr,
                       std::size_t scratch_bytes = 0) {
  return thin(mesh, {.target_faces = target, .method = Method::kHalfEdge, .log = log}, scratch_bytes);
}

// Random triangles over few vertices: edges of many faces, repeated faces, faces without extent, equal positions.
Mesh soup(unsigned seed) {
  std::mt19937 random(seed);
  Mesh mesh;
  const auto vertices = static_cast<std::uint32_t>(3 + random() % 60),
             faces = static_cast<std::uint32_t>(1 + random() % 200);
  for (std::uint32_t v = 0; v < vertices; ++v) {
    auto coordinate = [&] { return static_cast<float>(random() % 9) - 4.0f; };
    const float x = coordinate(), y = coordinate(), z = coordinate();
    mesh.positions.push_back({x, y, z});
    if (seed % 2 == 0) mesh.normals.push_back(pack_normal({coordinate(), coordinate(), 1}));
    if (seed % 3 == 0) mesh.colours.push_back({static_cast<std::uint32_t>(random() % 3)});
    if (seed % 5 == 0) mesh.texture_coordinates.push_back({coordinate(), 0});
  }
  for (std::uint32_t i = 0; i < faces * 3; ++i) mesh.indices.push_back(static_cast<std::uint32_t>(random() % vertices));
  return mesh;
}

void expect_sound(const Mesh& before, const Thinned& thinned, std::uint32_t target) {
  ASSERT_TRUE(thinned.status.ok());
  const Mesh& after = thinned.mesh;
  std::vector<bool> named(after.positions.size());
  for (const std::uint32_t i : after.indices) {
    ASSERT_LT(i, after.positions.size());
    named[i] = true;
  }
  for (std::size_t v = 0; v < named.size(); ++v) EXPECT_TRUE(named[v]) << "vertex " << v << " is not referenced";
  EXPECT_TRUE(std::isfinite(thinned.outcome.max_error));
  EXPECT_EQ(thinned.outcome.stop,
            after.face_count() <= target ? StopReason::kQuotaReached : StopReason::kNoCollapseAllowed);
  EXPECT_LE(topology_of(after).non_manifold_edges, topology_of(before).non_manifold_edges);
  EXPECT_EQ(topology_of(after).degenerate_faces, 0u);
}

TEST(HalfEdgeRobustness, SoupsStaySoundAndTheirLogsTellWhatWasDone) {
  for (unsigned seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = soup(seed);
    const auto target = static_cast<std::uint32_t>(seed % 5 * mesh.face_count() / 6);
    RoomyLog room(mesh, 1u << 12);
    const Thinned thinned = thin_half_edge(mesh, target, &room.log);
    expect_sound(mesh, thinned, target);
    if (!room.log.steps().empty()) expect_replay_gives(mesh, room.log, thinned.mesh);
    const Thinned again = thin_half_edge(mesh, target);
    EXPECT_EQ(again.mesh.indices, thinned.mesh.indices);
    EXPECT_EQ(again.mesh.positions, thinned.mesh.positions);
  }
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
      std::vector<std::uint32_t> corners = mesh.indices;
      for (const firmware::CornerChange& c : room.log.changes()) corners[c.corner] = c.to;
      for (std::size_t i = room.log.changes().size(); i-- > 0;)
        corners[room.log.changes()[i].corner] = room.log.changes()[i].from;
      for (std::size_t c = 0; c < corners.size(); ++c)  // or one that welding made equal
        EXPECT_EQ(seen_vertex(mesh, corners[c]), seen_vertex(mesh, mesh.indices[c]));
      EXPECT_EQ(room.log.steps().back().faces_after, thinned.mesh.face_count());
    }
  }
}

TEST(HalfEdgeRobustness, AFullLogIsAnErrorAndLeavesASoundMesh) {
  const Mesh mesh = ball_of_islands(2, 4, 2);
  for (std::size_t entries = 0; entries < 100; entries += 9) {
    RoomyLog room(mesh, entries);
    const Thinned thinned = thin_half_edge(mesh, 20, &room.log);
    EXPECT_EQ(thinned.status.code, StatusCode::kResourceExhausted) << entries;
    EXPECT_TRUE(room.log.full());
  }
}

TEST(HalfEdgeRobustness, TooLittleScratchLeavesTheMeshAsItWas) {
  const Mesh mesh = ball_of_islands(1, 3, 1);
  const std::size_t need = firmware::half_edge_scratch_bytes(static_cast<std::uint32_t>(mesh.positions.size()),
                                                             static_cast<std::uint32_t>(mesh.face_count()));
  // The last 64 bytes are room for the alignment of the arena's start.
  for (std::size_t bytes = 1; bytes + 64 < need; bytes += bytes < 64 || bytes + 160 > need ? 1 : 37) {
    const Thinned thinned = thin_half_edge(mesh, 20, nullptr, bytes);
    ASSERT_EQ(thinned.status.code, StatusCode::kResourceExhausted) << bytes;
    ASSERT_EQ(thinned.mesh.positions, mesh.positions);
    ASSERT_EQ(thinned.mesh.indices, mesh.indices);
    ASSERT_EQ(thinned.scratch_used, 0u);
  }
  EXPECT_TRUE(thin_half_edge(mesh, 20).status.ok());
}

TEST(HalfEdgeRobustness, MisalignedScratchOfAnyFormerContentIsEnoughAndGivenBack) {
  for (const Mesh& mesh : {ball_of_islands(3, 5, 4), icosphere(3)}) {  // three vertices a face, and half of one
    const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
    const auto faces = static_cast<std::uint32_t>(mesh.face_count());
    const Thinned expected = thin_half_edge(mesh, 150);
    const std::size_t need = firmware::half_edge_scratch_bytes(vertices, faces);
    for (const std::size_t misalignment : {0u, 1u, 7u, 63u}) {
      for (const unsigned fill : {0x00u, 0x3Fu, 0xFFu}) {
        Mesh copy = mesh;
        std::vector<std::byte> memory(need + misalignment, static_cast<std::byte>(fill));
        Arena scratch(memory);
        (void)scratch.allocate<std::byte>(misalignment);
        firmware::WorkingMesh working{.positions = copy.positions,
                                      .texture_coordinates = copy.texture_coordinates,
                                      .indices = copy.indices,
                                      .vertex_count = vertices,
                                      .face_count = faces};
        ASSERT_TRUE(firmware::simplify_half_edge(working, {.target_faces = 150}, scratch).ok()) << misalignment;
        EXPECT_EQ(scratch.used(), misalignment);
        EXPECT_GE(scratch.high_water() + 128, need) << "the bound is tight";
        copy.indices.resize(std::size_t{working.face_count} * 3);
        EXPECT_EQ(copy.indices, expected.mesh.indices);
      }
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

TEST(HalfEdgeRobustness, MeshesOfNothingStayNothing) {
  EXPECT_EQ(thin_half_edge(Mesh{}, 0).mesh.face_count(), 0u);
  Mesh points;
  points.positions = {{1, 1, 1}, {1, 1, 1}, {2, 2, 2}};
  points.indices = {0, 1, 2, 0, 0, 0};
  EXPECT_EQ(thin_half_edge(points, 0).mesh.face_count(), 0u);
  Mesh triangle;
  triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.indices = {0, 1, 2};
  const Thinned one = thin_half_edge(triangle, 0);
  EXPECT_EQ(one.mesh.face_count(), 1u);
  EXPECT_EQ(one.outcome.stop, StopReason::kNoCollapseAllowed);
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
