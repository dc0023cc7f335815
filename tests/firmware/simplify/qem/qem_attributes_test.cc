// Normals and colours are carried along; their borders hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "firmware/simplify/attributes.h"
#include "tests/firmware/simplify/simplify_fixture.h"

namespace usuzumi::testing {
namespace {

constexpr Rgba8 kRed = rgba8(255, 0, 0), kBlue = rgba8(0, 0, 255);

// A flat sheet, red left of x = split and blue right of it; the vertices on the line are there in both colours.
Mesh two_coloured(std::uint32_t columns, std::uint32_t rows, std::uint32_t split) {
  const Mesh sheet = grid(columns, rows);
  Mesh mesh;
  for (std::size_t f = 0; f < sheet.indices.size(); f += 3) {
    float right = 0;
    for (std::size_t k = 0; k < 3; ++k) right = std::max(right, sheet.positions[sheet.indices[f + k]].x);
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(sheet.positions[sheet.indices[f + k]]);
      mesh.colours.push_back(right <= static_cast<float>(split) ? kRed : kBlue);
    }
  }
  return mesh;
}

TEST(QemAttributes, WedgesThatAgreeInEverythingBecomeOne) {
  const Mesh mesh = two_coloured(4, 4, 2);
  const Thinned thinned = thin(mesh, static_cast<std::uint32_t>(mesh.face_count()));
  ASSERT_TRUE(thinned.status.ok());
  EXPECT_EQ(thinned.mesh.face_count(), 32u);
  EXPECT_EQ(thinned.mesh.positions.size(), 25u + 5u) << "twice only along the border of the colours";
}

TEST(QemAttributes, BorderOfColoursStaysWhereItWas) {
  const Thinned thinned = thin(two_coloured(16, 16, 5), 4);
  ASSERT_TRUE(thinned.status.ok());
  ASSERT_EQ(thinned.mesh.face_count(), 4u);
  double red = 0, blue = 0;
  for (std::size_t f = 0; f < thinned.mesh.indices.size(); f += 3) {
    const std::uint32_t a = thinned.mesh.indices[f], b = thinned.mesh.indices[f + 1], c = thinned.mesh.indices[f + 2];
    ASSERT_EQ(thinned.mesh.colours[a], thinned.mesh.colours[b]);
    ASSERT_EQ(thinned.mesh.colours[b], thinned.mesh.colours[c]);
    const double area = cross(thinned.mesh.positions[b] - thinned.mesh.positions[a],
                              thinned.mesh.positions[c] - thinned.mesh.positions[a])
                            .z /
                        2;
    (thinned.mesh.colours[a] == kRed ? red : blue) += area;
  }
  EXPECT_NEAR(red, 5 * 16, 0.1);
  EXPECT_NEAR(blue, 11 * 16, 0.1);
}

TEST(QemAttributes, CubeWithFlatNormalsKeepsItsSixNormals) {
  const Thinned thinned = thin(with_flat_normals(cube(6)), 12);
  ASSERT_TRUE(thinned.status.ok());
  ASSERT_EQ(thinned.mesh.face_count(), 12u);
  EXPECT_EQ(thinned.mesh.positions.size(), 24u) << "eight corners, three normals each";
  std::set<std::uint32_t> normals;
  for (const PackedNormal n : thinned.mesh.normals) normals.insert(n.bits);
  EXPECT_EQ(normals.size(), 6u);
  for (std::size_t f = 0; f < thinned.mesh.indices.size(); f += 3) {
    const std::uint32_t a = thinned.mesh.indices[f], b = thinned.mesh.indices[f + 1], c = thinned.mesh.indices[f + 2];
    const Vec3 normal = normalized(cross(thinned.mesh.positions[b] - thinned.mesh.positions[a],
                                         thinned.mesh.positions[c] - thinned.mesh.positions[a]));
    for (const std::uint32_t v : {a, b, c}) EXPECT_GT(dot(normal, unpack(thinned.mesh.normals[v])), 0.999f);
  }
}

TEST(QemAttributes, SmoothColoursAreInterpolatedWhereVerticesMerge) {
  // Red grows with x: after thinning, red at a vertex must still tell its x.
  Mesh mesh = grid(16, 16);
  for (const Vec3 p : mesh.positions) mesh.colours.push_back(rgba8(static_cast<std::uint32_t>(p.x) * 15, 7, 0, 200));
  const Thinned thinned = thin(mesh, 60);
  ASSERT_TRUE(thinned.status.ok());
  EXPECT_LE(thinned.mesh.face_count(), 60u);
  for (std::size_t v = 0; v < thinned.mesh.positions.size(); ++v) {
    EXPECT_NEAR(static_cast<float>(thinned.mesh.colours[v].r()), thinned.mesh.positions[v].x * 15, 24) << v;
    EXPECT_EQ(thinned.mesh.colours[v].g(), 7u);
    EXPECT_EQ(thinned.mesh.colours[v].b(), 0u);
    EXPECT_EQ(thinned.mesh.colours[v].a(), 200u);
  }
}

TEST(QemAttributes, SmoothNormalsOfASphereStillPointOutwards) {
  Mesh mesh = icosphere(4);
  for (const Vec3 p : mesh.positions) mesh.normals.push_back(pack_normal(p));
  const Thinned thinned = thin(mesh, 200);
  ASSERT_TRUE(thinned.status.ok());
  for (std::size_t v = 0; v < thinned.mesh.positions.size(); ++v)
    EXPECT_GT(dot(unpack(thinned.mesh.normals[v]), normalized(thinned.mesh.positions[v])), 0.98f) << v;
}

TEST(QemAttributes, NormalsAreSharedOutByPlaceAndArea) {
  using firmware::shares_at;
  EXPECT_FLOAT_EQ(shares_at(0.5f, 3, 1).colour, 0.5f);
  EXPECT_FLOAT_EQ(shares_at(0.5f, 3, 1).normal, 0.25f);
  EXPECT_FLOAT_EQ(shares_at(0.75f, 3, 1).normal, 0.5f);  // 0.75 * 1 against 0.25 * 3
  EXPECT_FLOAT_EQ(shares_at(0, 3, 1).normal, 0);
  EXPECT_FLOAT_EQ(shares_at(1, 3, 1).normal, 1);
  EXPECT_FLOAT_EQ(shares_at(0.25f, 0, 0).normal, 0.25f) << "without areas by place alone";
  EXPECT_FLOAT_EQ(shares_at(0.5f, 3, 1).reversed().normal, 0.75f);
}

// Two flat walls and a small fillet between, shaded smooth. Thinned to a few faces, the walls must still look flat: a
// wall is a hundred times as wide as a step of the fillet, whose tilted normals would be drawn all over it.
TEST(QemAttributes, FlatWallsBesideAThinnedFilletStayEvenlyLit) {
  constexpr float kQuarter = 1.5707963f;
  constexpr int kSteps = 8, kRows = 9;
  Mesh mesh;
  for (int row = 0; row < kRows; ++row) {
    const auto add = [&](float x, float z, float angle) {
      mesh.positions.push_back({x, 2.5f * static_cast<float>(row), z});
      mesh.normals.push_back(pack_normal({std::cos(angle), 0, std::sin(angle)}));
    };
    add(-20, 1, kQuarter);
    for (int i = 0; i <= kSteps; ++i) {
      const float angle = kQuarter * (1 - static_cast<float>(i) / kSteps);
      add(std::cos(angle), std::sin(angle), angle);
    }
    add(1, -20, 0);
  }
  constexpr std::uint32_t kColumns = kSteps + 3;
  for (std::uint32_t row = 0; row + 1 < kRows; ++row)
    for (std::uint32_t i = 0; i + 1 < kColumns; ++i) {
      const std::uint32_t a = row * kColumns + i, b = a + 1, c = a + kColumns, d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
    }
  const Mesh thinned = thin(mesh, 16).mesh;
  ASSERT_LE(thinned.face_count(), 16u);
  for (std::size_t f = 0; f < thinned.indices.size(); f += 3) {
    const Vec3 a = thinned.positions[thinned.indices[f]], b = thinned.positions[thinned.indices[f + 1]],
               c = thinned.positions[thinned.indices[f + 2]];
    const Vec3 normal = cross(b - a, c - a);
    if (length(normal) < 100) continue;  // no wall
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_GT(dot(unpack(thinned.normals[thinned.indices[f + k]]), normalized(normal)), 0.995f) << f / 3 << ' ' << k;
  }
}

TEST(QemAttributes, SeamsChangeNothingAboutTheShapeOfTheResult) {
  const Thinned thinned = thin(with_flat_normals(icosphere(3)), 300);
  ASSERT_TRUE(thinned.status.ok());
  const MeshTopology t = topology_of(thinned.mesh);
  EXPECT_EQ(t.euler(), 2);
  EXPECT_EQ(t.border_edges, 0u) << "no crack along any seam";
  EXPECT_EQ(t.non_manifold_edges, 0u);
  EXPECT_LE(t.faces, 300u);
}

}  // namespace
}  // namespace usuzumi::testing
