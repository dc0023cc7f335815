// Any input, any amount of scratch: the result is sound, repeatable, or the mesh is as it was.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <span>

#include "firmware/simplify/vertex_deletion/vertex_deletion.h"
#include "hal/crc32.h"
#include "tests/firmware/simplify/simplify_fixture.h"

namespace usuzumi::testing {
namespace {

using firmware::Method;
using firmware::StopReason;
using firmware::VertexDeletionSettings;

Thinned delete_to(const Mesh& mesh, std::uint32_t target, std::size_t scratch_bytes = 0) {
  return thin(mesh, {.target_faces = target, .method = Method::kVertexDeletion}, scratch_bytes);
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
    if (seed % 5 == 0) mesh.texture_coordinates.push_back({coordinate(), static_cast<float>(random() % 2)});
  }
  for (std::uint32_t i = 0; i < faces * 3; ++i) mesh.indices.push_back(static_cast<std::uint32_t>(random() % vertices));
  return mesh;
}

// A sheet or a ball that was crumpled, doubled here and there, with holes and seams at random.
Mesh crumpled(unsigned seed) {
  std::mt19937 random(seed);
  Mesh mesh = seed % 2 == 0 ? icosphere(2) : grid(12, 12);
  const float size = seed % 2 == 0 ? 5e-4f : 2e-3f;
  for (Vec3& p : mesh.positions)
    p = p + Vec3{static_cast<float>(random() % 1000), static_cast<float>(random() % 1000),
                 static_cast<float>(random() % 1000)} * size;
  for (int i = 0; i < 5; ++i) {
    const auto face = static_cast<std::ptrdiff_t>(random() % mesh.face_count());
    mesh.indices.erase(mesh.indices.begin() + face * 3, mesh.indices.begin() + face * 3 + 3);
  }
  const std::size_t given = mesh.positions.size();
  mesh.colours.assign(given, Rgba8{});
  for (std::size_t i = 0; seed % 3 == 0 && i < mesh.indices.size(); ++i) {
    if (random() % 20 != 0) continue;
    mesh.positions.push_back(mesh.positions[mesh.indices[i]]);
    mesh.colours.push_back({static_cast<std::uint32_t>(random() % 2)});
    mesh.indices[i] = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  }
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
  const MeshTopology t0 = topology_of(before), t1 = topology_of(after);
  EXPECT_LE(t1.non_manifold_edges, t0.non_manifold_edges);
  EXPECT_LE(t1.misoriented_edges, t0.misoriented_edges);
  EXPECT_EQ(t1.degenerate_faces, 0u);
}

TEST(VertexDeletionRobustness, SoupsStaySound) {
  for (unsigned seed = 1; seed <= 600; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = soup(seed);
    const auto target = static_cast<std::uint32_t>(seed % 5 * mesh.face_count() / 6);
    const Thinned thinned = delete_to(mesh, target);
    expect_sound(mesh, thinned, target);
    const Thinned again = delete_to(mesh, target);
    EXPECT_EQ(again.mesh.indices, thinned.mesh.indices);
    EXPECT_EQ(again.mesh.positions, thinned.mesh.positions);
    EXPECT_EQ(again.outcome.work.edges_costed, thinned.outcome.work.edges_costed);
  }
}

TEST(VertexDeletionRobustness, CrumpledSurfacesKeepTheirTopology) {
  for (unsigned seed = 1; seed <= 120; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = crumpled(seed);
    const Thinned thinned = delete_to(mesh, 20);
    expect_sound(mesh, thinned, 20);
    const MeshTopology t0 = topology_of(mesh), t1 = topology_of(thinned.mesh);
    EXPECT_EQ(t1.euler(), t0.euler()) << "no hole opened or closed";
    EXPECT_LT(thinned.mesh.face_count(), mesh.face_count());
  }
}

TEST(VertexDeletionRobustness, TooLittleScratchLeavesTheMeshAsItWas) {
  const Mesh mesh = icosphere(1);
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const auto faces = static_cast<std::uint32_t>(mesh.face_count());
  const std::size_t need = firmware::vertex_deletion_scratch_bytes(vertices, faces);
  // The last 16 bytes are room for the alignment of the arena's start.
  for (std::size_t bytes = 1; bytes + 16 < need; bytes += bytes < 64 || bytes + 80 > need ? 1 : 37) {
    const Thinned thinned = delete_to(mesh, 20, bytes);
    ASSERT_EQ(thinned.status.code, StatusCode::kResourceExhausted) << bytes;
    ASSERT_EQ(thinned.mesh.positions, mesh.positions);
    ASSERT_EQ(thinned.mesh.indices, mesh.indices);
    ASSERT_EQ(thinned.scratch_used, 0u);
  }
  EXPECT_TRUE(delete_to(mesh, 20).status.ok());
}

TEST(VertexDeletionRobustness, ScratchIsGivenBackWhateverItHeldAndWhereverItBegan) {
  const Mesh mesh = icosphere(3);
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const auto faces = static_cast<std::uint32_t>(mesh.face_count());
  const std::size_t need = firmware::vertex_deletion_scratch_bytes(vertices, faces);
  const Thinned expected = delete_to(mesh, 100);
  for (const std::size_t misalignment : {0u, 1u, 7u, 15u}) {
    Mesh copy = mesh;
    std::vector<std::byte> memory(need + misalignment, static_cast<std::byte>(misalignment * 17));
    Arena scratch(memory);
    (void)scratch.allocate<std::byte>(misalignment);
    firmware::WorkingMesh working{.positions = copy.positions, .indices = copy.indices, .vertex_count = vertices,
                                  .face_count = faces};
    ASSERT_TRUE(
        firmware::simplify(working, {.target_faces = 100, .method = Method::kVertexDeletion}, scratch).ok());
    EXPECT_EQ(scratch.used(), misalignment);
    EXPECT_LE(scratch.high_water(), need + misalignment);
    EXPECT_GE(scratch.high_water() + 32, need) << "the bound is tight";
    copy.indices.resize(std::size_t{working.face_count} * 3);
    EXPECT_EQ(copy.indices, expected.mesh.indices);
  }
}

TEST(VertexDeletionRobustness, WildSettingsAreSurvived) {
  const Mesh mesh = icosphere(2);
  for (const float value : {0.0f, 1e-30f, 1e30f, 3e38f}) {
    VertexDeletionSettings s{value, value, value, value, value, value, value, value, value, value};
    const Thinned thinned =
        thin(mesh, {.target_faces = 100, .method = Method::kVertexDeletion, .vertex_deletion = s});
    ASSERT_TRUE(thinned.status.ok());
    EXPECT_EQ(topology_of(thinned.mesh).euler(), 2);
  }
}

// One literal for every compiler, processor and optimisation level. It changes only when the method does; then the new
// value is what the failure prints.
TEST(VertexDeletionRobustness, BytesAreTheSameEverywhere) {
  Mesh mesh = icosphere(4);
  for (Vec3& p : mesh.positions) {
    p = {p.x * 1.5f + 0.1f * p.y * p.y, p.y + 0.2f * p.x * p.z, p.z * 0.7f};
    mesh.colours.push_back(rgba8(p.x > 0.3f ? 10 : 200, 50, 60));
  }
  const Thinned thinned = delete_to(mesh, 900);
  std::uint32_t crc = kCrc32Start;
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.positions)));
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.indices)));
  EXPECT_EQ(crc, 4198142742u);
}

}  // namespace
}  // namespace usuzumi::testing
