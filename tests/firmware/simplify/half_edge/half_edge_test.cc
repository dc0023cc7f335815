// What half-edge collapse leaves of a mesh: its own vertices, whole seams, whole borders.
#include "firmware/simplify/half_edge/half_edge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "tests/bench/simplify/error_meter.h"
#include "tests/firmware/simplify/half_edge/seamed_shapes.h"
#include "tests/firmware/simplify/simplify_fixture.h"
#include "tests/study/seam_checks.h"

namespace usuzumi::testing {
namespace {

using firmware::Method;
using firmware::StopReason;

Thinned thin_half_edge(const Mesh& mesh, std::size_t target) {
  return thin(mesh, {.target_faces = static_cast<std::uint32_t>(target), .method = Method::kHalfEdge});
}

template <class T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

TEST(HalfEdge, WhatIsLeftAreVerticesOfTheMeshAsGivenToTheBit) {
  Mesh mesh = ball_of_islands(3, 5, 1);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    mesh.positions[v] = mesh.positions[v] * 1.1e5f + Vec3{3e5f, 0, 0};
    if (v % 7 == 0 && std::fabs(mesh.positions[v].z) < 1) mesh.positions[v].z = -0.0f;
    mesh.normals.push_back(pack_normal(normalized(mesh.positions[v])));
    mesh.colours.push_back(rgba8(static_cast<std::uint32_t>(mesh.texture_coordinates[v].s * 9 + 20), 1, 2));
  }
  Mesh left = mesh;
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const auto faces = static_cast<std::uint32_t>(mesh.face_count());
  std::vector<std::uint32_t> sources(vertices);
  std::vector<std::byte> memory(firmware::half_edge_scratch_bytes(vertices, faces));
  Arena scratch(memory);
  firmware::WorkingMesh working{.positions = left.positions,
                                .normals = left.normals,
                                .colours = left.colours,
                                .texture_coordinates = left.texture_coordinates,
                                .indices = left.indices,
                                .vertex_count = vertices,
                                .face_count = faces,
                                .source_vertices = sources};
  ASSERT_TRUE(firmware::simplify_half_edge(working, {.target_faces = 200}, scratch).ok());
  EXPECT_EQ(working.face_count, 200u);
  for (std::uint32_t v = 0; v < working.vertex_count; ++v) {
    const std::uint32_t source = sources[v];
    ASSERT_LT(source, vertices);
    EXPECT_TRUE(same_bits(left.positions[v], mesh.positions[source]));
    EXPECT_TRUE(same_bits(left.normals[v], mesh.normals[source]));
    EXPECT_TRUE(same_bits(left.colours[v], mesh.colours[source]));
    EXPECT_TRUE(same_bits(left.texture_coordinates[v], mesh.texture_coordinates[source]));
    if (v > 0) { EXPECT_GT(source, sources[v - 1]); }
  }
}

TEST(HalfEdge, MinusZeroStaysWhatItWas) {
  // Two materials that meet at x = 2, where the left one's z is -0 and the right one's 0: one vertex, two wedges.
  const Mesh sheet = grid(4, 4);
  Mesh mesh;
  for (std::size_t i = 0; i < sheet.indices.size(); i += 3) {
    float right = 0;
    for (std::size_t k = 0; k < 3; ++k) right = std::max(right, sheet.positions[sheet.indices[i + k]].x);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = sheet.positions[sheet.indices[i + k]];
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back({p.x, p.y, right > 2 ? 0.0f : -0.0f});
      mesh.colours.push_back({right > 2 ? 1u : 2u});
    }
  }
  const Thinned thinned = thin_half_edge(mesh, 4);
  EXPECT_EQ(thinned.mesh.face_count(), 4u);
  for (std::size_t v = 0; v < thinned.mesh.positions.size(); ++v)
    EXPECT_EQ(std::signbit(thinned.mesh.positions[v].z), thinned.mesh.colours[v].bits == 2) << v;
}

double area_of(const Mesh& mesh) {
  double area = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3 p = mesh.positions[mesh.indices[i]];
    area += length(cross(mesh.positions[mesh.indices[i + 1]] - p, mesh.positions[mesh.indices[i + 2]] - p)) / 2;
  }
  return area;
}

TEST(HalfEdge, AFlatSheetBecomesTwoFacesOfTheSameOutline) {
  const Thinned thinned = thin_half_edge(grid(9, 7), 2);
  EXPECT_EQ(thinned.mesh.face_count(), 2u);
  EXPECT_EQ(thinned.outcome.stop, StopReason::kQuotaReached);
  EXPECT_EQ(thinned.outcome.max_error, 0.0f);
  EXPECT_EQ(area_of(thinned.mesh), 63.0);
}

TEST(HalfEdge, ABorderKeepsItsVerticesOnTheBorder) {
  Mesh sheet = grid(20, 20);
  for (Vec3& p : sheet.positions) p.z = 2 * std::sin(p.x * 0.4f) * std::cos(p.y * 0.5f);
  for (const std::size_t target : {400u, 100u, 20u, 2u}) {
    const Thinned thinned = thin_half_edge(sheet, target);
    ASSERT_TRUE(thinned.status.ok());
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t i = 0; i < thinned.mesh.indices.size(); i += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = thinned.mesh.indices[i + k], b = thinned.mesh.indices[i + (k + 1) % 3];
        ++edges[{std::min(a, b), std::max(a, b)}];
      }
    }
    for (const auto& [edge, faces] : edges) {
      if (faces != 1) continue;
      for (const std::uint32_t v : {edge.first, edge.second}) {
        const Vec3 p = thinned.mesh.positions[v];
        EXPECT_TRUE(p.x == 0 || p.x == 20 || p.y == 0 || p.y == 20) << "the sheet shrank";
      }
    }
  }
}

TEST(HalfEdge, ACubeOfSixTexturesThinsToItsTwelveFaces) {
  const Mesh cube = joined(study::six_sided_cube(7));
  const Thinned thinned = thin_half_edge(cube, 12);
  EXPECT_EQ(thinned.mesh.face_count(), 12u);
  EXPECT_EQ(thinned.mesh.positions.size(), 24u) << "eight corners of three sides each";
  EXPECT_EQ(area_of(thinned.mesh), 24.0);
  EXPECT_EQ(study::count_holes(cube, thinned.mesh), 0u);
  EXPECT_EQ(study::count_seam_vertices(thinned.mesh), 8u);
  for (std::size_t i = 0; i < thinned.mesh.indices.size(); i += 3) {
    const PackedNormal normal = thinned.mesh.normals[thinned.mesh.indices[i]];
    EXPECT_EQ(normal, thinned.mesh.normals[thinned.mesh.indices[i + 1]]);
    EXPECT_EQ(normal, thinned.mesh.normals[thinned.mesh.indices[i + 2]]) << "a face names another side's vertex";
  }
}

TEST(HalfEdge, ACreasedCylinderKeepsItsRimsAndItsSeam) {
  const Mesh cylinder = joined({study::creased_cylinder(32, 8, 4)});
  for (const double share : {0.5, 0.2, 0.1}) {
    const Thinned thinned = thin_half_edge(cylinder, static_cast<std::size_t>(
                                                         static_cast<double>(cylinder.face_count()) * share));
    ASSERT_EQ(thinned.outcome.stop, StopReason::kQuotaReached) << share;
    EXPECT_EQ(study::count_holes(cylinder, thinned.mesh), 0u) << share;
    EXPECT_EQ(bench::count_flipped_faces(cylinder, thinned.mesh, 0.05), 0u) << share;
    // Every face lies on the mantle or on one cap: no normal or coordinate of another side of a crease.
    for (std::size_t i = 0; i < thinned.mesh.indices.size(); i += 3) {
      int kinds[2] = {0, 0};
      for (std::size_t k = 0; k < 3; ++k)
        ++kinds[unpack(thinned.mesh.normals[thinned.mesh.indices[i + k]]).y == 0.0f ? 0 : 1];
      EXPECT_TRUE(kinds[0] == 0 || kinds[1] == 0) << "face " << i / 3 << " bends around the rim";
    }
  }
}

TEST(HalfEdge, NoSeamTearsHoweverManyThereAre) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh ball = ball_of_islands(3, 2 + seed * 3, seed);
    for (const std::size_t target : {640u, 256u, 64u, 12u}) {
      const Thinned thinned = thin_half_edge(ball, target);
      ASSERT_TRUE(thinned.status.ok());
      const MeshTopology topology = topology_of(thinned.mesh);
      EXPECT_EQ(topology.border_edges, 0u);
      EXPECT_EQ(topology.non_manifold_edges, 0u);
      EXPECT_EQ(topology.misoriented_edges, 0u);
      EXPECT_EQ(topology.euler(), 2);
      if (target > 12) { EXPECT_EQ(bench::count_flipped_faces(ball, thinned.mesh, 0.1), 0u); }
    }
  }
}

TEST(HalfEdge, StopsWhereTheSurfaceWouldClose) {
  const Thinned thinned = thin_half_edge(icosphere(2), 0);
  EXPECT_EQ(thinned.outcome.stop, StopReason::kNoCollapseAllowed);
  EXPECT_GE(thinned.mesh.face_count(), 4u);
  EXPECT_LE(thinned.mesh.face_count(), 20u);
  const MeshTopology topology = topology_of(thinned.mesh);
  EXPECT_EQ(topology.border_edges, 0u);
  EXPECT_EQ(topology.euler(), 2);
}

TEST(HalfEdge, ErrorIsThatOfTheFacesThatHaveGone) {
  // A roof one high over a flat sheet's middle rows: four planes, two faces each.
  Mesh sheet = grid(6, 6);
  for (Vec3& p : sheet.positions)
    if (p.y == 3) p.z = 1;
  EXPECT_EQ(thin_half_edge(sheet, 8).outcome.max_error, 0.0f);
  EXPECT_EQ(thin_half_edge(sheet, 8).mesh.face_count(), 8u);
  EXPECT_NEAR(area_of(thin_half_edge(sheet, 8).mesh), 6 * (4 + 2 * std::sqrt(2.0)), 1e-5);
  const Thinned fewer = thin_half_edge(sheet, 6);
  EXPECT_GT(fewer.outcome.max_error, 0.1f);
  EXPECT_LT(fewer.outcome.max_error, 1.0f) << "the roof's height";
}

TEST(HalfEdge, TheScaleDoesNotMatter) {
  const Mesh ball = ball_of_islands(3, 6, 3);
  const Thinned expected = thin_half_edge(ball, 150);
  for (const float scale : {0x1p-60f, 0x1p-13f, 0x1p7f, 0x1p60f}) {
    Mesh scaled = ball;
    for (Vec3& p : scaled.positions) p = p * scale;
    const Thinned thinned = thin_half_edge(scaled, 150);
    EXPECT_EQ(thinned.mesh.indices, expected.mesh.indices) << scale;
    EXPECT_EQ(thinned.mesh.texture_coordinates, expected.mesh.texture_coordinates) << scale;
    EXPECT_EQ(thinned.outcome.max_error, expected.outcome.max_error * scale);
  }
}

TEST(HalfEdge, NoFaceEverTakesAVertexOfAnotherMaterial) {
  // Three materials of a flat sheet meet in its middle. Where nothing else is left, that vertex would go to the border,
  // at the end of the seam of two: the third has no vertex there.
  const Mesh sheet = grid(8, 8);
  Mesh mesh;
  firmware::MaterialGroup ends[3];
  for (std::uint32_t group = 0; group < 3; ++group) {
    for (std::size_t i = 0; i < sheet.indices.size(); i += 3) {
      const Vec3 thrice_centre = sheet.positions[sheet.indices[i]] + sheet.positions[sheet.indices[i + 1]] +
                                 sheet.positions[sheet.indices[i + 2]];
      if ((thrice_centre.y > 12 ? 0u : (thrice_centre.x < 12 ? 1u : 2u)) != group) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back(sheet.positions[sheet.indices[i + k]]);
      }
    }
    ends[group] = {static_cast<std::uint32_t>(mesh.face_count()), static_cast<std::uint32_t>(mesh.positions.size())};
  }
  std::vector<std::byte> memory(firmware::half_edge_scratch_bytes(ends[2].vertex_end, ends[2].face_end));
  Arena scratch(memory);
  firmware::WorkingMesh working{.positions = mesh.positions,
                                .groups = ends,
                                .indices = mesh.indices,
                                .vertex_count = ends[2].vertex_end,
                                .face_count = ends[2].face_end};
  const auto outcome = firmware::simplify_half_edge(working, {.target_faces = 0}, scratch);
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.value().stop, StopReason::kNoCollapseAllowed);
  for (std::uint32_t i = 0; i < working.face_count * 3; ++i) {
    const auto group = [&](std::uint32_t at, auto end) { return at < ends[0].*end ? 0 : (at < ends[1].*end ? 1 : 2); };
    ASSERT_LT(mesh.indices[i], working.vertex_count);
    EXPECT_EQ(group(mesh.indices[i], &firmware::MaterialGroup::vertex_end),
              group(i / 3, &firmware::MaterialGroup::face_end));
  }
}

}  // namespace
}  // namespace usuzumi::testing
