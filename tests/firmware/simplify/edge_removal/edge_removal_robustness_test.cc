// Any input, any amount of scratch, any settings: the result is sound, repeatable, or the mesh is as it was.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <span>

#include "firmware/simplify/edge_removal/edge_removal.h"
#include "hal/crc32.h"
#include "tests/firmware/simplify/replay.h"

namespace usuzumi::testing {
namespace {

using namespace firmware;

// Random triangles over few vertices: edges of many faces, repeated faces, faces without extent, equal positions.
Mesh soup(unsigned seed) {
  std::mt19937 random(seed);
  Mesh mesh;
  const auto vertices = static_cast<std::uint32_t>(3 + random() % 60),
             faces = static_cast<std::uint32_t>(1 + random() % 200);
  const auto coordinate = [&] { return static_cast<float>(random() % 9) - 4.0f; };
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const float x = coordinate(), y = coordinate(), z = coordinate();
    mesh.positions.push_back({x, y, z});
    if (seed % 2 == 0) mesh.normals.push_back(pack_normal({coordinate(), coordinate(), 1}));
    if (seed % 5 == 0) mesh.colours.push_back({static_cast<std::uint32_t>(random() % 3)});
    if (seed % 3 == 0)
      mesh.texture_coordinates.push_back({static_cast<float>(random() % 2), static_cast<float>(random() % 2)});
  }
  for (std::uint32_t i = 0; i < faces * 3; ++i) mesh.indices.push_back(static_cast<std::uint32_t>(random() % vertices));
  return mesh;
}

SimplifyOptions options_of(unsigned seed, std::uint32_t target) {
  SimplifyOptions options{.target_faces = target, .method = Method::kEdgeRemoval};
  options.edge_removal.placement = static_cast<EdgePlacement>(seed % 5);
  options.edge_removal.boundary_answer = static_cast<BoundaryAnswer>(seed / 5 % 2);
  options.edge_removal.boundary_limit = seed % 7 == 0 ? 0.0f : 1e-2f;
  options.edge_removal.neighbour_weight = seed % 4 == 0 ? 0.5f : 0.0f;
  return options;
}

void expect_sound(const Mesh& before, const Thinned& thinned, std::uint32_t target) {
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
            after.face_count() <= target ? StopReason::kQuotaReached : StopReason::kNoCollapseAllowed);
  const MeshTopology t0 = topology_of(before), t1 = topology_of(after);
  EXPECT_LE(t1.non_manifold_edges, t0.non_manifold_edges);
  EXPECT_EQ(t1.degenerate_faces, 0u);
}

TEST(EdgeRemovalRobustness, SoupsStaySoundAndTheirLogsReplay) {
  std::size_t collapses = 0;
  for (unsigned seed = 1; seed <= 600; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = soup(seed);
    const auto target = static_cast<std::uint32_t>(seed % 5 * mesh.face_count() / 6);
    SimplifyOptions options = options_of(seed, target);
    if (seed % 7 < 5) options.edge_removal.boundary_limit = 1;
    const Thinned thinned = thin(mesh, options);
    expect_sound(mesh, thinned, target);
    RoomyLog room(mesh);
    options.log = &room.log;
    const Thinned again = thin(mesh, options);
    EXPECT_EQ(again.mesh.indices, thinned.mesh.indices);
    EXPECT_EQ(again.mesh.positions, thinned.mesh.positions);
    EXPECT_EQ(again.outcome.work.edges_costed, thinned.outcome.work.edges_costed);
    expect_replay_gives(mesh, room.log, again.mesh);
    EXPECT_EQ(room.log.steps().size(), again.outcome.work.collapses);
    collapses += again.outcome.work.collapses;
  }
  EXPECT_GT(collapses, 20u) << "hardly an edge of a soup is no boundary";
}

// A closed surface whose vertices were moved at random, so much that it cuts itself, and with a few faces missing.
TEST(EdgeRemovalRobustness, CrumpledSurfacesStaySoundAndTheirLogsReplay) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Mesh mesh = icosphere(2);
    for (Vec3& p : mesh.positions)
      p = p + Vec3{static_cast<float>(random() % 1000), static_cast<float>(random() % 1000),
                   static_cast<float>(random() % 1000)} *
                  5e-4f;
    for (unsigned i = 0; i < seed % 6; ++i) {
      const auto face = static_cast<std::ptrdiff_t>(random() % mesh.face_count());
      mesh.indices.erase(mesh.indices.begin() + face * 3, mesh.indices.begin() + face * 3 + 3);
    }
    SimplifyOptions options = options_of(seed, 60);
    RoomyLog room(mesh);
    options.log = &room.log;
    const Thinned thinned = thin(mesh, options);
    expect_sound(mesh, thinned, 60);
    EXPECT_LE(topology_of(thinned.mesh).border_edges, topology_of(mesh).border_edges);
    expect_replay_gives(mesh, room.log, thinned.mesh);
    EXPECT_GT(thinned.outcome.work.collapses, 60u);
  }
}

TEST(EdgeRemovalRobustness, SettingsThatAreNoNumbersAreSurvived) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const Mesh mesh = icosphere(2);
  for (const float bad : {nan, infinity, -1.0f, 3e38f}) {
    for (int field = 0; field < 6; ++field) {
      SimplifyOptions options = options_of(0, 100);
      float* fields[] = {&options.edge_removal.a,           &options.edge_removal.b,
                         &options.edge_removal.neighbour_weight, &options.edge_removal.computed_weight,
                         &options.edge_removal.user_weight, &options.edge_removal.boundary_limit};
      *fields[field] = bad;
      const Thinned thinned = thin(mesh, options);
      expect_sound(mesh, thinned, 100);
    }
  }
}

TEST(EdgeRemovalRobustness, TooLittleScratchLeavesTheMeshAsItWas) {
  const Mesh mesh = with_flat_normals(icosphere(1));
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const auto faces = static_cast<std::uint32_t>(mesh.face_count());
  const std::size_t need = edge_removal_scratch_bytes(vertices, faces);
  // The last 16 bytes are room for the alignment of the arena's start.
  for (std::size_t bytes = 1; bytes + 16 < need; bytes += bytes < 64 || bytes + 80 > need ? 1 : 37) {
    const Thinned thinned = thin(mesh, options_of(1, 20), bytes);
    ASSERT_EQ(thinned.status.code, StatusCode::kResourceExhausted) << bytes;
    ASSERT_EQ(thinned.mesh.positions, mesh.positions);
    ASSERT_EQ(thinned.mesh.indices, mesh.indices);
    ASSERT_EQ(thinned.mesh.normals, mesh.normals);
    ASSERT_EQ(thinned.scratch_used, 0u);
  }
  EXPECT_TRUE(thin(mesh, options_of(1, 20)).status.ok());
}

TEST(EdgeRemovalRobustness, ScratchIsGivenBackItsSizeIsWhatWasSaidAndWhatItHeldDoesNotMatter) {
  const Mesh mesh = icosphere(3);
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const auto faces = static_cast<std::uint32_t>(mesh.face_count());
  const std::size_t need = edge_removal_scratch_bytes(vertices, faces);
  EXPECT_LE(need, 72u * vertices + 68u * faces + 160u);
  const Thinned expected = thin(mesh, options_of(5, 100));
  for (const std::size_t misalignment : {0u, 1u, 7u, 15u}) {
    Mesh copy = mesh;
    std::vector<std::byte> memory(need + misalignment, static_cast<std::byte>(0x3F + misalignment * 16));
    Arena scratch(memory);
    (void)scratch.allocate<std::byte>(misalignment);
    WorkingMesh working{.positions = copy.positions, .indices = copy.indices, .vertex_count = vertices,
                        .face_count = faces};
    ASSERT_TRUE(simplify_edge_removal(working, options_of(5, 100), scratch).ok()) << misalignment;
    EXPECT_EQ(scratch.used(), misalignment);
    EXPECT_LE(scratch.high_water(), need + misalignment);
    EXPECT_GE(scratch.high_water() + 32, need) << "the bound is tight";
    copy.positions.resize(working.vertex_count);
    copy.indices.resize(std::size_t{working.face_count} * 3);
    EXPECT_EQ(copy.indices, expected.mesh.indices);
    EXPECT_EQ(copy.positions, expected.mesh.positions);
  }
}

TEST(EdgeRemovalRobustness, AFullLogStopsTheMethodAndTheMeshIsSound) {
  const Mesh mesh = icosphere(2);
  for (std::size_t entries = 0; entries < 100; entries += 7) {
    RoomyLog room(mesh, entries);
    SimplifyOptions options = options_of(0, 20);
    options.log = &room.log;
    EXPECT_EQ(thin(mesh, options).status.code, StatusCode::kResourceExhausted) << entries;
  }
}

TEST(EdgeRemovalRobustness, NothingAndNothingToDoAreDone) {
  const Thinned empty = thin(Mesh{}, options_of(0, 0), 64);
  EXPECT_TRUE(empty.status.ok());
  const Mesh mesh = icosphere(0);
  const Thinned same = thin(mesh, options_of(0, 20));
  EXPECT_EQ(same.mesh.positions, mesh.positions);
  EXPECT_EQ(same.mesh.indices, mesh.indices);
  EXPECT_EQ(same.outcome.work.collapses, 0u);
  Mesh line;  // three points on a line: a face without area
  line.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  line.indices = {0, 1, 2, 0, 0, 1};
  EXPECT_EQ(thin(line, options_of(0, 0)).outcome.stop, StopReason::kNoCollapseAllowed);
}

}  // namespace
}  // namespace usuzumi::testing
