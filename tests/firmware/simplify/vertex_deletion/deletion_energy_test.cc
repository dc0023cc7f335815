// Equations (1) to (5) against hand calculations, and against a second reading of the paper in doubles.
#include "firmware/simplify/vertex_deletion/deletion_energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/firmware/simplify/vertex_deletion/ring_surface.h"

namespace usuzumi::testing {
namespace {

using firmware::Deletion;
using firmware::VertexDeletionSettings;

constexpr VertexDeletionSettings kOnes{.area = 1, .move = 1, .normal = 1, .largest = 1, .boundary_area = 1,
                                       .limit_area = 0, .limit_move = 0, .limit_normal = 0, .limit_largest = 0,
                                       .protrusion_penalty = 7};

TEST(DeletionEnergy, OfASquarePyramidIsAsByHand) {
  // Base 2 x 2, height 3/4: slant height 5/4, four faces of area 5/4, five in all; the fill has two of area 2. All
  // normals rise by 1 / (5/4) = 0.8, so that their mean is (0, 0, 0.8), and the fill's are (0, 0, 1).
  const RingSurface surface(closed_ring({0, 0, 0.75f}, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}));
  const VertexDeletionSettings settings{.area = 2, .move = 3, .normal = 5, .largest = 7};
  const auto d = surface.least(0, settings, 4);
  ASSERT_TRUE(d.has_value());
  EXPECT_NEAR(d->terms.area, (5.0 - 4.0) / 5.0, 1e-6);
  EXPECT_NEAR(d->terms.move, 0.75 / 2.0, 1e-6) << "the root of the mean area, 4, is 2";
  EXPECT_NEAR(d->terms.normal, 0.2 * 0.2, 1e-6);
  EXPECT_NEAR(d->terms.largest, 2.0 / 4.0, 1e-6);
  EXPECT_NEAR(d->energy, 2 * 0.2 + 3 * 0.375 + 5 * 0.04 + 7 * 0.5, 1e-5);
  EXPECT_NEAR(d->distance, 0.75, 1e-6);
}

TEST(DeletionEnergy, OfACubesCornerIsAsByHand) {
  // Three right angles, areas 1/2; the mean normal is (1, 1, 1) / 3, the new face's (1, 1, 1) / sqrt 3, its area
  // sqrt(3) / 2, and its plane is 1 / sqrt 3 from the corner. The mean normal is not made a unit.
  const RingSurface surface(closed_ring({1, 1, 1}, {{0, 1, 1}, {1, 0, 1}, {1, 1, 0}}));
  const auto d = surface.least(0, kOnes, 1);
  ASSERT_TRUE(d.has_value());
  const double root3 = std::sqrt(3.0);
  EXPECT_NEAR(d->terms.area, (1.5 - root3 / 2) / 1.5, 1e-6);
  EXPECT_NEAR(d->terms.move, 1 / root3, 1e-6);
  EXPECT_NEAR(d->terms.normal, (1 - 1 / root3) * (1 - 1 / root3), 1e-5);
  EXPECT_NEAR(d->terms.largest, root3 / 2, 1e-6);
}

TEST(DeletionEnergy, WeighsNormalsByAnglesNotByFaces) {
  // A roof's ridge: the slope to the right is cut into three faces, the one to the left into two. By angles each has
  // half a turn, and the mean normal is (0, 0, 1 / sqrt 2), the slopes' being (+-1, 0, 1) / sqrt 2. The ridge is flat,
  // so that the fill that keeps it moves nothing: its E_norm is 1 - 1/2, whatever the cuts.
  const Mesh roof = closed_ring({0, 0, 0}, {{0, -1, 0}, {1, -1, -1}, {1, 1, -1}, {0, 1, 0}, {-1, 0, -1}});
  const auto d = RingSurface(roof).least(0, kOnes, 1);
  ASSERT_TRUE(d.has_value());
  EXPECT_NEAR(d->terms.area, 0, 1e-6);
  EXPECT_NEAR(d->terms.move, 0, 1e-6);
  EXPECT_NEAR(d->terms.normal, 0.5, 1e-5);
}

TEST(DeletionEnergy, PicksTheDiagonalThatKeepsTheRidge) {
  // A ridge from (0,-1) to (0,1): the other diagonal would cut it down.
  const std::vector<Vec3> polygon = {{0, -1, 0}, {1, 0, -1}, {0, 1, 0}, {-1, 0, -1}};
  const RingSurface surface(closed_ring({0, 0, 0}, polygon));
  const auto d = surface.least(0, kOnes, 1);
  ASSERT_TRUE(d.has_value());
  EXPECT_NEAR(d->terms.move, 0, 1e-6);
  // Told that the ridge's edge is there already, it has to take the other: half the roof's height is gone.
  const auto ring = surface.ring(0);
  firmware::TakenEdges taken;
  for (std::uint32_t a = 0; a < 4; ++a)
    for (std::uint32_t b = a + 1; b < 4; ++b)
      if (ring->vertices[a] % 2 == 1 && ring->vertices[b] % 2 == 1) taken.edges[0][a] |= 1u << b;
  const auto other = surface.least(0, kOnes, 1, &taken);
  ASSERT_TRUE(other.has_value());
  EXPECT_NEAR(other->terms.move, 1, 1e-5);
  EXPECT_GT(other->energy, d->energy);
}

TEST(DeletionEnergy, BoundaryVertexHasTheBoundarysCoefficientAndAClosingEdge) {
  // A bay of depth 1/2 in a straight boundary: the ring's area is that of the 2 x 1 box less the bay's 1/2, that is
  // 3/2; the fill's is 2.
  const RingSurface surface(open_ring({0, 0.5f, 0}, {{1, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, 0, 0}}));
  VertexDeletionSettings settings = kOnes;
  settings.boundary_area = 10;
  const auto d = surface.least(0, settings, 1);
  ASSERT_TRUE(d.has_value());
  EXPECT_NEAR(d->terms.area, 0.5 / 1.5, 1e-6);
  EXPECT_NEAR(d->terms.move, 0, 1e-6) << "flat, and inside what is filled";
  EXPECT_NEAR(d->terms.normal, 0, 1e-6);
  EXPECT_NEAR(d->terms.largest, 1, 1e-6);
  EXPECT_NEAR(d->energy, 10 * 0.5 / 1.5 + 1, 1e-5);
}

TEST(DeletionEnergy, CornerOfABoundaryIsItsDistanceFromTheNewEdge) {
  // A cape of height 1/2 is cut off: no new face is met, and the outline moves by 1/2. No penalty.
  const RingSurface surface(open_ring({0, -0.5f, 0}, {{1, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, 0, 0}}));
  const auto d = surface.least(0, kOnes, 1);
  ASSERT_TRUE(d.has_value());
  EXPECT_NEAR(d->terms.area, 0.5 / 2.5, 1e-6);
  EXPECT_NEAR(d->terms.move, 0.5, 1e-6);
}

TEST(DeletionEnergy, FillThatWouldTurnOverIsNotTaken) {
  // A flat arrow head: the ring is star-shaped around (0, 0.4), but the diagonal between the barbs lies outside it, so
  // that one of its triangles would be turned over. Only the diagonal from the notch to the tip is left.
  const std::vector<Vec3> polygon = {{0, 0.2f, 0}, {1, -1, 0}, {0, 2, 0}, {-1, -1, 0}};
  const RingSurface surface(closed_ring({0, 0.6f, 0}, polygon));
  VertexDeletionSettings only_largest{};
  only_largest.area = only_largest.move = only_largest.normal = 0;
  const auto d = surface.least(0, only_largest, 1);
  ASSERT_TRUE(d.has_value());
  EXPECT_NEAR(d->terms.area, 0, 1e-6) << "the other has an area of 3 + 1.2 against 1.8";
  EXPECT_NEAR(d->terms.largest, 0.9, 1e-6) << "half of (2 - 0.2) times 1";
}

TEST(DeletionEnergy, SliverIsNotTakenWhereTheRingHadNone) {
  // The second corner is almost on the line between its neighbours: cutting it off makes a triangle 20 long, 0.02 high.
  const RingSurface surface(closed_ring({10, 4, 0}, {{0, 0, 0}, {10, -0.02f, 0}, {20, 0, 0}, {10, 10, 0}}));
  EXPECT_TRUE(surface.least(0, kOnes, 1).has_value());
  const auto ring = surface.ring(0);
  firmware::TakenEdges taken;  // the other diagonal
  for (std::uint32_t a = 0; a < 4; ++a)
    for (std::uint32_t b = a + 1; b < 4; ++b)
      if (ring->vertices[a] % 2 == 0 && ring->vertices[b] % 2 == 0) taken.edges[0][a] |= 1u << b;
  EXPECT_FALSE(surface.least(0, kOnes, 1, &taken).has_value());
}

TEST(DeletionEnergy, FillThatWouldFoldTheTextureIsNotTaken) {
  // A flat square, either diagonal as good as the other. On the texture the third corner is drawn in past the line
  // between its neighbours, so that the diagonal 2-4 would lay its triangle there the wrong way round.
  Mesh mesh = closed_ring({0, 0, 0}, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
  const auto cut_by_1_3 = [](const RingSurface& surface) {
    const auto d = surface.least(0, kOnes, 1);
    const auto ring = surface.ring(0);
    std::uint32_t at_odd = 0;
    for (std::uint32_t t = 0; t < 2; ++t) {
      const firmware::FillTriangle f = firmware::fill_triangle(4, d->fills[0], t);
      for (const std::uint32_t c : {f.a, f.b, f.c}) at_odd += ring->vertices[c] % 2;
    }
    return at_odd == 4;  // both triangles have both odd corners
  };
  for (const std::uint32_t drawn_in : {1u, 2u, 3u, 4u}) {
    mesh.texture_coordinates.clear();
    for (const Vec3 p : mesh.positions) mesh.texture_coordinates.push_back({p.x, p.y});
    const Vec3 p = mesh.positions[drawn_in];
    mesh.texture_coordinates[drawn_in] = {0.2f * -p.x, 0.2f * -p.y};
    mesh.texture_coordinates[0] = {0.5f * -p.x, 0.5f * -p.y};
    EXPECT_EQ(cut_by_1_3(RingSurface(mesh)), drawn_in % 2 == 1) << drawn_in;
  }
}

TEST(DeletionEnergy, RingWithoutAreaOrWithoutAMeanNormalStays) {
  EXPECT_FALSE(RingSurface(closed_ring({0, 0, 0}, {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}})).least(0, kOnes, 1).has_value());
  // Folded flat onto itself: up and down cancel out.
  EXPECT_FALSE(RingSurface(closed_ring({0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 1, 1e-6f}}))
                   .least(0, kOnes, 1)
                   .has_value());
}

// ---- A second reading, in doubles: library angles, the line met by Cramer's rule, triangulations by recursion. ----

struct D3 {
  double x, y, z;
};
D3 d3(Vec3 v) { return {v.x, v.y, v.z}; }
D3 operator-(D3 a, D3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
D3 operator+(D3 a, D3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
D3 operator*(D3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
double dot(D3 a, D3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
D3 cross(D3 a, D3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double norm(D3 a) { return std::sqrt(dot(a, a)); }
using Triangle = std::array<std::size_t, 3>;
using Triangles = std::vector<Triangle>;

std::vector<Triangles> triangulations(std::size_t first, std::size_t last) {
  if (last - first < 2) return {{}};
  std::vector<Triangles> all;
  for (std::size_t m = first + 1; m < last; ++m)
    for (const Triangles& left : triangulations(first, m))
      for (const Triangles& right : triangulations(m, last)) {
        Triangles t = left;
        t.insert(t.end(), right.begin(), right.end());
        t.push_back({first, m, last});
        all.push_back(t);
      }
  return all;
}

// The least energy over the triangulations that turn no face by more than acos(0.2) from the mean normal, nor by 90
// degrees from the face at its side. Slivers are not looked at: the polygons below have none.
double reference_energy(D3 v, const std::vector<D3>& polygon, double mean_area, double penalty, bool with_facing) {
  const std::size_t n = polygon.size();
  D3 sum{0, 0, 0};
  double angles = 0, before = 0;
  std::vector<D3> normals;
  for (std::size_t i = 0; i < n; ++i) {
    const D3 p = polygon[i] - v, q = polygon[(i + 1) % n] - v, c = cross(p, q);
    const double theta = std::acos(dot(p, q) / (norm(p) * norm(q)));
    normals.push_back(c * (1 / norm(c)));
    sum = sum + normals.back() * theta;
    angles += theta;
    before += norm(c) / 2;
  }
  const D3 mean = sum * (1 / angles), direction = mean * (1 / norm(mean));
  double least = std::numeric_limits<double>::infinity();
  for (const Triangles& fill : triangulations(0, n - 1)) {
    double after = 0, turn = 0, largest = 0, distance = std::numeric_limits<double>::infinity();
    bool allowed = true;
    for (const Triangle& t : fill) {
      const D3 a = polygon[t[0]], e = polygon[t[1]] - a, f = polygon[t[2]] - a, c = cross(e, f);
      const D3 m = c * (1 / norm(c));
      allowed = allowed && dot(m, direction) > 0.2;
      for (std::size_t k = 0; k < 3; ++k)
        if (with_facing && (t[k] + 1) % n == t[(k + 1) % 3]) allowed = allowed && dot(m, normals[t[k]]) >= -2e-3;
      after += norm(c) / 2;
      largest = std::max(largest, norm(c) / 2);
      turn += dot(m - mean, m - mean);
      // v + s direction == a + g e + h f
      const D3 w = v - a;
      const double det = dot(cross(e, f), direction);
      const double g = dot(cross(w, f), direction) / det, h = dot(cross(e, w), direction) / det;
      if (g >= 0 && h >= 0 && g + h <= 1) distance = std::min(distance, std::abs(dot(c, w) / det));
    }
    if (!allowed) continue;
    const double move = std::isinf(distance) ? penalty : distance / std::sqrt(mean_area);
    least = std::min(least, std::abs(after - before) / before + move + turn / static_cast<double>(n - 2) +
                                largest / mean_area);
  }
  return least;
}

TEST(DeletionEnergy, AgreesWithASecondReadingOnRandomRings) {
  std::mt19937 random(11);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 65536) / 65535;
  };
  int deletable = 0, refused = 0, protruding = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const std::size_t n = 3 + random() % 4;
    const bool wild = trial % 2 == 0;  // so crooked that the line may miss, and without sides to look to
    const double deep = wild ? 3 : 0.5;
    std::vector<Vec3> polygon;
    for (std::size_t i = 0; i < n; ++i) {
      const double at = 6.283185307 * (static_cast<double>(i) + between(-0.3, 0.3)) / static_cast<double>(n);
      const double radius = between(0.4, 1.5);
      polygon.push_back({static_cast<float>(radius * std::cos(at)), static_cast<float>(radius * std::sin(at)),
                         static_cast<float>(between(-deep, deep))});
    }
    const Vec3 vertex{static_cast<float>(between(-0.6, 0.6)), static_cast<float>(between(-0.6, 0.6)),
                      static_cast<float>(between(-0.6, 0.6))};
    std::vector<D3> corners;
    for (const Vec3 p : polygon) corners.push_back(d3(p));
    RingSurface surface(closed_ring(vertex, polygon));
    // The sides that faces look to, as the method's start sets them.
    for (std::uint32_t face = 0; !wild && face < n; ++face) {
      const Vec3 c = cross(polygon[face] - vertex, polygon[(face + 1) % n] - vertex);
      surface.surface().set_facing(face * 4, pack_normal(normalized(c)));
    }
    const double expected = reference_energy(d3(vertex), corners, 0.7, 7, !wild);
    const auto d = surface.least(0, kOnes, 0.7f);
    if (std::isinf(expected)) {
      EXPECT_FALSE(d.has_value()) << trial;
      ++refused;
      continue;
    }
    ASSERT_TRUE(d.has_value()) << trial;
    EXPECT_NEAR(d->energy, expected, 2e-4 * (1 + expected)) << trial;
    protruding += d->terms.move == 7.0f ? 1 : 0;
    ++deletable;
  }
  EXPECT_GT(deletable, 1000);
  EXPECT_GT(refused, 50);
  EXPECT_GT(protruding, 4) << "rare: a line along the mean normal mostly passes through what spans the polygon";
}

}  // namespace
}  // namespace usuzumi::testing
