// Which pixels a triangle covers: the top-left rule by hand, shared edges, and a slow rasterizer written for this test.
#include <algorithm>
#include <array>
#include <cmath>

#include "tests/gfx_subsystem/engine_soft/test_bench.h"

namespace usuzumi::gfx::test {
namespace {

constexpr Rgba8 kWhite = rgba8(255, 255, 255);

TEST(TopLeftFillRule, PixelSquareIsCoveredOnceWithoutItsRightAndBottomBorder) {
  // Corners at pixel centres: left and top borders belong to it, right and bottom ones do not.
  Bench b(4, 4);
  b.streams({{0.5f, 0.5f, 0}, {2.5f, 0.5f, 0}, {2.5f, 2.5f, 0}, {0.5f, 2.5f, 0}}, {}, kWhite)
      .draw(Topology::kTriangleFan, 4);
  const auto report = b.run();
  EXPECT_TRUE(report.status.ok()) << report.status.message;
  EXPECT_EQ(b.picture(), "##..\n##..\n....\n....\n");
  EXPECT_EQ(report.counters.pixels_tested, 4u);
}

TEST(TopLeftFillRule, DiagonalThroughPixelCentresBelongsToTheTriangleOnItsRight) {
  // The diagonal from (0,0) to (4,4) passes through the centres (0.5,0.5) ... For the upper right triangle it is a left
  // edge, for the lower left one a right edge.
  Bench upper(4, 4), lower(4, 4);
  upper.streams({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}}, {}, kWhite).draw(Topology::kTriangles, 3);
  lower.streams({{0, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {}, kWhite).draw(Topology::kTriangles, 3);
  ASSERT_TRUE(upper.run().status.ok());
  ASSERT_TRUE(lower.run().status.ok());
  EXPECT_EQ(upper.picture(), "####\n.###\n..##\n...#\n");
  EXPECT_EQ(lower.picture(), "....\n#...\n##..\n###.\n");
}

TEST(TopLeftFillRule, OtherDiagonalBelongsToTheTriangleBelowRightOfIt) {
  Bench b(4, 4);
  b.streams({{4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {}, kWhite).draw(Topology::kTriangles, 3);
  ASSERT_TRUE(b.run().status.ok());
  EXPECT_EQ(b.picture(), "...#\n..##\n.###\n####\n");
}

TEST(TopLeftFillRule, HorizontalBorderBelongsToTheTriangleBelow) {
  Bench above(4, 4), below(4, 4);
  above.streams({{0, 0, 0}, {4, 0, 0}, {4, 1.5f, 0}, {0, 1.5f, 0}}, {}, kWhite).draw(Topology::kTriangleFan, 4);
  below.streams({{0, 1.5f, 0}, {4, 1.5f, 0}, {4, 3, 0}, {0, 3, 0}}, {}, kWhite).draw(Topology::kTriangleFan, 4);
  ASSERT_TRUE(above.run().status.ok());
  ASSERT_TRUE(below.run().status.ok());
  EXPECT_EQ(above.picture(), "####\n....\n....\n....\n");
  EXPECT_EQ(below.picture(), "....\n####\n####\n....\n");
}

TEST(TopLeftFillRule, HoldsForBigTrianglesAsForSmallOnes) {
  for (const float size : {2.0f, 62.0f, 63.0f, 64.0f, 100.0f, 300.0f}) {
    const float a = 0.5f, b = size + 0.5f;
    Bench bench(320, 320);
    bench.streams({{a, a, 0}, {b, a, 0}, {b, b, 0}, {a, b, 0}}, {}, kWhite).draw(Topology::kTriangleFan, 4);
    EXPECT_EQ(bench.run().counters.pixels_tested, static_cast<std::uint64_t>(size * size)) << size;
    EXPECT_NE(bench.pixel(0, 0), 0u) << size;
    EXPECT_EQ(bench.pixel(static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(size)), 0u) << size;
  }
}

TEST(TopLeftFillRule, WindingDoesNotMatter) {
  Bench a(8, 8), b(8, 8);
  a.streams({{0.7f, 1, 0}, {7.1f, 2.2f, 0}, {3, 7.6f, 0}}, {}, kWhite).draw(Topology::kTriangles, 3);
  b.streams({{0.7f, 1, 0}, {3, 7.6f, 0}, {7.1f, 2.2f, 0}}, {}, kWhite).draw(Topology::kTriangles, 3);
  ASSERT_TRUE(a.run().status.ok());
  ASSERT_TRUE(b.run().status.ok());
  EXPECT_EQ(a.picture(), b.picture());
  EXPECT_GT(a.covered(), 10u);
}

/// Straight from the rule's definition, in 64-bit integers, every pixel of the target on its own.
class NaiveRaster {
 public:
  NaiveRaster(std::int32_t width, std::int32_t height)
      : width_(width), height_(height), count_(static_cast<std::size_t>(width * height)) {}

  void add(std::array<std::array<std::int64_t, 2>, 3> v) {  // 1/256 pixel
    const std::int64_t area = (v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) - (v[2][0] - v[0][0]) * (v[1][1] - v[0][1]);
    if (area == 0) return;
    if (area < 0) std::swap(v[1], v[2]);
    for (std::int32_t y = 0; y < height_; ++y)
      for (std::int32_t x = 0; x < width_; ++x) {
        bool inside = true;
        for (std::size_t i = 0; i < 3 && inside; ++i) {
          const auto &p = v[i], &q = v[(i + 1) % 3];
          const std::int64_t dx = q[0] - p[0], dy = q[1] - p[1];
          const std::int64_t side = dx * (y * 256 + 128 - p[1]) - dy * (x * 256 + 128 - p[0]);
          const bool top_or_left = dy < 0 || (dy == 0 && dx > 0);
          inside = side > 0 || (side == 0 && top_or_left);
        }
        if (inside) ++count_[static_cast<std::size_t>(y * width_ + x)];
      }
  }
  std::uint32_t at(std::uint32_t x, std::uint32_t y) const {
    return count_[y * static_cast<std::uint32_t>(width_) + x];
  }
  std::uint64_t total() const {
    std::uint64_t n = 0;
    for (auto c : count_) n += c;
    return n;
  }

 private:
  std::int32_t width_, height_;
  std::vector<std::uint32_t> count_;
};

struct RandomShape {
  const char* name;
  float size;      // pixels
  std::uint32_t triangles;
};

class CoverageAgainstNaive : public ::testing::TestWithParam<RandomShape> {};

TEST_P(CoverageAgainstNaive, EveryPixelOfEveryTriangleAgrees) {
  // Coordinates are multiples of 1/256, so that both sides see the same vertices.
  constexpr std::uint32_t kWidth = 256, kHeight = 128;  // powers of two: the transform is exact
  Random random(7);
  for (std::uint32_t n = 0; n < GetParam().triangles; ++n) {
    const float cx = random.in(-20, kWidth + 20.0f), cy = random.in(-20, kHeight + 20.0f);
    std::vector<Vec3> v;
    std::array<std::array<std::int64_t, 2>, 3> fixed;
    const bool on_centres = n % 4 == 0;  // vertices on pixel centres provoke ties
    for (std::size_t i = 0; i < 3; ++i) {
      const float x = cx + random.in(-0.5f, 0.5f) * GetParam().size, y = cy + random.in(-0.5f, 0.5f) * GetParam().size;
      fixed[i] = {static_cast<std::int64_t>(std::floor(x)) * 256 + (on_centres ? 128 : random.below(256)),
                  static_cast<std::int64_t>(std::floor(y)) * 256 + (on_centres ? 128 : random.below(256))};
      v.push_back({static_cast<float>(fixed[i][0]) / 256, static_cast<float>(fixed[i][1]) / 256, 0});
    }
    NaiveRaster naive(kWidth, kHeight);
    naive.add(fixed);
    Bench b(kWidth, kHeight);
    b.streams(v, {}, kWhite).draw(Topology::kTriangles, 3);
    const auto report = b.run();
    ASSERT_TRUE(report.status.ok());
    ASSERT_EQ(report.counters.pixels_tested, naive.total()) << "triangle " << n;
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x)
        ASSERT_EQ(b.pixel(x, y) != 0, naive.at(x, y) != 0) << "triangle " << n << " at " << x << ", " << y;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, CoverageAgainstNaive,
                         ::testing::Values(RandomShape{"tiny", 3, 400}, RandomShape{"small", 20, 300},
                                           RandomShape{"tile", 70, 200}, RandomShape{"big", 300, 150},
                                           RandomShape{"huge", 20000, 50}),
                         [](const auto& shape) { return shape.param.name; });

/// A triangulated grid with jittered inner vertices over [0, width] x [0, height].
struct JitteredGrid {
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> indices;

  JitteredGrid(std::uint32_t columns, std::uint32_t rows, float width, float height, std::uint32_t seed) {
    Random random(seed);
    for (std::uint32_t j = 0; j <= rows; ++j)
      for (std::uint32_t i = 0; i <= columns; ++i) {
        const float w = width / static_cast<float>(columns), h = height / static_cast<float>(rows);
        const float jx = i == 0 || i == columns ? 0 : random.in(-0.2f, 0.2f),
                    jy = j == 0 || j == rows ? 0 : random.in(-0.2f, 0.2f);
        positions.push_back({(static_cast<float>(i) + jx) * w, (static_cast<float>(j) + jy) * h, random.in(0, 1)});
      }
    for (std::uint32_t j = 0; j < rows; ++j)
      for (std::uint32_t i = 0; i < columns; ++i) {
        const std::uint32_t a = j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
        if (random.below(2) != 0) indices.insert(indices.end(), {a, b, d, a, d, c});
        else indices.insert(indices.end(), {a, b, c, b, d, c});
      }
  }
};

class WatertightGrid : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(WatertightGrid, EveryPixelIsDrawnExactlyOnce) {
  constexpr std::uint32_t kWidth = 203, kHeight = 131;
  const JitteredGrid grid(GetParam(), GetParam(), kWidth, kHeight, GetParam());
  Bench b(kWidth, kHeight, PixelFormat::kXrgb8888, DepthFormat::kNone, 0, 8u << 20);
  b.streams(grid.positions, {}, kWhite).draw_indexed(Topology::kTriangles, grid.indices);
  const auto report = b.run();
  ASSERT_TRUE(report.status.ok());
  EXPECT_EQ(report.counters.pixels_tested, kWidth * kHeight);  // no pixel twice ...
  EXPECT_EQ(b.covered(), kWidth * kHeight);                    // ... and none left out
}

INSTANTIATE_TEST_SUITE_P(Cells, WatertightGrid, ::testing::Values(1u, 2u, 3u, 7u, 30u, 100u, 250u));

TEST(Coverage, PerspectiveMeshIsWatertightToo) {
  constexpr std::uint32_t kWidth = 320, kHeight = 200;
  JitteredGrid grid(40, 40, 8, 8, 3);
  for (auto& p : grid.positions)
    p = {p.x - 4, p.y - 4, -3 - 0.3f * (p.x - 4)};  // a slanted plane beyond the view on all sides
  Bench b(kWidth, kHeight, PixelFormat::kXrgb8888, DepthFormat::kNone, 0, 8u << 20);
  const float near = 0.5f, far = 20;
  b.put(SetTransform{
      {{1.2f, 0, 0, 0, 0, 1.2f, 0, 0, 0, 0, (far + near) / (near - far), 2 * far * near / (near - far), 0, 0, -1, 0}}});
  b.streams(grid.positions, {}, kWhite).draw_indexed(Topology::kTriangles, grid.indices);
  const auto report = b.run();
  ASSERT_TRUE(report.status.ok());
  EXPECT_EQ(report.counters.pixels_tested, kWidth * kHeight);
  EXPECT_EQ(b.covered(), kWidth * kHeight);
}

TEST(Coverage, ScissorAndViewportCutAtPixelBorders) {
  for (std::uint32_t kind = 0; kind < 2; ++kind) {
    Bench b(100, 80);
    if (kind == 0) {
      b.put(SetScissor{13, 7, 50, 41});
    } else {
      b.put(SetViewport{13, 7, 50, 41, 0, 1});
    }
    b.put(SetTransform{});
    b.streams({{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}}, {}, kWhite).draw(Topology::kTriangleFan, 4);
    const auto report = b.run();
    ASSERT_TRUE(report.status.ok());
    EXPECT_EQ(report.counters.pixels_tested, 50u * 41u);
    for (std::uint32_t y = 0; y < 80; ++y)
      for (std::uint32_t x = 0; x < 100; ++x)
        ASSERT_EQ(b.pixel(x, y) != 0, x >= 13 && x < 63 && y >= 7 && y < 48) << x << ", " << y;
  }
}

TEST(Coverage, SmallTriangleAcrossTheScissorIsCutExactly) {
  Random random(11);
  for (int n = 0; n < 200; ++n) {
    std::vector<Vec3> v;
    for (int i = 0; i < 3; ++i) v.push_back({random.in(50, 80), random.in(50, 80), 0});
    const SetScissor s{50 + random.below(20), 50 + random.below(20), 1 + random.below(20), 1 + random.below(20)};
    Bench whole(128, 128), cut(128, 128);
    whole.streams(v, {}, kWhite).draw(Topology::kTriangles, 3);
    cut.put(s).streams(v, {}, kWhite).draw(Topology::kTriangles, 3);
    ASSERT_TRUE(whole.run().status.ok());
    ASSERT_TRUE(cut.run().status.ok());
    for (std::uint32_t y = 0; y < 128; ++y)
      for (std::uint32_t x = 0; x < 128; ++x) {
        const bool in = x >= s.x && x < s.x + s.width && y >= s.y && y < s.y + s.height;
        ASSERT_EQ(cut.pixel(x, y), in ? whole.pixel(x, y) : 0u) << n << " at " << x << ", " << y;
      }
  }
}

}  // namespace
}  // namespace usuzumi::gfx::test
