// Beside what holds of every method (robustness_test.cc): topology, any settings, the same bytes.
#include <gtest/gtest.h>

#include <random>
#include <span>

#include "hal/crc32.h"
#include "tests/firmware/simplify/robustness.h"

namespace usuzumi::testing {
namespace {

using firmware::Method;
using firmware::VertexDeletionSettings;

Thinned delete_to(const Mesh& mesh, std::uint32_t target) {
  return thin(mesh, {.target_faces = target, .method = Method::kVertexDeletion});
}

// A sheet or a ball that was crumpled, with holes, and torn at random into wedges of other colours.
Mesh torn(unsigned seed) {
  std::mt19937 random(seed);
  Mesh mesh = seed % 2 == 0 ? crumpled(icosphere(2), 0.5f, 5, random) : crumpled(grid(12, 12), 2, 5, random);
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

TEST(VertexDeletionRobustness, SoupsGetNoMoreEdgesWhoseFacesDisagree) {
  for (unsigned seed = 1; seed <= 600; ++seed) {
    const Mesh mesh = soup(seed);
    const auto target = static_cast<std::uint32_t>(seed % 5 * mesh.face_count() / 6);
    EXPECT_LE(topology_of(delete_to(mesh, target).mesh).misoriented_edges, topology_of(mesh).misoriented_edges) << seed;
  }
}

TEST(VertexDeletionRobustness, CrumpledSurfacesKeepTheirTopology) {
  for (unsigned seed = 1; seed <= 120; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = torn(seed);
    const Thinned thinned = delete_to(mesh, 20);
    expect_sound(mesh, thinned, 20);
    const MeshTopology t0 = topology_of(mesh), t1 = topology_of(thinned.mesh);
    EXPECT_EQ(t1.euler(), t0.euler()) << "no hole opened or closed";
    EXPECT_LE(t1.misoriented_edges, t0.misoriented_edges);
    EXPECT_LT(thinned.mesh.face_count(), mesh.face_count());
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
