// Any input, any amount of scratch: the result is sound, repeatable, or the mesh is as it was.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <span>

#include "firmware/simplify/qem/qem.h"
#include "hal/crc32.h"
#include "tests/firmware/simplify/simplify_fixture.h"

namespace usuzumi::testing {
namespace {

using firmware::Placement;
using firmware::StopReason;

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
  }
  for (std::uint32_t i = 0; i < faces * 3; ++i) mesh.indices.push_back(static_cast<std::uint32_t>(random() % vertices));
  return mesh;
}

// A closed surface whose vertices were moved at random, so much that it cuts itself, and with a few faces missing.
Mesh crumpled(unsigned seed) {
  std::mt19937 random(seed);
  Mesh mesh = icosphere(2);
  for (Vec3& p : mesh.positions)
    p = p + Vec3{static_cast<float>(random() % 1000), static_cast<float>(random() % 1000),
                 static_cast<float>(random() % 1000)} *
                5e-4f;
  for (int i = 0; i < 5; ++i) {
    const auto face = static_cast<std::ptrdiff_t>(random() % mesh.face_count());
    mesh.indices.erase(mesh.indices.begin() + face * 3, mesh.indices.begin() + face * 3 + 3);
  }
  return mesh;
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

TEST(QemRobustness, SoupsStaySound) {
  for (unsigned seed = 1; seed <= 600; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = soup(seed);
    const auto target = static_cast<std::uint32_t>(seed % 5 * mesh.face_count() / 6);
    const Placement placement = seed % 7 == 0 ? Placement::kMidpoint : Placement::kOptimal;
    const Thinned thinned = thin(mesh, target, placement);
    expect_sound(mesh, thinned, target);
    const Thinned again = thin(mesh, target, placement);
    EXPECT_EQ(again.mesh.indices, thinned.mesh.indices);
    EXPECT_EQ(again.mesh.positions, thinned.mesh.positions);
    EXPECT_EQ(again.outcome.work.edges_costed, thinned.outcome.work.edges_costed);
  }
}

TEST(QemRobustness, CrumpledSurfacesStaySoundAndStopOnlyWhereNothingMoves) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = crumpled(seed);
    const Thinned thinned = thin(mesh, 20);
    expect_sound(mesh, thinned, 20);
    if (thinned.outcome.stop != StopReason::kNoCollapseAllowed) continue;
    // Stopped for want of an allowed collapse: a fresh start must find none either. It starts with fresh quadrics, so
    // its placements differ a little; it may find a collapse or two more, not dozens.
    const Thinned again = thin(thinned.mesh, 20);
    EXPECT_LE(thinned.mesh.face_count() - again.mesh.face_count(), 8u);
  }
}

TEST(QemRobustness, TooLittleScratchLeavesTheMeshAsItWas) {
  const Mesh mesh = with_flat_normals(icosphere(1));
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const auto faces = static_cast<std::uint32_t>(mesh.face_count());
  const std::size_t need = firmware::qem_scratch_bytes(vertices, faces, false);
  // The last 16 bytes are room for the alignment of the arena's start.
  for (std::size_t bytes = 1; bytes + 16 < need; bytes += bytes < 64 || bytes + 80 > need ? 1 : 37) {
    const Thinned thinned = thin(mesh, 20, Placement::kOptimal, bytes);
    ASSERT_EQ(thinned.status.code, StatusCode::kResourceExhausted) << bytes;
    ASSERT_EQ(thinned.mesh.positions, mesh.positions);
    ASSERT_EQ(thinned.mesh.indices, mesh.indices);
    ASSERT_EQ(thinned.mesh.normals, mesh.normals);
    ASSERT_EQ(thinned.scratch_used, 0u);
  }
  EXPECT_TRUE(thin(mesh, 20).status.ok());
}

TEST(QemRobustness, ScratchIsGivenBackAndItsSizeIsWhatWasSaid) {
  const Mesh mesh = icosphere(3);
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const auto faces = static_cast<std::uint32_t>(mesh.face_count());
  const std::size_t need = firmware::qem_scratch_bytes(vertices, faces, false);
  EXPECT_LE(need, 128u * vertices) << "the bar; sizes of small arrays round up";
  for (const std::size_t misalignment : {0u, 1u, 7u, 15u}) {
    Mesh copy = mesh;
    std::vector<std::byte> memory(need + misalignment);
    Arena scratch(memory);
    (void)scratch.allocate<std::byte>(misalignment);
    firmware::WorkingMesh working{.positions = copy.positions, .indices = copy.indices, .vertex_count = vertices,
                                  .face_count = faces};
    ASSERT_TRUE(firmware::simplify_qem(working, {.target_faces = 100}, scratch).ok()) << misalignment;
    EXPECT_EQ(scratch.used(), misalignment);
    EXPECT_LE(scratch.high_water(), need + misalignment);
    EXPECT_GE(scratch.high_water() + 32, need) << "the bound is tight";
  }
}

// One literal for every compiler, processor and optimisation level. It changes only when the method does; then the new
// value is what the failure prints.
TEST(QemRobustness, BytesAreTheSameEverywhere) {
  Mesh mesh = icosphere(4);
  for (Vec3& p : mesh.positions) {
    p = {p.x * 1.5f + 0.1f * p.y * p.y, p.y + 0.2f * p.x * p.z, p.z * 0.7f};
    mesh.colours.push_back(rgba8(static_cast<std::uint32_t>(p.x * 60.0f + 120.0f), 50, 60));
    mesh.normals.push_back(pack_normal(normalized(p)));
  }
  const Thinned thinned = thin(mesh, 900);
  std::uint32_t crc = kCrc32Start;
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.positions)));
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.normals)));
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.colours)));
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.indices)));
  EXPECT_EQ(crc, 4130147165u);
}

TEST(QemRobustness, WhatTheScratchHeldBeforeDoesNotMatter) {
  const Mesh mesh = icosphere(3);
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const auto faces = static_cast<std::uint32_t>(mesh.face_count());
  const Thinned expected = thin(mesh, 150);
  for (const unsigned fill : {0x00u, 0x3Fu, 0xA5u, 0xFFu}) {
    Mesh copy = mesh;
    std::vector<std::byte> memory(firmware::qem_scratch_bytes(vertices, faces, false), static_cast<std::byte>(fill));
    Arena scratch(memory);
    firmware::WorkingMesh working{.positions = copy.positions, .indices = copy.indices, .vertex_count = vertices,
                                  .face_count = faces};
    ASSERT_TRUE(firmware::simplify_qem(working, {.target_faces = 150}, scratch).ok());
    copy.positions.resize(working.vertex_count);
    copy.indices.resize(std::size_t{working.face_count} * 3);
    EXPECT_EQ(copy.indices, expected.mesh.indices);
    EXPECT_EQ(copy.positions, expected.mesh.positions);
  }
}

}  // namespace
}  // namespace usuzumi::testing
