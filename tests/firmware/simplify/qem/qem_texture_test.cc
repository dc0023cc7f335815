// Thinning by quadric error leaves textures where they were: held against the texture of the mesh as given, place by
// place.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <span>
#include <string>

#include "firmware/simplify/qem/qem.h"
#include "hal/crc32.h"
#include "tests/bench/simplify/error_meter.h"
#include "tests/bench/simplify/texture_meter.h"
#include "tests/firmware/simplify/simplify_fixture.h"
#include "tests/study/seam_checks.h"
#include "tests/study/seam_shapes.h"

namespace usuzumi::testing {
namespace {

using firmware::Placement;

// A unit sphere of 2 columns (rows - 1) faces; s is the longitude, with a seam where y = 0 and x > 0, t the latitude.
Mesh globe(std::uint32_t columns, std::uint32_t rows) {
  Mesh mesh;
  for (std::uint32_t j = 0; j <= rows; ++j) {
    const bool is_pole = j == 0 || j == rows;
    const double polar = std::numbers::pi * j / rows;
    for (std::uint32_t i = 0; i <= columns; ++i) {
      const double longitude = 2 * std::numbers::pi * (i % columns) / columns;
      const double r = is_pole ? 0 : std::sin(polar);
      mesh.positions.push_back({static_cast<float>(r * std::cos(longitude)),
                                static_cast<float>(r * std::sin(longitude)), static_cast<float>(std::cos(polar))});
      mesh.texture_coordinates.push_back({static_cast<float>((i + (is_pole ? 0.5 : 0)) / columns),
                                          static_cast<float>(j) / static_cast<float>(rows)});
    }
  }
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
      if (j > 0) mesh.indices.insert(mesh.indices.end(), {a, c, b});
      if (j + 1 < rows) mesh.indices.insert(mesh.indices.end(), {b, c, d});
    }
  }
  return mesh;
}

// Six islands side by side in one texture. Of the cube [-1, 1]^3.
Mesh cube_of_six_islands(std::uint32_t n) {
  Mesh mesh;
  float island = 0;
  for (const study::TexturedPart& part : study::six_sided_cube(n)) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
    for (const TexCoord c : part.coordinates) mesh.texture_coordinates.push_back({c.s + 2 * island, c.t});
    for (const std::uint32_t i : part.indices) mesh.indices.push_back(first + i);
    ++island;
  }
  return mesh;
}

Mesh creased_cylinder() {
  const study::TexturedPart part = study::creased_cylinder(32, 12, 4);
  Mesh mesh;
  mesh.positions = part.positions;
  mesh.texture_coordinates = part.coordinates;
  mesh.indices = part.indices;
  for (const Vec3 n : part.normals) mesh.normals.push_back(pack_normal(n));
  return mesh;
}

// A flat sheet whose texture is cut open along y = 8 from x = 0 to x = 8: there s jumps by an amount that falls to
// nothing at the cut's end.
Mesh slit_sheet() {
  const Mesh sheet = grid(16, 16);
  Mesh mesh;
  std::map<std::tuple<float, float, bool>, std::uint32_t> known;
  for (std::size_t f = 0; f < sheet.indices.size(); f += 3) {
    float top = 0;
    for (std::size_t k = 0; k < 3; ++k) top = std::max(top, sheet.positions[sheet.indices[f + k]].y);
    const bool is_above = top > 8;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = sheet.positions[sheet.indices[f + k]];
      const auto [at, is_new] = known.try_emplace({p.x, p.y, is_above}, static_cast<std::uint32_t>(known.size()));
      mesh.indices.push_back(at->second);
      if (!is_new) continue;
      mesh.positions.push_back(p);
      const float opened = is_above && p.x < 8 ? (8 - p.x) / 8 * (16 - p.y) / 8 : 0;
      mesh.texture_coordinates.push_back({p.x / 16 + opened, p.y / 16});
    }
  }
  return mesh;
}

// Positions at which faces disagree about the texture coordinate.
std::vector<Vec3> seam_positions(const Mesh& mesh) {
  std::map<std::tuple<float, float, float>, std::set<std::pair<float, float>>> seen;
  for (const std::uint32_t v : mesh.indices) {
    const Vec3 p = mesh.positions[v];
    seen[{p.x, p.y, p.z}].insert({mesh.texture_coordinates[v].s, mesh.texture_coordinates[v].t});
  }
  std::vector<Vec3> result;
  for (const auto& [p, coordinates] : seen)
    if (coordinates.size() > 1) result.push_back({std::get<0>(p), std::get<1>(p), std::get<2>(p)});
  return result;
}

TEST(QemTexture, LinearTextureOverAPlaneStaysExactAtEveryVertex) {
  Mesh mesh = grid(16, 16);
  std::uint32_t state = 1;
  for (Vec3& p : mesh.positions) {  // inner vertices anywhere: no two edges alike
    if (p.x < 1 || p.x > 15 || p.y < 1 || p.y > 15) continue;
    state = state * 1664525u + 1013904223u;
    p.x += static_cast<float>(state >> 24) / 640;
    state = state * 1664525u + 1013904223u;
    p.y += static_cast<float>(state >> 24) / 640;
  }
  const auto texture_at = [](Vec3 p) {
    return TexCoord{0.3f + 0.05f * p.x - 0.02f * p.y, 0.1f + 0.02f * p.x + 0.05f * p.y};
  };
  for (const Vec3 p : mesh.positions) mesh.texture_coordinates.push_back(texture_at(p));
  for (const Placement placement : {Placement::kOptimal, Placement::kMidpoint}) {
    for (const std::uint32_t target : {256u, 100u, 20u}) {
      const Thinned thinned = thin(mesh, target, placement);
      ASSERT_TRUE(thinned.status.ok());
      EXPECT_LE(thinned.mesh.face_count(), target);
      for (std::size_t v = 0; v < thinned.mesh.positions.size(); ++v) {
        const TexCoord expected = texture_at(thinned.mesh.positions[v]);
        EXPECT_NEAR(thinned.mesh.texture_coordinates[v].s, expected.s, 4e-6f) << target << ' ' << v;
        EXPECT_NEAR(thinned.mesh.texture_coordinates[v].t, expected.t, 4e-6f) << target << ' ' << v;
      }
    }
  }
}

// Drift in texture units: of the sphere's map one is the whole way round.
TEST(QemTexture, MapOfASphereStaysWhereItWasAndItsSeamStaysClosed) {
  const Mesh mesh = globe(48, 24);
  const struct {
    std::uint32_t percent;
    double rms, largest;
  } bounds[] = {{50, 0.0009, 0.008}, {20, 0.002, 0.015}, {5, 0.006, 0.04}};
  for (const auto& bound : bounds) {
    SCOPED_TRACE(std::to_string(bound.percent) + " %");
    const auto target = static_cast<std::uint32_t>(mesh.face_count()) * bound.percent / 100;
    const Mesh thinned = thin(mesh, target).mesh;
    EXPECT_LE(thinned.face_count(), target);
    const MeshTopology t = topology_of(thinned);
    EXPECT_EQ(t.euler(), 2);
    EXPECT_EQ(t.border_edges, 0u);
    EXPECT_EQ(bench::count_flipped_faces(mesh, thinned, 0.02), 0u);
    const bench::TextureDrift drift = bench::measure_texture_drift(mesh, thinned, 0.035, 1, 20000);
    EXPECT_LE(drift.rms, bound.rms);
    EXPECT_LE(drift.largest, bound.largest);
    // Round the poles each column has a place of its own.
    for (const Vec3 p : seam_positions(thinned)) {
      const bool on_seam = p.x > 0 && std::abs(p.y) < 0.02f;
      EXPECT_TRUE(on_seam || std::abs(p.z) > 0.8f) << p.x << ' ' << p.y << ' ' << p.z;
    }
  }
}

TEST(QemTexture, CubeOfSixIslandsKeepsThemToTheCorner) {
  const Mesh mesh = cube_of_six_islands(8);
  for (const std::uint32_t target : {384u, 152u, 38u, 12u}) {
    const Mesh thinned = thin(mesh, target).mesh;
    ASSERT_LE(thinned.face_count(), target);
    EXPECT_EQ(topology_of(thinned).border_edges, 0u);
    const bench::TextureDrift drift = bench::measure_texture_drift(mesh, thinned, 1e-5, 1, 5000);
    EXPECT_LE(drift.largest, 2e-4) << target;
  }
  const Mesh thinned = thin(mesh, 12).mesh;
  ASSERT_EQ(thinned.positions.size(), 24u) << "eight corners of three islands each";
  for (const TexCoord c : thinned.texture_coordinates) {
    EXPECT_NEAR(c.s, std::round(c.s), 1e-5);
    EXPECT_NEAR(c.t, std::round(c.t), 1e-5);
  }
}

TEST(QemTexture, CylinderWithCreasedCapsKeepsItsThreeIslands) {
  const Mesh mesh = creased_cylinder();
  const auto faces = static_cast<std::uint32_t>(mesh.face_count());
  for (const std::uint32_t percent : {50u, 20u, 5u}) {
    SCOPED_TRACE(percent);
    const Mesh thinned = thin(mesh, faces * percent / 100).mesh;
    EXPECT_EQ(topology_of(thinned).border_edges, 0u);
    EXPECT_EQ(bench::count_flipped_faces(mesh, thinned, 0.05), 0u);
    const bench::TextureDrift drift = bench::measure_texture_drift(mesh, thinned, 0.04, 1, 20000);
    EXPECT_LE(drift.largest, 0.01);
    for (const Vec3 p : seam_positions(thinned)) {
      const bool on_crease = std::abs(std::abs(p.y) - 1) < 0.02f && std::hypot(p.x, p.z) > 0.9f;
      const bool on_winding = std::hypot(p.x, p.z) > 0.9f && (std::abs(p.x) < 0.05f || std::abs(p.z) < 0.05f);
      EXPECT_TRUE(on_crease || on_winding) << p.x << ' ' << p.y << ' ' << p.z;
    }
  }
}

// Where a cut ends both its sides are one place. The end may go back along the cut, but nothing opens beside it.
TEST(QemTexture, CutThatEndsInsideASheetOpensNowhereElse) {
  const Mesh mesh = slit_sheet();
  ASSERT_EQ(study::count_seam_vertices(mesh), 8u);
  for (const std::uint32_t target : {256u, 100u, 40u, 16u}) {
    const Mesh thinned = thin(mesh, target).mesh;
    ASSERT_LE(thinned.face_count(), target);
    for (const Vec3 p : seam_positions(thinned)) {
      EXPECT_NEAR(p.y, 8, 0.02) << target;
      EXPECT_LT(p.x, 8.02) << target;
    }
    const bench::TextureDrift drift = bench::measure_texture_drift(mesh, thinned, 0.05, 1, 5000);
    EXPECT_LE(drift.largest, 0.1) << target;
  }
}

TEST(QemTexture, NeitherTheModelsScaleNorTheTexturesMatters) {
  const Mesh mesh = globe(32, 16);
  const Mesh expected = thin(mesh, 200).mesh;
  // By powers of two, so that nothing rounds otherwise.
  for (const float size : {0x1p-20f, 1.0f, 0x1p10f}) {
    for (const float density : {0x1p-12f, 8.0f}) {
      Mesh scaled = mesh;
      for (Vec3& p : scaled.positions) p = p * size;
      for (TexCoord& c : scaled.texture_coordinates) c = {c.s * density, c.t * density};
      const Mesh thinned = thin(scaled, 200).mesh;
      ASSERT_EQ(thinned.indices, expected.indices);
      for (std::size_t v = 0; v < thinned.positions.size(); ++v) {
        EXPECT_EQ(thinned.positions[v], expected.positions[v] * size);
        EXPECT_EQ(thinned.texture_coordinates[v].s, expected.texture_coordinates[v].s * density);
        EXPECT_EQ(thinned.texture_coordinates[v].t, expected.texture_coordinates[v].t * density);
      }
    }
  }
}

TEST(QemTexture, CoordinatesOutOfAnyRangeDoNoHarmToTheShape) {
  const Mesh plain = globe(24, 12);
  const float values[] = {0, 1e-38f, 1e-20f, 1e10f, 1e19f, 3e38f, -3e38f};
  std::uint32_t state = 7;
  for (int round = 0; round < 12; ++round) {
    Mesh mesh = plain;
    for (TexCoord& c : mesh.texture_coordinates) {
      if (round == 0) c = {0.5f, 0.5f};  // no texture to speak of
      state = state * 1664525u + 1013904223u;
      if (round > 0 && (state >> 24) % (round < 6 ? 1 : 16) == 0)
        c = {values[(state >> 8) % 7], values[(state >> 16) % 7]};
    }
    const Thinned thinned = thin(mesh, 100);
    ASSERT_TRUE(thinned.status.ok());
    EXPECT_LE(thinned.mesh.face_count(), 200u) << round;
    EXPECT_EQ(topology_of(thinned.mesh).euler(), 2);
    for (const Vec3 p : thinned.mesh.positions) EXPECT_TRUE(length(p) < 1.3f && length(p) > 0.5f) << round;
    for (const TexCoord c : thinned.mesh.texture_coordinates) EXPECT_TRUE(std::isfinite(c.s) && std::isfinite(c.t));
  }
}

TEST(QemTexture, ScratchIsWhatWasSaidAndLessIsRefused) {
  const Mesh mesh = globe(24, 12);
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const auto faces = static_cast<std::uint32_t>(mesh.face_count());
  const auto need = static_cast<std::size_t>(firmware::qem_scratch_bytes(vertices, faces, true));
  EXPECT_GT(need, firmware::qem_scratch_bytes(vertices, faces, false));
  EXPECT_LE(need, firmware::qem_scratch_bytes(vertices, faces, false) + 32u * vertices + 32);
  const Thinned thinned = thin(mesh, 100, Placement::kOptimal, need);
  EXPECT_TRUE(thinned.status.ok());
  EXPECT_GE(thinned.scratch_used + 32, need) << "the bound is tight";
  for (const std::size_t bytes : {need / 2, need - 100, need - 17}) {
    const Thinned refused = thin(mesh, 100, Placement::kOptimal, bytes);
    ASSERT_EQ(refused.status.code, StatusCode::kResourceExhausted) << bytes;
    EXPECT_EQ(refused.mesh.positions, mesh.positions);
    EXPECT_TRUE(refused.mesh.texture_coordinates == mesh.texture_coordinates);
    EXPECT_EQ(refused.mesh.indices, mesh.indices);
  }
}

// As QemRobustness.BytesAreTheSameEverywhere, with a texture.
TEST(QemTexture, BytesAreTheSameEverywhere) {
  Mesh mesh = globe(48, 24);
  for (Vec3& p : mesh.positions) p = {p.x * 1.5f + 0.1f * p.y * p.y, p.y + 0.2f * p.x * p.z, p.z * 0.7f};
  // The sine's last bits are the library's: what is thinned is rounded to 2^-10.
  for (Vec3& p : mesh.positions)
    p = {std::round(p.x * 1024) / 1024, std::round(p.y * 1024) / 1024, std::round(p.z * 1024) / 1024};
  const Thinned thinned = thin(mesh, 400);
  std::uint32_t crc = kCrc32Start;
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.positions)));
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.texture_coordinates)));
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.indices)));
  EXPECT_EQ(crc, 2266607995u);
}

}  // namespace
}  // namespace usuzumi::testing
