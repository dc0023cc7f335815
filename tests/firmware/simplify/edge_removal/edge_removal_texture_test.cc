// The texture follows the shape, and its boundaries neither tear nor wander.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "firmware/simplify/attributes.h"
#include "firmware/simplify/edge_removal/edge_removal.h"
#include "tests/firmware/simplify/replay.h"
#include "tests/study/seam_checks.h"
#include "tests/study/seam_shapes.h"

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

// An image on one small face of a ball: its sides are the cheapest edges there are.
TEST(EdgeRemovalTexture, AnIslandOfOneFaceIsNotSwallowed) {
  Mesh ball = icosphere(2);
  const std::uint32_t* island = &ball.indices[3 * 77];
  const Vec3 middle = (ball.positions[island[0]] + ball.positions[island[1]] + ball.positions[island[2]]) * (1.0f / 3);
  for (int k = 0; k < 3; ++k) {
    Vec3& p = ball.positions[island[k]];
    p = middle + (p - middle) * 0.3f;
  }
  const Vec3 apart = middle * 0.999f;
  const Mesh mesh = patched(ball, [&](Vec3 p) { return length(p - apart) < 0.01f ? 1 : 0; });
  ASSERT_EQ(patches_of(mesh).size(), 2u);
  SimplifyOptions options = options_of(60);
  options.edge_removal.boundary_limit = 1;
  const Thinned thinned = thin(mesh, options);
  EXPECT_EQ(thinned.mesh.face_count(), 60u);
  EXPECT_EQ(patches_of(thinned.mesh).size(), 2u);
  expect_image_in_place(thinned.mesh, 2e-4f);
}

// A square pipe along a path of bends, open at both ends.
Mesh pipe() {
  constexpr Vec3 kPath[] = {{0, 0, 0}, {0, 0, 5}, {0.1f, 0, 5.6f}, {0.5f, 0, 6}, {1.2f, 0, 6.2f}, {6, 0, 6.2f}};
  Mesh mesh;
  for (const Vec3 at : kPath) {
    const float lean = at.x > 1 ? 1.0f : at.x;  // across the path: from x towards -z
    const Vec3 across = normalized({1 - lean, 0, -lean});
    for (const float turn : {-1.0f, 1.0f})
      for (const float up : {-1.0f, 1.0f})
        mesh.positions.push_back(at + across * (0.3f * turn) + Vec3{0, 0.3f * up * turn, 0});
  }
  for (std::uint32_t ring = 0; ring + 4 < mesh.positions.size(); ring += 4)
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t a = ring + i, b = ring + (i + 1) % 4;
      mesh.indices.insert(mesh.indices.end(), {a, b, b + 4, a, b + 4, a + 4});
    }
  return mesh;
}

// At its mouths three boundaries meet in each corner: two of the outline, and the seam between two sides.
TEST(EdgeRemovalTexture, ACornerOfBoundariesStaysThoughTheOutlineWouldChangeByMoreThanTheLimit) {
  const Mesh shape = pipe();
  int side = 0;
  const Mesh mesh = patched(shape, [&](Vec3) { return side++ / 2 % 4; });
  for (const float limit : {0.0f, 1e-4f, 1e-3f, 1e-2f, 1.0f}) {
    SimplifyOptions options = options_of(8);
    options.edge_removal.boundary_limit = limit;
    const Thinned thinned = thin(mesh, options);
    ASSERT_TRUE(thinned.status.ok());
    for (std::size_t corner = 0; corner < shape.positions.size(); ++corner) {
      if (corner >= 4 && corner + 4 < shape.positions.size()) continue;
      const auto& left = thinned.mesh.positions;
      EXPECT_NE(std::find(left.begin(), left.end(), shape.positions[corner]), left.end()) << corner << ' ' << limit;
    }
    EXPECT_LT(thinned.mesh.face_count(), limit < 1 ? 41u : 30u);
  }
}

TEST(EdgeRemovalTexture, ARimIsNotLaidOverItsCap) {
  const study::TexturedPart part = study::creased_cylinder(24, 12, 6);
  Mesh mesh;
  mesh.positions = part.positions;
  mesh.indices = part.indices;
  mesh.texture_coordinates = part.coordinates;
  const Thinned thinned = thin(mesh, options_of(55));
  ASSERT_TRUE(thinned.status.ok());
  EXPECT_LT(thinned.mesh.face_count(), 100u);
  EXPECT_EQ(study::count_flipped(mesh, thinned.mesh), 0u);
}

// A flat disc of `sides` sides on the outline and two rings inside.
Mesh disc(int sides) {
  Mesh mesh;
  mesh.positions.push_back({0, 0, 0});
  for (int ring = 1; ring <= 3; ++ring)
    for (int i = 0; i < sides; ++i) {
      const double angle = 6.283185307179586 * i / sides;
      mesh.positions.push_back({static_cast<float>(std::cos(angle) * ring / 3),
                                static_cast<float>(std::sin(angle) * ring / 3), 0});
    }
  const auto at = [&](int ring, int i) { return static_cast<std::uint32_t>(1 + (ring - 1) * sides + i % sides); };
  for (int i = 0; i < sides; ++i) {
    mesh.indices.insert(mesh.indices.end(), {0, at(1, i), at(1, i + 1)});
    for (int ring = 1; ring < 3; ++ring)
      mesh.indices.insert(mesh.indices.end(), {at(ring, i), at(ring + 1, i), at(ring + 1, i + 1), at(ring, i),
                                               at(ring + 1, i + 1), at(ring, i + 1)});
  }
  return mesh;
}

double area_of(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.indices.size(); f += 3)
    sum += static_cast<double>(cross(mesh.positions[mesh.indices[f + 1]] - mesh.positions[mesh.indices[f]],
                                     mesh.positions[mesh.indices[f + 2]] - mesh.positions[mesh.indices[f]])
                                   .z) /
           2;
  return sum;
}

TEST(EdgeRemovalTexture, AnOutlineAboveTheLimitIsLeftAsItWas) {
  // Of a regular polygon of n sides of length c, turned by w = 2 pi / n from side to side, eq. (2) is 2 c^2 sin w.
  const Mesh mesh = disc(24);
  const double w = 6.283185307179586 / 24, c = 2 * std::sin(w / 2), value = 2 * c * c * std::sin(w);
  const double share = value / 8;  // the squared diagonal is 2^2 + 2^2
  for (const BoundaryAnswer answer : {BoundaryAnswer::kRefuse, BoundaryAnswer::kLimitMovement}) {
    SimplifyOptions options = options_of(2);
    options.edge_removal.boundary_answer = answer;
    // Moving the vertex instead to one of the ends changes half of it.
    const double least = answer == BoundaryAnswer::kRefuse ? share : share / 2;
    options.edge_removal.boundary_limit = static_cast<float>(least * 0.998);
    const Thinned kept = thin(mesh, options);
    EXPECT_EQ(topology_of(kept.mesh).border_edges, 24u);
    EXPECT_EQ(kept.mesh.face_count(), 22u) << "no vertex inside is left";
    EXPECT_EQ(kept.outcome.stop, StopReason::kNoCollapseAllowed);
    EXPECT_NEAR(area_of(kept.mesh), area_of(mesh), 1e-6);

    options.edge_removal.boundary_limit = static_cast<float>(least * 1.002);
    const Thinned gone = thin(mesh, options);
    EXPECT_LT(topology_of(gone.mesh).border_edges, 24u);
    // Each removal takes or adds two triangles of half what eq. (2) says, at most.
    const double removed = 24 - static_cast<double>(topology_of(gone.mesh).border_edges);
    EXPECT_LE(std::fabs(area_of(mesh) - area_of(gone.mesh)), removed * least * 8 / 2 * 1.01);
  }
}

TEST(EdgeRemovalTexture, TheMovementStopsAtTheLimit) {
  // 0 - 1 - 2 - 3 is the outline; eq. (2)'s terms for the edge 1-2 are 1 before and 0.25 after it:
  // E = (1, 0), L = (1, 1) and (2, -0.25). Everything else about it is straight, and no other edge may go.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 1, 0}, {2, 1, 0}, {4, 0.75f, 0}, {4, 0, 0}, {2, 0, 0}, {1, 0, 0}};
  mesh.indices = {0, 6, 1, 6, 5, 1, 1, 5, 2, 5, 4, 2, 4, 3, 2};
  const float squared_diagonal = 16 + 1;
  std::vector<float> values(mesh.positions.size(), 0.0f);
  for (const std::size_t v : {0u, 3u, 4u, 5u, 6u}) values[v] = kLockedEdgeValue;
  const auto placed_at = [&](float limit) {
    Mesh copy = mesh;
    RoomyLog room(mesh);
    SimplifyOptions options = options_of(4);
    options.edge_removal.placement = EdgePlacement::kMidpoint;
    options.edge_removal.boundary_limit = limit / squared_diagonal;
    options.log = &room.log;
    std::vector<std::byte> memory(edge_removal_scratch_bytes(7, 5));
    Arena scratch(memory);
    WorkingMesh working{.positions = copy.positions, .edge_values = values, .indices = copy.indices, .vertex_count = 7,
                        .face_count = 5};
    EXPECT_TRUE(simplify(working, options, scratch).ok());
    return room.log.added().empty() ? -9.0f : room.log.added()[0].position.x - 1;
  };
  EXPECT_FLOAT_EQ(placed_at(2), 0.5f);
  EXPECT_FLOAT_EQ(placed_at(0.5f), 1.0f / 3) << "t + (1 - t) / 4 = 1/2";
  EXPECT_NEAR(placed_at(0.2501f), 0, 2e-4f);
  EXPECT_EQ(placed_at(0.2f), -9) << "refused";
}

TEST(EdgeRemovalTexture, GroupsOfMaterialsAreImages) {
  // A sheet of two materials that meet at x = 4, without texture coordinates; the border between them keeps its place.
  Mesh mesh;
  std::vector<MaterialGroup> groups;
  for (const bool right : {false, true}) {
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    const Mesh half = grid(4, 8);
    for (const Vec3 p : half.positions) mesh.positions.push_back({right ? p.x + 4 : p.x, p.y, 0});
    for (const std::uint32_t i : half.indices) mesh.indices.push_back(base + i);
    groups.push_back(
        {static_cast<std::uint32_t>(mesh.face_count()), static_cast<std::uint32_t>(mesh.positions.size())});
  }
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size()),
             faces = static_cast<std::uint32_t>(mesh.face_count());
  std::vector<std::byte> memory(edge_removal_scratch_bytes(vertices, faces));
  Arena scratch(memory);
  WorkingMesh working{.positions = mesh.positions, .groups = groups, .indices = mesh.indices, .vertex_count = vertices,
                      .face_count = faces};
  ASSERT_TRUE(simplify(working, options_of(4), scratch).ok());
  EXPECT_EQ(working.face_count, 4u);
  for (std::uint32_t v = 0; v < working.vertex_count; ++v) {
    const float x = mesh.positions[v].x;
    EXPECT_TRUE(v < groups[0].vertex_end ? x == 0 || x == 4 : x == 4 || x == 8) << v << ' ' << x;
  }
}

TEST(EdgeRemovalTexture, ABoundaryGoesOnThroughAPlaceWhereItsImagesMeet) {
  // A sheet of two images that meet at x = 4 and are the same at y = 4 there.
  Mesh mesh;
  for (const bool right : {false, true}) {
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    const Mesh half = grid(4, 8);
    for (const Vec3 p : half.positions) {
      const Vec3 place{right ? p.x + 4 : p.x, p.y, 0};
      mesh.positions.push_back(place);
      mesh.texture_coordinates.push_back({right ? place.x + (place.y - 4) * 3 : place.x, place.y});
    }
    for (const std::uint32_t i : half.indices) mesh.indices.push_back(base + i);
  }
  for (const std::uint32_t target : {60u, 30u, 10u, 4u}) {
    SCOPED_TRACE(target);
    const Mesh thinned = thin(mesh, options_of(target)).mesh;
    EXPECT_LE(thinned.face_count(), 12u + target);
    for (std::size_t i = 0; i < thinned.indices.size(); i += 3) {
      float least = 8, most = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const float x = thinned.positions[thinned.indices[i + k]].x;
        least = std::min(least, x), most = std::max(most, x);
      }
      EXPECT_TRUE(most <= 4 || least >= 4) << "face " << i / 3 << " lies across the boundary";
    }
  }
}

TEST(EdgeRemovalTexture, BeyondAnEndCoordinatesGoOnAndColoursStopAtTheirRange) {
  EXPECT_EQ(mixed(TexCoord{1, 2}, TexCoord{2, 6}, -0.25f), (TexCoord{0.75f, 1}));
  EXPECT_EQ(mixed(TexCoord{1, 2}, TexCoord{2, 6}, 1.25f), (TexCoord{2.25f, 7}));
  EXPECT_EQ(mixed(rgba8(10, 200, 0, 255), rgba8(210, 0, 0, 255), -0.25f), rgba8(0, 250, 0, 255));
  EXPECT_EQ(mixed(rgba8(10, 200, 0, 255), rgba8(210, 0, 0, 255), 1.25f), rgba8(255, 0, 0, 255));
  const TexCoord far = mixed(TexCoord{3e38f, -3e38f}, TexCoord{-3e38f, 3e38f}, -0.25f);
  EXPECT_TRUE(std::isfinite(far.s) && std::isfinite(far.t));
}

}  // namespace
}  // namespace usuzumi::testing
