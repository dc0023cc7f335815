// Which edge goes, where its vertex is put, what the author can say: against brute force over the list of faces.
#include "firmware/simplify/edge_removal/edge_removal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <span>

#include "firmware/simplify/edge_removal/placement.h"
#include "hal/crc32.h"
#include "tests/firmware/simplify/replay.h"

namespace usuzumi::testing {
namespace {

using namespace firmware;

using Point = std::array<double, 3>;
Point point(Vec3 p) { return {p.x, p.y, p.z}; }
Point minus(Point a, Point b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot_of(Point a, Point b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross_of(Point a, Point b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length_of(Point a) { return std::sqrt(dot_of(a, a)); }

// A closed surface of irregular shape that bends gently: convex, concave and S-shaped places.
Mesh bumpy(unsigned seed) {
  std::mt19937 random(seed);
  Mesh mesh = icosphere(2);
  for (Vec3& p : mesh.positions) p = p * (1 + 0.25f * static_cast<float>(random() % 1000) * 1e-3f);
  return mesh;
}

// Eq. (1) as printed, all planes in both terms where they belong.
double equation_one(const Mesh& mesh, std::uint32_t v1, std::uint32_t v2, double a, double b) {
  const Point e = minus(point(mesh.positions[v2]), point(mesh.positions[v1]));
  double sum = 0;
  for (std::size_t f = 0; f < mesh.indices.size(); f += 3) {
    const std::uint32_t* i = &mesh.indices[f];
    const bool at1 = std::find(i, i + 3, v1) != i + 3, at2 = std::find(i, i + 3, v2) != i + 3;
    if (!at1 && !at2) continue;
    const Point p = point(mesh.positions[i[0]]);
    const Point normal = cross_of(minus(point(mesh.positions[i[1]]), p), minus(point(mesh.positions[i[2]]), p));
    const double area = length_of(normal) / 2;
    const double v = dot_of(normal, e) / length_of(normal) * area;
    const double s = at1 && at2 ? length_of(e) * area : 0;
    sum += std::fabs(a * v + b * s);
  }
  return sum;
}

double volume_of(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.indices.size(); f += 3)
    sum += dot_of(point(mesh.positions[mesh.indices[f]]),
                  cross_of(point(mesh.positions[mesh.indices[f + 1]]), point(mesh.positions[mesh.indices[f + 2]])));
  return sum / 6;
}
double volume_with(Mesh mesh, std::uint32_t v, Vec3 at) {
  mesh.positions[v] = at;
  return volume_of(mesh);
}

std::set<std::pair<std::uint32_t, std::uint32_t>> edges_of(const Mesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t f = 0; f < mesh.indices.size(); f += 3)
    for (std::size_t k = 0; k < 3; ++k)
      edges.insert(std::minmax(mesh.indices[f + k], mesh.indices[f + (k + 1) % 3]));
  return edges;
}

// What the first removal did, from the log.
struct FirstRemoval {
  std::uint32_t v1 = 0, v2 = 0;
  Vec3 place;
};
FirstRemoval first_removal(const Mesh& mesh, const EdgeRemovalSettings& settings) {
  RoomyLog room(mesh);
  const SimplifyOptions options{.target_faces = static_cast<std::uint32_t>(mesh.face_count()) - 1,
                                .method = Method::kEdgeRemoval,
                                .edge_removal = settings,
                                .log = &room.log};
  EXPECT_TRUE(thin(mesh, options).status.ok());
  EXPECT_EQ(room.log.steps().size(), 1u);
  EXPECT_EQ(room.log.successions().size(), 2u);
  if (room.log.successions().size() != 2) return {};
  const auto [v1, v2] = std::minmax(room.log.successions()[0].from, room.log.successions()[1].from);
  return {v1, v2, room.log.added()[0].position};
}

// As thin(), with authors' values.
Mesh thinned_with_values(const Mesh& given, const std::vector<float>& values, const SimplifyOptions& options) {
  Mesh mesh = given;
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size()),
             faces = static_cast<std::uint32_t>(mesh.face_count());
  std::vector<std::byte> memory(edge_removal_scratch_bytes(vertices, faces));
  Arena scratch(memory);
  WorkingMesh working{.positions = mesh.positions,
                      .normals = mesh.normals,
                      .edge_values = values,
                      .indices = mesh.indices,
                      .vertex_count = vertices,
                      .face_count = faces};
  EXPECT_TRUE(simplify(working, options, scratch).ok());
  mesh.positions.resize(working.vertex_count);
  if (!mesh.normals.empty()) mesh.normals.resize(working.vertex_count);
  mesh.indices.resize(std::size_t{working.face_count} * 3);
  return mesh;
}

TEST(EdgeRemoval, TheEdgeOfLeastValueGoesFirst) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = bumpy(seed);
    for (const auto& [a, b] : {std::pair{1.0f, 0.1f}, {1.0f, 0.0f}, {0.0f, 1.0f}, {0.5f, 2.0f}}) {
      EdgeRemovalSettings settings;
      settings.a = a;
      settings.b = b;
      settings.placement = EdgePlacement::kMidpoint;
      const FirstRemoval first = first_removal(mesh, settings);
      double least = std::numeric_limits<double>::infinity();
      for (const auto& [v1, v2] : edges_of(mesh)) least = std::min(least, equation_one(mesh, v1, v2, a, b));
      EXPECT_LE(equation_one(mesh, first.v1, first.v2, a, b), least * (1 + 1e-5));
    }
  }
}

TEST(EdgeRemoval, NeighboursValuesCountWhereTheSettingsSaySo) {
  int differ = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = bumpy(seed);
    EdgeRemovalSettings settings;
    settings.placement = EdgePlacement::kMidpoint;
    const FirstRemoval alone = first_removal(mesh, settings);
    settings.neighbour_weight = 3;
    const FirstRemoval first = first_removal(mesh, settings);
    const auto edges = edges_of(mesh);
    const auto with_neighbours = [&](std::uint32_t v1, std::uint32_t v2) {
      double sum = 0;
      int count = 0;
      for (const auto& [u1, u2] : edges) {
        if (u1 == v1 && u2 == v2) continue;
        if (u1 != v1 && u1 != v2 && u2 != v1 && u2 != v2) continue;
        sum += equation_one(mesh, u1, u2, 1, 0.1f);
        ++count;
      }
      return equation_one(mesh, v1, v2, 1, 0.1f) + 3 * sum / count;
    };
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [v1, v2] : edges) least = std::min(least, with_neighbours(v1, v2));
    EXPECT_LE(with_neighbours(first.v1, first.v2), least * (1 + 1e-5));
    differ += first.v1 != alone.v1 || first.v2 != alone.v2 ? 1 : 0;
  }
  EXPECT_GT(differ, 5);
}

TEST(EdgeRemoval, OfEqualValuesTheShorterGoesFirst) {
  // On a flat sheet no volume changes: with b = 0 every edge inside costs nothing. One vertex lies nearer to another
  // than any two others.
  Mesh mesh = grid(6, 6);
  mesh.positions[3 * 7 + 3] = {3.5f, 3.25f, 0};  // of the vertices (4, 3) and (4, 4) the first is nearer
  EdgeRemovalSettings settings;
  settings.b = 0;
  const FirstRemoval first = first_removal(mesh, settings);
  EXPECT_EQ(first.v1, 3u * 7 + 3);
  EXPECT_EQ(first.v2, 3u * 7 + 4);
}

TEST(EdgeRemoval, OfEqualValuesAndLengthsTheFirstEdgeGoesAndAlwaysTheSame) {
  Mesh mesh = grid(6, 6);
  EdgeRemovalSettings settings;
  settings.b = 0;
  const FirstRemoval first = first_removal(mesh, settings), again = first_removal(mesh, settings);
  EXPECT_EQ(first.v1, again.v1);
  EXPECT_EQ(first.v2, again.v2);
  EXPECT_LE(first.v2, 14u) << "of the first two rows of cells";
}

// Volume changes as fig. 5 draws them: each end alone is moved to where the vertex went.
TEST(EdgeRemoval, PlacementsChangeTheVolumeAsTheyPromise) {
  int shapes_s = 0, shapes_convex = 0, beyond = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = bumpy(seed);
    const double volume = volume_of(mesh);
    for (const EdgePlacement placement : {EdgePlacement::kAutomatic, EdgePlacement::kEqualVolume,
                                          EdgePlacement::kLeastVolume, EdgePlacement::kKeepAnEnd}) {
      EdgeRemovalSettings settings;
      settings.placement = placement;
      const FirstRemoval r = first_removal(mesh, settings);
      const Vec3 p1 = mesh.positions[r.v1], p2 = mesh.positions[r.v2];
      const Point e = minus(point(p2), point(p1)), offset = minus(point(r.place), point(p1));
      EXPECT_LT(length_of(cross_of(e, offset)), 1e-6) << "on the edge's line";
      const double t = dot_of(e, offset) / dot_of(e, e);
      const double s1 = volume_with(mesh, r.v1, r.place) - volume, s2 = volume_with(mesh, r.v2, r.place) - volume;
      const double all1 = volume_with(mesh, r.v1, p2) - volume, all2 = volume_with(mesh, r.v2, p1) - volume;
      const bool is_s = all1 * all2 < 0;
      const bool equal = placement == EdgePlacement::kEqualVolume ||
                         (placement == EdgePlacement::kAutomatic && is_s);
      if (placement == EdgePlacement::kAutomatic) ++(is_s ? shapes_s : shapes_convex);
      if (equal) {
        EXPECT_NEAR(std::fabs(s1), std::fabs(s2), 1e-6);
        EXPECT_GE(t, -1e-6);
        EXPECT_LE(t, 1 + 1e-6);
        if (is_s) {
          EXPECT_NEAR(s1 + s2, 0, 1e-6) << "what one end loses the other gains";
        }
        continue;
      }
      EXPECT_GE(t, -kMostBeyond - 1e-4);
      EXPECT_LE(t, 1 + kMostBeyond + 1e-4);
      if (t < -1e-4 || t > 1 + 1e-4) {
        ++beyond;
        EXPECT_NE(placement, EdgePlacement::kKeepAnEnd);
        EXPECT_NEAR(s1 + s2, 0, 1e-6) << "beyond the end that stays, nothing is lost in sum";
      } else {
        EXPECT_TRUE(std::fabs(t) < 1e-4 || std::fabs(t - 1) < 1e-4) << t;
      }
    }
  }
  EXPECT_GT(shapes_s, 5);
  EXPECT_GT(shapes_convex, 5);
  EXPECT_GT(beyond, 3);
}

TEST(EdgeRemoval, ScalesByPowersOfTwoChangeNothing) {
  const Mesh mesh = bumpy(3);
  const SimplifyOptions options{.target_faces = 100, .method = Method::kEdgeRemoval};
  const Thinned expected = thin(mesh, options);
  for (const float scale : {0x1p-40f, 0x1p-60f, 0x1p50f, 0x1p100f}) {
    Mesh scaled = mesh;
    for (Vec3& p : scaled.positions) p = p * scale;
    const Thinned thinned = thin(scaled, options);
    EXPECT_EQ(thinned.mesh.indices, expected.mesh.indices) << scale;
    ASSERT_EQ(thinned.mesh.positions.size(), expected.mesh.positions.size());
    for (std::size_t v = 0; v < thinned.mesh.positions.size(); ++v)
      EXPECT_EQ(thinned.mesh.positions[v], expected.mesh.positions[v] * scale);
    EXPECT_EQ(thinned.outcome.max_error, expected.outcome.max_error * scale);
  }
}

TEST(EdgeRemoval, LockedVerticesAndTheFacesAmongThemStay) {
  const Mesh mesh = with_flat_normals(icosphere(3));  // a lock on one wedge counts for its vertex
  std::vector<float> values(mesh.positions.size(), 0.0f);
  std::set<std::array<float, 3>> locked_places;
  for (std::size_t v = 0; v < values.size(); ++v) {
    const Vec3 p = mesh.positions[v];
    if (p.z > 0.5f && locked_places.insert({p.x, p.y, p.z}).second) values[v] = kLockedEdgeValue;
  }
  const auto is_locked = [&](const Mesh& m, std::uint32_t v) {
    const Vec3 p = m.positions[v];
    return locked_places.count({p.x, p.y, p.z}) > 0;
  };
  const auto locked_faces = [&](const Mesh& m) {
    int count = 0;
    for (std::size_t f = 0; f < m.indices.size(); f += 3)
      count += is_locked(m, m.indices[f]) && is_locked(m, m.indices[f + 1]) && is_locked(m, m.indices[f + 2]) ? 1 : 0;
    return count;
  };
  const Mesh thinned = thinned_with_values(mesh, values, {.target_faces = 10, .method = Method::kEdgeRemoval});
  EXPECT_LT(thinned.face_count(), mesh.face_count() / 2);
  std::set<std::array<float, 3>> left;
  for (std::uint32_t v = 0; v < thinned.positions.size(); ++v)
    if (is_locked(thinned, v)) left.insert({thinned.positions[v].x, thinned.positions[v].y, thinned.positions[v].z});
  EXPECT_EQ(left, locked_places);
  EXPECT_GT(locked_faces(mesh), 100);
  EXPECT_EQ(locked_faces(thinned), locked_faces(mesh));
}

TEST(EdgeRemoval, WhereTheAuthorGivesValueMoreIsLeft) {
  const Mesh mesh = icosphere(4);
  std::vector<float> values(mesh.positions.size(), 0.0f);
  const auto upper = [](const Mesh& m) {
    return std::count_if(m.positions.begin(), m.positions.end(), [](Vec3 p) { return p.z > 0; });
  };
  const SimplifyOptions options{.target_faces = 1280, .method = Method::kEdgeRemoval};
  const auto without = upper(thinned_with_values(mesh, values, options));
  for (std::size_t v = 0; v < values.size(); ++v) values[v] = mesh.positions[v].z > 0 ? 100.0f : 0.0f;
  const auto with = upper(thinned_with_values(mesh, values, options));
  EXPECT_NEAR(static_cast<double>(without), 321, 40);
  EXPECT_GT(with, without * 3 / 2);
  SimplifyOptions ignored = options;
  ignored.edge_removal.user_weight = 0;
  EXPECT_EQ(upper(thinned_with_values(mesh, values, ignored)), without);
}

TEST(EdgeRemoval, ByTheAuthorsWordAloneTheLeastValuedGoFirst) {
  const Mesh mesh = icosphere(3);
  std::vector<float> values(mesh.positions.size(), 1.0f);
  for (std::size_t v = 0; v < values.size(); ++v)
    if (mesh.positions[v].x < 0) values[v] = 0;
  SimplifyOptions options{.target_faces = 1000, .method = Method::kEdgeRemoval};
  options.edge_removal.computed_weight = 0;
  const Mesh thinned = thinned_with_values(mesh, values, options);
  const auto kept = [](const Mesh& m) {
    return std::count_if(m.positions.begin(), m.positions.end(), [](Vec3 p) { return p.x >= 0; });
  };
  EXPECT_EQ(thinned.face_count(), 1000u);
  EXPECT_EQ(kept(thinned), kept(mesh));
}

// With the same value everywhere and nothing else to go by, the shortest edges go and the surface stays even. Vertices
// that lost their value on the way would draw the removals to themselves.
TEST(EdgeRemoval, TheVertexThatStaysKeepsTheLargerValue) {
  const Mesh mesh = icosphere(3);
  SimplifyOptions options{.target_faces = 640, .method = Method::kEdgeRemoval};
  options.edge_removal.computed_weight = 0;
  const Mesh thinned = thinned_with_values(mesh, std::vector<float>(mesh.positions.size(), 1.0f), options);
  double longest = 0;
  for (const auto& [a, b] : edges_of(thinned))
    longest = std::max(longest, length_of(minus(point(thinned.positions[a]), point(thinned.positions[b]))));
  EXPECT_LT(longest, 3 * 0.16) << "0.16 is the mean edge of the mesh as given";
}

TEST(EdgeRemoval, FlatNormalsOfACubeAreNoBoundaries) {
  const Thinned thinned = thin(with_flat_normals(cube(6)), {.target_faces = 12, .method = Method::kEdgeRemoval});
  EXPECT_EQ(thinned.mesh.face_count(), 12u);
  std::set<std::array<float, 3>> corners;
  for (const Vec3 p : thinned.mesh.positions) corners.insert({p.x, p.y, p.z});
  EXPECT_EQ(corners.size(), 8u);
  for (const auto& corner : corners)
    for (const float x : corner) EXPECT_TRUE(x == 0 || x == 6) << x;
}

// One literal for every compiler, processor and optimisation level. It changes only when the method does; then the new
// value is what the failure prints.
TEST(EdgeRemoval, BytesAreTheSameEverywhere) {
  Mesh mesh = icosphere(4);
  for (Vec3& p : mesh.positions) {
    p = {p.x * 1.5f + 0.1f * p.y * p.y, p.y + 0.2f * p.x * p.z, p.z * 0.7f};
    mesh.colours.push_back(rgba8(static_cast<std::uint32_t>(p.x * 60.0f + 120.0f), 50, 60));
    mesh.normals.push_back(pack_normal(normalized(p)));
    mesh.texture_coordinates.push_back({p.x * 0.5f, p.y});
  }
  SimplifyOptions options{.target_faces = 900, .method = Method::kEdgeRemoval};
  options.edge_removal.neighbour_weight = 0.25f;
  const Thinned thinned = thin(mesh, options);
  std::uint32_t crc = kCrc32Start;
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.positions)));
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.normals)));
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.colours)));
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.texture_coordinates)));
  crc = crc32(crc, std::as_bytes(std::span(thinned.mesh.indices)));
  EXPECT_EQ(crc, 861967877u);
}

}  // namespace
}  // namespace usuzumi::testing
