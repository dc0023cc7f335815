// What vertex deletion keeps of whole meshes: closedness, topology, outlines, seams, and the vertices it was given.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <tuple>

#include "firmware/simplify/vertex_deletion/presets.h"
#include "tests/bench/simplify/error_meter.h"
#include "tests/firmware/simplify/simplify_fixture.h"
#include "tests/firmware/simplify/vertex_deletion/seamed_meshes.h"

namespace usuzumi::testing {
namespace {

using firmware::Method;
using firmware::StopReason;
using firmware::VertexDeletionSettings;

Thinned delete_to(const Mesh& mesh, std::uint32_t target, const VertexDeletionSettings& settings = {}) {
  return thin(mesh, {.target_faces = target, .method = Method::kVertexDeletion, .vertex_deletion = settings});
}

using VertexBits = std::array<std::uint32_t, 7>;
VertexBits bits_of(const Mesh& mesh, std::size_t v) {
  VertexBits bits{};
  std::memcpy(bits.data(), &mesh.positions[v], 12);
  if (!mesh.normals.empty()) bits[3] = mesh.normals[v].bits;
  if (!mesh.colours.empty()) bits[4] = mesh.colours[v].bits;
  if (!mesh.texture_coordinates.empty()) std::memcpy(bits.data() + 5, &mesh.texture_coordinates[v], 8);
  return bits;
}

void expect_subset(const Mesh& thinned, const Mesh& given) {
  std::set<VertexBits> all;
  for (std::size_t v = 0; v < given.positions.size(); ++v) all.insert(bits_of(given, v));
  for (std::size_t v = 0; v < thinned.positions.size(); ++v)
    ASSERT_TRUE(all.contains(bits_of(thinned, v))) << "vertex " << v << " is not one that was given";
}

double area_of(const Mesh& mesh, double* upwards = nullptr) {
  double area = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const Vec3 a = mesh.positions[mesh.indices[3 * f]], b = mesh.positions[mesh.indices[3 * f + 1]],
               c = mesh.positions[mesh.indices[3 * f + 2]];
    area += static_cast<double>(length(cross(b - a, c - a))) / 2;
    if (upwards != nullptr) *upwards += static_cast<double>(cross(b - a, c - a).z) / 2;
  }
  return area;
}

TEST(VertexDeletionShape, ClosedSphereStaysAClosedManifoldAtEveryQuota) {
  const Mesh sphere = icosphere(3);
  for (const std::uint32_t percent : {90u, 70u, 50u, 35u, 20u, 10u, 5u, 3u, 1u, 0u}) {
    SCOPED_TRACE(percent);
    const auto target = static_cast<std::uint32_t>(sphere.face_count() * percent / 100);
    const Thinned thinned = delete_to(sphere, target);
    ASSERT_TRUE(thinned.status.ok());
    const MeshTopology t = topology_of(thinned.mesh);
    EXPECT_EQ(t.euler(), 2);
    EXPECT_EQ(t.border_edges, 0u);
    EXPECT_EQ(t.non_manifold_edges, 0u);
    EXPECT_EQ(t.misoriented_edges, 0u);
    EXPECT_EQ(t.degenerate_faces, 0u);
    expect_subset(thinned.mesh, sphere);
    if (percent >= 5) {
      EXPECT_EQ(thinned.mesh.face_count(), target);
      EXPECT_EQ(bench::count_flipped_faces(sphere, thinned.mesh, 0.3), 0u);
    }
  }
}

TEST(VertexDeletionShape, BumpySurfaceOfHigherGenusKeepsItsTopology) {
  const Mesh ring = torus(48, 24);
  for (const std::uint32_t target : {1200u, 500u, 120u}) {
    const Thinned thinned = delete_to(ring, target);
    const MeshTopology t = topology_of(thinned.mesh);
    EXPECT_EQ(t.euler(), 0);
    EXPECT_EQ(t.border_edges + t.non_manifold_edges + t.misoriented_edges, 0u);
    EXPECT_EQ(thinned.mesh.face_count(), target);
  }
}

TEST(VertexDeletionShape, FlatSheetKeepsItsOutlineDownToTwoFaces) {
  const Mesh sheet = grid(16, 16);
  for (const std::uint32_t target : {400u, 100u, 20u, 2u}) {
    SCOPED_TRACE(target);
    const Thinned thinned = delete_to(sheet, target);
    EXPECT_LE(thinned.mesh.face_count(), target);
    double upwards = 0;
    EXPECT_NEAR(area_of(thinned.mesh, &upwards), 256, 1e-3);
    EXPECT_NEAR(upwards, 256, 1e-3);
    EXPECT_EQ(thinned.outcome.max_error, 0.0f);
    const MeshTopology t = topology_of(thinned.mesh);
    EXPECT_EQ(t.euler(), 1);
    EXPECT_EQ(t.non_manifold_edges, 0u);
  }
}

TEST(VertexDeletionShape, PlanesGoBeforeCurvedParts) {
  // A sheet of 32 x 32 cells with a dome on its middle. While flat vertices are left none of the dome goes.
  Mesh sheet = grid(32, 32);
  const auto is_dome = [](Vec3 p) { return (p.x - 16) * (p.x - 16) + (p.y - 16) * (p.y - 16) < 36; };
  std::size_t dome = 0;
  for (Vec3& p : sheet.positions) {
    if (!is_dome(p)) continue;
    p.z = 0.05f * (36 - (p.x - 16) * (p.x - 16) - (p.y - 16) * (p.y - 16));
    ++dome;
  }
  const auto left = [&](const Mesh& mesh) {
    return static_cast<std::size_t>(std::count_if(mesh.positions.begin(), mesh.positions.end(), is_dome));
  };
  EXPECT_EQ(left(delete_to(sheet, 1024, firmware::kFlatPreset).mesh), dome) << "half of the faces";
  EXPECT_LT(left(delete_to(sheet, 100, firmware::kFlatPreset).mesh), dome);
}

// The reported result: up to 95 % of the vertices removed with the shape kept.
TEST(VertexDeletionShape, AtFivePercentABallIsWithinTwoPercentOfItsRadius) {
  const Mesh sphere = icosphere(5);
  const Thinned thinned = delete_to(sphere, static_cast<std::uint32_t>(sphere.face_count() / 20));
  EXPECT_LE(thinned.mesh.positions.size(), sphere.positions.size() / 20 + 2);
  const bench::SurfaceError e = bench::measure_error(sphere, thinned.mesh, 20000);
  EXPECT_LT(e.hausdorff, 0.02);
  EXPECT_LT(e.rms, 0.008);
  EXPECT_EQ(bench::count_flipped_faces(sphere, thinned.mesh, e.hausdorff), 0u);
}

TEST(VertexDeletionShape, TextureSeamOfASheetIsThinnedWithoutATear) {
  const Mesh sheet = two_charts(16);
  for (const std::uint32_t target : {300u, 100u, 20u, 4u}) {
    SCOPED_TRACE(target);
    const Thinned thinned = delete_to(sheet, target);
    EXPECT_LE(thinned.mesh.face_count(), target);
    expect_subset(thinned.mesh, sheet);
    EXPECT_EQ(topology_of(thinned.mesh).euler(), 1) << "welded by position, no hole along the seam";
    // Each chart covers its half, and its texture covers what it did, the same way round.
    double covered[2] = {}, texture[2] = {};
    for (std::size_t f = 0; f < thinned.mesh.face_count(); ++f) {
      const std::uint32_t* v = &thinned.mesh.indices[3 * f];
      const bool right = thinned.mesh.texture_coordinates[v[0]].s > 1;
      const Vec3 a = thinned.mesh.positions[v[0]], b = thinned.mesh.positions[v[1]], c = thinned.mesh.positions[v[2]];
      const TexCoord s = thinned.mesh.texture_coordinates[v[0]], t = thinned.mesh.texture_coordinates[v[1]],
                     u = thinned.mesh.texture_coordinates[v[2]];
      for (std::size_t k = 1; k < 3; ++k) EXPECT_EQ(thinned.mesh.texture_coordinates[v[k]].s > 1, right);
      covered[right] += static_cast<double>(cross(b - a, c - a).z) / 2;
      const float area = (t.s - s.s) * (u.t - s.t) - (u.s - s.s) * (t.t - s.t);
      EXPECT_GT(area, 0);
      texture[right] += static_cast<double>(area) / 2;
    }
    for (const int chart : {0, 1}) {
      EXPECT_NEAR(covered[chart], 128, 1e-3);
      EXPECT_NEAR(texture[chart], 0.5, 1e-5);
    }
  }
}

TEST(VertexDeletionShape, CornersOfSeamsStay) {
  // A cube of six charts: its 8 corners have three wedges each, and are the last to be left.
  const Mesh box = with_flat_normals(cube(8));
  const Thinned thinned = delete_to(box, 12);
  EXPECT_EQ(thinned.mesh.face_count(), 12u);
  EXPECT_EQ(topology_of(thinned.mesh).vertices, 8u);
  EXPECT_EQ(topology_of(thinned.mesh).euler(), 2);
  EXPECT_NEAR(area_of(thinned.mesh), 6 * 64, 1e-3);
  expect_subset(thinned.mesh, box);
}

TEST(VertexDeletionShape, CreaseOfACappedCylinderIsThinnedFromBothSides) {
  const Mesh can = capped_cylinder(48, 12);
  for (const std::uint32_t target : {500u, 200u, 60u}) {
    SCOPED_TRACE(target);
    const Thinned thinned = delete_to(can, target);
    EXPECT_LE(thinned.mesh.face_count(), target + 1);
    expect_subset(thinned.mesh, can);
    const MeshTopology t = topology_of(thinned.mesh);
    EXPECT_EQ(t.euler(), 2);
    EXPECT_EQ(t.border_edges + t.non_manifold_edges + t.misoriented_edges, 0u);
    // Caps stay flat at their height, with their normal; walls never get a cap's.
    for (std::size_t f = 0; f < thinned.mesh.face_count(); ++f) {
      const std::uint32_t* v = &thinned.mesh.indices[3 * f];
      const Vec3 n = unpack(thinned.mesh.normals[v[0]]);
      const bool cap = n.z > 0.9f || n.z < -0.9f;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 other = unpack(thinned.mesh.normals[v[k]]);
        EXPECT_EQ(other.z > 0.9f || other.z < -0.9f, cap);
        if (cap) { EXPECT_EQ(thinned.mesh.positions[v[k]].z > 0, n.z > 0); }
      }
    }
  }
}

TEST(VertexDeletionShape, PresetsChangeOneCoefficientEach) {
  using namespace firmware;
  constexpr VertexDeletionSettings defaults;
  EXPECT_LT(kFlatPreset.largest, defaults.largest);
  EXPECT_GT(kCurvedPreset.move, defaults.move);
  EXPECT_GT(kBoundedPreset.boundary_area, defaults.boundary_area);
  VertexDeletionSettings flat = kFlatPreset, curved = kCurvedPreset, bounded = kBoundedPreset;
  flat.largest = defaults.largest;
  curved.move = defaults.move;
  bounded.boundary_area = defaults.boundary_area;
  for (const VertexDeletionSettings& s : {flat, curved, bounded})
    EXPECT_EQ(std::memcmp(&s, &defaults, sizeof s), 0) << "nothing else differs";
}

}  // namespace
}  // namespace usuzumi::testing
