// Drawing: orientation, light, shading, culling, points, counters, each against values worked out by hand.
#include <gtest/gtest.h>

#include "tests/gfx_subsystem/engine_osmesa/osmesa_test_bench.h"

namespace usuzumi::gfx {
namespace {

constexpr Rgba8 kWhite = rgba8(255, 255, 255);
constexpr std::uint32_t kWhitePixel = 0xFFFFFFFFu;

TEST(OsmesaDraw, YRunsDownFromTheTargetsFirstRow) {
  Bench bench;
  // Clip space: the quarter x < 0, y > 0 is the panel's top left.
  bench.draw(Topology::kTriangleStrip, {{-1, 1, 0}, {-1, 0, 0}, {0, 1, 0}, {0, 0, 0}}, kWhite);
  ASSERT_TRUE(bench.run().status.ok());
  EXPECT_EQ(bench.count_pixels(kWhitePixel), 8u * 6u);
  EXPECT_EQ(bench.pixel(0, 0), kWhitePixel);
  EXPECT_EQ(bench.pixel(7, 5), kWhitePixel);
}

TEST(OsmesaDraw, ViewportPlacesClipSpaceByFractionsOfAPixel) {
  Bench bench;
  bench.put(SetViewport{2.5f, 3.25f, 4, 4, 0, 1});
  bench.draw(Topology::kTriangleStrip, {{-1, 1, 0}, {-1, -1, 0}, {1, 1, 0}, {1, -1, 0}}, kWhite);
  ASSERT_TRUE(bench.run().status.ok());
  // x in [2.5, 6.5): centres 2.5 (left edge, inside) to 5.5; y in [3.25, 7.25): centres 3.5 to 6.5
  EXPECT_EQ(bench.count_pixels(kWhitePixel), 4u * 4u);
  EXPECT_EQ(bench.pixel(2, 3), kWhitePixel);
  EXPECT_EQ(bench.pixel(5, 6), kWhitePixel);
}

TEST(OsmesaDraw, TopAndLeftEdgesThroughPixelCentresAreInside) {
  Bench bench;
  bench.set_pixel_transform();
  bench.rectangle(2.5f, 3.5f, 4, 5, 0.5f, kWhite);
  ASSERT_TRUE(bench.run().status.ok());
  EXPECT_EQ(bench.count_pixels(kWhitePixel), 4u * 5u);
  EXPECT_EQ(bench.pixel(2, 3), kWhitePixel);
  EXPECT_EQ(bench.pixel(5, 7), kWhitePixel);
  EXPECT_EQ(bench.pixel(6, 3), 0u);
  EXPECT_EQ(bench.pixel(2, 8), 0u);
}

// Light as the contract has it, on one pixel's colour: base * min(1, ambient + diffuse * max(0, normal . to_light)).
std::uint32_t lit_pixel(Rgba8 base, PackedNormal normal, const SetLight& light, bool with_normals = true) {
  Bench bench;
  bench.set_pixel_transform();
  bench.put(light);
  SetVertexStreams streams;
  streams.vertex_count = 3;
  streams.positions = bench.store<Vec3>({{0, 0, 0.5f}, {0, 40, 0.5f}, {40, 0, 0.5f}});
  if (with_normals) streams.normals = bench.store<PackedNormal>({normal, normal, normal});
  streams.constant_colour = base;
  bench.put(streams);
  bench.put(Draw{Topology::kTriangles, IndexFormat::kNone, 0, 0, 3});
  EXPECT_TRUE(bench.run().status.ok());
  return bench.pixel(3, 3);
}

TEST(OsmesaDraw, LightIsAmbientPlusDiffuseCutAtOne) {
  const Rgba8 base = rgba8(200, 100, 50, 0);
  const PackedNormal up = pack_normal({0, 0, 1}), down = pack_normal({0, 0, -1});
  const SetLight light{1, {0, 0, 1}, {0.25f, 0.5f, 0.5f}, {0.5f, 0.25f, 0.75f}};
  EXPECT_EQ(lit_pixel(base, up, light), 0xFF964B32u);    // 200 * 0.75, 100 * 0.75, 50 * min(1, 1.25)
  EXPECT_EQ(lit_pixel(base, down, light), 0xFF323219u);  // turned away: 200 * 0.25, 100 * 0.5, 50 * 0.5
  SetLight off = light;
  off.enabled = 0;
  EXPECT_EQ(lit_pixel(base, down, off), 0xFFC86432u);
  EXPECT_EQ(lit_pixel(base, down, light, false), 0xFFC86432u) << "no normals: colour = base";
  // 511 * cos(60 degrees) packs to 256 of 511: 200 * (0 + 1 * 256 / 511) = 100.2
  EXPECT_EQ(lit_pixel(rgba8(200, 200, 200), pack_normal({0.86602540f, 0, 0.5f}), {1, {0, 0, 1}, {0, 0, 0}, {1, 1, 1}}),
            0xFF646464u);
  // The field -512 stands for -1 as -511 does: 255 * 0.4996 is 127.4; unclamped it would be 127.6.
  EXPECT_EQ(lit_pixel(kWhite, PackedNormal{0x200u << 20}, {1, {0, 0, -1}, {0, 0, 0}, {0.4996f, 0.4996f, 0.4996f}}),
            0xFF7F7F7Fu);
}

TEST(OsmesaDraw, FlatTakesTheLastVertexOfEachPrimitive) {
  Bench bench;
  bench.set_pixel_transform();
  SetRasterState raster;
  raster.shade_model = ShadeModel::kFlat;
  bench.put(raster);
  SetVertexStreams streams;
  streams.vertex_count = 4;
  streams.positions = bench.store<Vec3>({{0, 0, 0.5f}, {0, 12, 0.5f}, {12, 0, 0.5f}, {12, 12, 0.5f}});
  streams.colours = bench.store<Rgba8>({rgba8(1, 0, 0), rgba8(2, 0, 0), rgba8(3, 0, 0), rgba8(4, 0, 0)});
  bench.put(streams);
  bench.put(Draw{Topology::kTriangleStrip, IndexFormat::kNone, 0, 0, 4});
  ASSERT_TRUE(bench.run().status.ok());
  EXPECT_EQ(bench.pixel(1, 1), 0xFF030000u);
  EXPECT_EQ(bench.pixel(10, 10), 0xFF040000u);
}

TEST(OsmesaDraw, WindingIsThatSeenOnThePanel) {
  struct Case {
    CullMode cull;
    FrontFace front;
    bool counter_clockwise_drawn, clockwise_drawn;
  };
  const Case cases[] = {{CullMode::kNone, FrontFace::kCounterClockwise, true, true},
                        {CullMode::kBack, FrontFace::kCounterClockwise, true, false},
                        {CullMode::kFront, FrontFace::kCounterClockwise, false, true},
                        {CullMode::kBack, FrontFace::kClockwise, false, true},
                        {CullMode::kFront, FrontFace::kClockwise, true, false}};
  for (const Case& c : cases) {
    Bench bench;
    bench.set_pixel_transform();
    SetRasterState raster;
    raster.cull = c.cull;
    raster.front_face = c.front;
    bench.put(raster);
    bench.draw(Topology::kTriangles, {{4, 0, 0.5f}, {0, 8, 0.5f}, {8, 8, 0.5f}}, kWhite);   // top, left, right
    bench.draw(Topology::kTriangles, {{12, 0, 0.5f}, {16, 8, 0.5f}, {8, 8, 0.5f}}, kWhite);  // top, right, left
    const ExecutionReport report = bench.run();
    ASSERT_TRUE(report.status.ok());
    EXPECT_EQ(bench.pixel(4, 6) == kWhitePixel, c.counter_clockwise_drawn);
    EXPECT_EQ(bench.pixel(12, 6) == kWhitePixel, c.clockwise_drawn);
    EXPECT_EQ(report.counters.faces_in, 2u);
    EXPECT_EQ(report.counters.faces_drawn, (c.counter_clockwise_drawn ? 1u : 0u) + (c.clockwise_drawn ? 1u : 0u));
  }
}

TEST(OsmesaDraw, PointsAreSquaresAroundTheirVertex) {
  struct Case {
    float size;
    Vec3 at;
    std::uint32_t x, y, width, height;
  };
  // A pixel belongs to the square when its centre lies in [at - size / 2, at + size / 2).
  const Case cases[] = {{1, {5.5f, 5.5f, 0.5f}, 5, 5, 1, 1},   {1, {5.25f, 5.75f, 0.5f}, 5, 5, 1, 1},
                        {2, {6, 6, 0.5f}, 5, 5, 2, 2},         {3, {6.5f, 5.5f, 0.5f}, 5, 4, 3, 3},
                        {4, {6.25f, 6.75f, 0.5f}, 4, 5, 4, 4}, {2.5f, {6.5f, 6.5f, 0.5f}, 5, 5, 3, 3},
                        {1.5f, {6, 6, 0.5f}, 5, 5, 2, 2}};
  for (const Case& c : cases) {
    Bench bench;
    bench.set_pixel_transform();
    SetRasterState raster;
    raster.point_size = c.size;
    bench.put(raster);
    bench.draw(Topology::kPoints, {c.at}, kWhite);
    ASSERT_TRUE(bench.run().status.ok());
    EXPECT_EQ(bench.count_pixels(kWhitePixel), c.width * c.height)
        << "size " << c.size << " at " << c.at.x << " " << c.at.y;
    EXPECT_EQ(bench.pixel(c.x, c.y), kWhitePixel);
    EXPECT_EQ(bench.pixel(c.x + c.width - 1, c.y + c.height - 1), kWhitePixel);
  }
}

TEST(OsmesaDraw, CountersTellWhatTheListAskedFor) {
  Bench bench;
  bench.set_pixel_transform();
  SetVertexStreams streams;
  streams.vertex_count = 5;
  streams.positions = bench.store<Vec3>({{0, 0, 0.5f}, {0, 4, 0.5f}, {4, 0, 0.5f}, {4, 4, 0.5f}, {900, 4, 0.5f}});
  bench.put(streams);
  const BusAddress indices = bench.store<std::uint16_t>({1, 2, 3, 3, 2, 2, 9, 9});
  bench.put(Draw{Topology::kTriangles, IndexFormat::kU16, indices, 0, 6});  // vertices 1 to 3; the second has no area
  bench.put(Draw{Topology::kTriangleStrip, IndexFormat::kNone, 0, 0, 4});      // vertices 0 to 3
  bench.put(Draw{Topology::kLines, IndexFormat::kNone, 0, 0, 3});              // one line
  bench.put(Draw{Topology::kPoints, IndexFormat::kNone, 0, 4, 1});             // off the target
  const ExecutionReport report = bench.run();
  ASSERT_TRUE(report.status.ok()) << report.status.message;
  const EngineCounters& c = report.counters;
  EXPECT_EQ(c.command_words, bench.words.size());
  EXPECT_EQ(c.vertices_transformed, 3u + 4u + 3u + 1u);
  EXPECT_EQ(c.faces_in, 2u + 2u);
  EXPECT_EQ(c.primitives_in, 4u + 1u + 1u);
  EXPECT_EQ(c.faces_drawn, 3u);
  // The strip is 4 x 4 pixels. Of the triangle (0,4) (4,0) (4,4) 6 centres lie inside and 4 on its diagonal, which is
  // its left edge: 10. The line from (0, 0) to (0, 4) lies between two columns and takes the one on its left: none.
  EXPECT_EQ(c.pixels_tested, 16u + 10u);
}

}  // namespace
}  // namespace usuzumi::gfx
