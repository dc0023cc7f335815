// The texture follows the shape, and its boundaries neither tear nor wander.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "firmware/simplify/edge_removal/edge_removal.h"
#include "tests/firmware/simplify/replay.h"

namespace usuzumi::testing {
namespace {

using namespace firmware;

constexpr float kPatchStep = 64;  // texture coordinates of patch i lie around (i * kPatchStep, 0)

// Where patch `patch` has the image of `p`: affine, another map for each patch. Merging texture coordinates by the same
// t as positions keeps any affine map.
TexCoord image_of(int patch, Vec3 p) {
  const auto f = static_cast<float>(patch);
  return {f * kPatchStep + p.x * 3 - p.y + p.z * (1 + f), p.y * 2 + p.z * 5 - p.x * f};
}
int patch_of(TexCoord t) { return static_cast<int>(std::floor(t.s / kPatchStep + 0.5f)); }

// `mesh` with texture coordinates of the patch that `choose(middle of the face)` says; every face has its own wedges.
template <class Choose>
Mesh patched(const Mesh& mesh, Choose choose) {
  Mesh result;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    Vec3 corners[3];
    for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.positions[mesh.indices[3 * f + k]];
    const int patch = choose((corners[0] + corners[1] + corners[2]) * (1.0f / 3));
    for (const Vec3 p : corners) {
      result.indices.push_back(static_cast<std::uint32_t>(result.positions.size()));
      result.positions.push_back(p);
      result.texture_coordinates.push_back(image_of(patch, p));
    }
  }
  return result;
}

int cube_side(Vec3 p) {
  const float x = std::fabs(p.x), y = std::fabs(p.y), z = std::fabs(p.z);
  if (x >= y && x >= z) return p.x > 0 ? 0 : 1;
  if (y >= z) return p.y > 0 ? 2 : 3;
  return p.z > 0 ? 4 : 5;
}

// Every face lies in one patch, and every corner shows the image that belongs at its place.
void expect_image_in_place(const Mesh& mesh, float tolerance) {
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const int patch = patch_of(mesh.texture_coordinates[mesh.indices[3 * f]]);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.indices[3 * f + k];
      const TexCoord expected = image_of(patch, mesh.positions[v]), found = mesh.texture_coordinates[v];
      EXPECT_NEAR(found.s, expected.s, tolerance) << "face " << f << " corner " << k;
      EXPECT_NEAR(found.t, expected.t, tolerance) << "face " << f << " corner " << k;
    }
  }
}

std::set<int> patches_of(const Mesh& mesh) {
  std::set<int> patches;
  for (const TexCoord t : mesh.texture_coordinates) patches.insert(patch_of(t));
  return patches;
}

SimplifyOptions options_of(std::uint32_t target) {
  return {.target_faces = target, .method = Method::kEdgeRemoval};
}

TEST(EdgeRemovalTexture, ImageStaysInItsPlaceOnASphereOfSixPatches) {
  const Mesh mesh = patched(icosphere(4), cube_side);
  const MeshTopology before = topology_of(mesh);
  for (const int placement : {0, 1, 2, 3, 4}) {
    for (const std::uint32_t target : {2560u, 1024u, 256u}) {
      SCOPED_TRACE(placement);
      SimplifyOptions options = options_of(target);
      options.edge_removal.placement = static_cast<EdgePlacement>(placement);
      options.edge_removal.boundary_limit = 1e-2f;
      RoomyLog room(mesh);
      options.log = &room.log;
      const Thinned thinned = thin(mesh, options);
      ASSERT_TRUE(thinned.status.ok());
      EXPECT_LE(thinned.mesh.face_count(), target);
      expect_image_in_place(thinned.mesh, 2e-4f);
      EXPECT_EQ(patches_of(thinned.mesh).size(), 6u);
      const MeshTopology after = topology_of(thinned.mesh);
      EXPECT_EQ(after.euler(), before.euler());
      EXPECT_EQ(after.border_edges, 0u) << "a seam has opened";
      EXPECT_EQ(after.non_manifold_edges, 0u);
      expect_replay_gives(mesh, room.log, thinned.mesh);
    }
  }
}

TEST(EdgeRemovalTexture, WedgesThatDifferInNormalsOnlyFollowTheImage) {
  Mesh mesh = patched(icosphere(3), cube_side);
  mesh.normals = with_flat_normals(icosphere(3)).normals;  // of the same faces in the same order, three wedges each
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  SimplifyOptions options = options_of(300);
  options.edge_removal.boundary_limit = 1e-2f;
  const Thinned thinned = thin(mesh, options);
  ASSERT_TRUE(thinned.status.ok());
  EXPECT_EQ(thinned.mesh.face_count(), 300u);
  expect_image_in_place(thinned.mesh, 2e-4f);
  EXPECT_EQ(topology_of(thinned.mesh).border_edges, 0u);
}

TEST(EdgeRemovalTexture, BoundariesOfPatchesOnACubeStayItsEdges) {
  Mesh unit = cube(8);
  for (Vec3& p : unit.positions) p = p * 0.125f;
  const Mesh mesh = patched(unit, [](Vec3 p) { return cube_side(p - Vec3{0.5f, 0.5f, 0.5f}); });
  const Thinned thinned = thin(mesh, options_of(12));
  ASSERT_TRUE(thinned.status.ok());
  EXPECT_EQ(thinned.mesh.face_count(), 12u);
  EXPECT_EQ(thinned.mesh.positions.size(), 24u) << "eight corners, three images each";
  expect_image_in_place(thinned.mesh, 1e-4f);
  for (const Vec3 p : thinned.mesh.positions)
    for (const float x : {p.x, p.y, p.z}) EXPECT_TRUE(x == 0 || x == 1) << x;
}

TEST(EdgeRemovalTexture, RandomPatchesNeverTearNorVanish) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Mesh round = icosphere(2);
    for (Vec3& p : round.positions)
      p = p + Vec3{static_cast<float>(random() % 100), static_cast<float>(random() % 100),
                   static_cast<float>(random() % 100)} *
                  1e-3f;
    // Islands of one face and more, slits, corners of many patches.
    const Mesh mesh = patched(round, [&](Vec3 p) {
      return random() % 6 == 0 ? 1 + static_cast<int>(random() % 3) : p.x > 0 ? 4 : 5;
    });
    SimplifyOptions options = options_of(20);
    options.edge_removal.boundary_limit = 1;
    options.edge_removal.placement = static_cast<EdgePlacement>(seed % 5);
    RoomyLog room(mesh);
    options.log = &room.log;
    const Thinned thinned = thin(mesh, options);
    ASSERT_TRUE(thinned.status.ok());
    expect_image_in_place(thinned.mesh, 5e-4f);
    EXPECT_EQ(topology_of(thinned.mesh).border_edges, 0u);
    EXPECT_EQ(patches_of(thinned.mesh), patches_of(mesh));
    EXPECT_GT(thinned.outcome.work.collapses, 0u);
    expect_replay_gives(mesh, room.log, thinned.mesh);
  }
}

}  // namespace
}  // namespace usuzumi::testing
