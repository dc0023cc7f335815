// What is written where a triangle covers: formats, rounding, shading, depth, clears, light.
#include <cmath>

#include "tests/gfx_subsystem/engine_soft/test_bench.h"

namespace usuzumi::gfx::test {
namespace {

const std::vector<Vec3> kWholeSquare{{0, 0, 0.5f}, {64, 0, 0.5f}, {64, 64, 0.5f}, {0, 64, 0.5f}};

TEST(PixelFormats, Xrgb8888HasRedOnTopAndOnesInTheUnusedByte) {
  Bench b(64, 64);
  b.streams(kWholeSquare, {}, rgba8(0x12, 0x34, 0x56, 0)).draw(Topology::kTriangleFan, 4);
  ASSERT_TRUE(b.run().status.ok());
  EXPECT_EQ(b.pixel(0, 0), 0xFF123456u);
  EXPECT_EQ(b.pixel(63, 63), 0xFF123456u);
}

TEST(PixelFormats, Rgb565RoundsEveryChannelToTheNearest) {
  for (std::uint32_t v = 0; v < 256; ++v) {
    Bench b(8, 8, PixelFormat::kRgb565);
    b.streams({{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}}, {}, rgba8(v, 255 - v, v)).draw(Topology::kTriangleFan, 4);
    b.put(SetScissor{0, 4, 8, 4}).put(Clear{kClearColour, rgba8(v, 255 - v, v), 1});
    ASSERT_TRUE(b.run().status.ok());
    const auto five = static_cast<std::uint32_t>(std::lround(v * 31 / 255.0)),
               six = static_cast<std::uint32_t>(std::lround((255 - v) * 63 / 255.0));
    EXPECT_EQ(b.pixel(3, 3), five << 11 | six << 5 | five) << v;
    EXPECT_EQ(b.pixel(3, 5), b.pixel(3, 3)) << "clear and draw differ at " << v;
  }
}

TEST(PixelFormats, BytesBetweenRowsStayUntouched) {
  for (const auto format : {PixelFormat::kRgb565, PixelFormat::kXrgb8888}) {
    Bench b(65, 67, format, DepthFormat::kUnorm16, 20);
    b.fill_vram(0xA5);
    SetRasterState raster;
    raster.depth_test = 1;
    b.put(Clear{kClearColour | kClearDepth, rgba8(1, 2, 3), 1}).put(raster);
    b.streams({{-100, -100, 0.5f}, {300, -100, 0.5f}, {-100, 300, 0.5f}}).draw(Topology::kTriangles, 3);
    ASSERT_TRUE(b.run().status.ok());
    const std::size_t row = 65 * bytes_per_pixel(format);
    for (std::uint32_t y = 0; y < 67; ++y)
      for (std::size_t i = row; i < b.stride(); ++i)
        ASSERT_EQ(b.vram()[y * b.stride() + i], std::byte{0xA5}) << y << ", " << i;
  }
}

TEST(Shading, FlatTakesTheLastVertexOfEveryPrimitive) {
  const Rgba8 red = rgba8(255, 0, 0), green = rgba8(0, 255, 0), blue = rgba8(0, 0, 255), white = rgba8(255, 255, 255);
  const std::vector<Vec3> corners{{0, 0, 0}, {0, 64, 0}, {64, 0, 0}, {64, 64, 0}};
  SetRasterState flat;
  flat.shade_model = ShadeModel::kFlat;
  Bench strip(64, 64);
  strip.put(flat).streams(corners, {red, green, blue, white}).draw(Topology::kTriangleStrip, 4);
  ASSERT_TRUE(strip.run().status.ok());
  EXPECT_EQ(strip.pixel(5, 5), 0xFF0000FFu);    // 0 1 2
  EXPECT_EQ(strip.pixel(60, 60), 0xFFFFFFFFu);  // 2 1 3
  Bench fan(64, 64);
  fan.put(flat)
      .streams({{0, 0, 0}, {0, 64, 0}, {64, 64, 0}, {64, 0, 0}}, {red, green, blue, white})
      .draw(Topology::kTriangleFan, 4);
  ASSERT_TRUE(fan.run().status.ok());
  EXPECT_EQ(fan.pixel(5, 60), 0xFF0000FFu);
  EXPECT_EQ(fan.pixel(60, 5), 0xFFFFFFFFu);
  Bench line(64, 64);
  line.put(flat).streams({{0, 10.5f, 0}, {64, 10.5f, 0}}, {red, green}).draw(Topology::kLines, 2);
  ASSERT_TRUE(line.run().status.ok());
  EXPECT_EQ(line.pixel(3, 10), 0xFF00FF00u);
}

TEST(Shading, GouraudIsLinearToHalfAStepAcrossSizes) {
  for (const float size : {8.0f, 60.0f, 64.0f, 200.0f, 900.0f}) {
    const auto pixels = static_cast<std::uint32_t>(size);
    Bench b(1024, 1024);
    b.streams({{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {size, size, 0}},
              {rgba8(0, 0, 255), rgba8(255, 0, 255), rgba8(0, 255, 255), rgba8(255, 255, 255)})
        .draw(Topology::kTriangleStrip, 4);
    ASSERT_TRUE(b.run().status.ok());
    for (std::uint32_t y = 0; y < pixels; y += 3)
      for (std::uint32_t x = 0; x < pixels; x += 3) {
        const double r = (x + 0.5) / static_cast<double>(size) * 255, g = (y + 0.5) / static_cast<double>(size) * 255;
        ASSERT_NEAR(b.pixel(x, y) >> 16 & 255, r, 0.8) << size << " at " << x << ", " << y;
        ASSERT_NEAR(b.pixel(x, y) >> 8 & 255, g, 0.8) << size << " at " << x << ", " << y;
        ASSERT_EQ(b.pixel(x, y) & 255, 255u);
      }
  }
}

TEST(Shading, PerspectiveColourFollowsTheSurfaceNotTheWindow) {
  // A floor from w = 1 to w = 8: halfway across the window the surface parameter is 1 / (1 + 8), not 1 / 2.
  Bench b(64, 256);
  b.put(SetTransform{});
  b.put(SetTransform{{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0}}});  // w = z of the model, depth 0
  b.streams({{-1, -1, 1}, {1, -1, 1}, {8, 8, 8}, {-8, 8, 8}},
            {rgba8(0, 0, 0), rgba8(0, 0, 0), rgba8(255, 255, 255), rgba8(255, 255, 255)})
      .draw(Topology::kTriangleFan, 4);
  ASSERT_TRUE(b.run().status.ok());
  for (std::uint32_t y = 0; y < 256; ++y) {
    const double s = 1 - (y + 0.5) / 256;                // 0 at the bottom, where w = 1
    const double t = s / 8 / ((1 - s) / 1 + s / 8);      // perspective-correct parameter
    ASSERT_NEAR(b.pixel(32, y) & 255, t * 255, 0.6) << y;
  }
}

TEST(Shading, SliversNeverLeaveTheRangeOfTheirCorners) {
  Random random(5);
  for (int n = 0; n < 3000; ++n) {
    Bench b(128, 128, PixelFormat::kXrgb8888, DepthFormat::kUnorm24);
    SetRasterState raster;
    raster.depth_test = 1;
    raster.depth_function = DepthFunction::kAlways;
    b.put(raster);
    const float x = random.in(0, 128), y = random.in(0, 128), dx = random.in(-70, 70), dy = random.in(-70, 70),
                t = random.in(0.1f, 0.9f);
    b.streams({{x, y, 1},
               {x + dx, y + dy, 0},
               {x + dx * t + random.in(-0.02f, 0.02f), y + dy * t + random.in(-0.02f, 0.02f), 1}},
              {rgba8(255, 0, 100), rgba8(255, 255, 100), rgba8(255, 0, 110)})
        .draw(Topology::kTriangles, 3);
    b.put(SetScissor{0, 0, 128, 128});
    ASSERT_TRUE(b.run().status.ok());
    for (std::uint32_t py = 0; py < 128; ++py)
      for (std::uint32_t px = 0; px < 128; ++px) {
        const std::uint32_t c = b.pixel(px, py);
        if (c == 0) continue;
        ASSERT_EQ(c >> 16 & 255, 255u) << n;
        ASSERT_GE(c & 255, 100u) << n;
        ASSERT_LE(c & 255, 110u) << n;
      }
  }
}

TEST(Depth, FunctionsCompareAsNamed) {
  struct Case { DepthFunction function; bool nearer, equal, farther; };
  for (const auto& c :
       {Case{DepthFunction::kLess, true, false, false}, Case{DepthFunction::kLessEqual, true, true, false},
        Case{DepthFunction::kAlways, true, true, true}})
    for (const auto format : {DepthFormat::kUnorm16, DepthFormat::kUnorm24})
      for (int kind = 0; kind < 3; ++kind) {
        Bench b(16, 16, PixelFormat::kXrgb8888, format);
        SetRasterState raster;
        raster.depth_test = 1;
        raster.depth_function = c.function;
        b.put(raster).put(Clear{kClearColour | kClearDepth, rgba8(0, 0, 0), 0.5f});
        const float z = kind == 0 ? 0.25f : kind == 1 ? 0.5f : 0.75f;
        b.streams({{0, 0, z}, {16, 0, z}, {16, 16, z}, {0, 16, z}}, {}, rgba8(255, 0, 0))
            .draw(Topology::kTriangleFan, 4);
        ASSERT_TRUE(b.run().status.ok());
        const bool passes = kind == 0 ? c.nearer : kind == 1 ? c.equal : c.farther;
        EXPECT_EQ(b.pixel(7, 7), passes ? 0xFFFF0000u : 0xFF000000u);
        const double most = format == DepthFormat::kUnorm16 ? 65535.0 : 16777215.0;
        EXPECT_EQ(b.depth(7, 7),
                  static_cast<std::uint32_t>(std::floor((passes ? static_cast<double>(z) : 0.5) * most + 0.5)));
      }
}

TEST(Depth, WithoutWritingOrTestingTheBufferKeepsItsValues) {
  for (const bool test : {false, true}) {
    Bench b(16, 16, PixelFormat::kXrgb8888, DepthFormat::kUnorm16);
    SetRasterState raster;
    raster.depth_test = test;
    raster.depth_write = test ? 0 : 1;  // without the test nothing is written either
    b.put(raster).put(Clear{kClearDepth, {}, 1});
    b.streams({{0, 0, 0.25f}, {16, 0, 0.25f}, {16, 16, 0.25f}}, {}, rgba8(255, 0, 0)).draw(Topology::kTriangles, 3);
    ASSERT_TRUE(b.run().status.ok());
    EXPECT_EQ(b.pixel(12, 3), 0xFFFF0000u);
    EXPECT_EQ(b.depth(12, 3), 65535u);
  }
}

TEST(Depth, SlopeIsExactToAStepOverTheWholeTarget) {
  Bench b(512, 256, PixelFormat::kXrgb8888, DepthFormat::kUnorm24);
  SetRasterState raster;
  raster.depth_test = 1;
  b.put(raster).put(Clear{kClearDepth, {}, 1});
  b.streams({{0, 0, 0}, {512, 0, 1}, {0, 256, 0}, {512, 256, 1}}).draw(Topology::kTriangleStrip, 4);
  ASSERT_TRUE(b.run().status.ok());
  for (std::uint32_t y = 0; y < 256; y += 7)
    for (std::uint32_t x = 0; x < 512; ++x)
      ASSERT_NEAR(b.depth(x, y), (x + 0.5) / 512 * 16777215.0, 1.0) << x << ", " << y;
}

TEST(Clear, FillsTheScissorOnlyAndCountsItsPixels) {
  Bench b(130, 70, PixelFormat::kRgb565, DepthFormat::kUnorm24);
  b.put(SetScissor{60, 3, 10, 66}).put(Clear{kClearColour | kClearDepth, rgba8(255, 0, 0), 0.5f});
  const auto report = b.run();
  ASSERT_TRUE(report.status.ok());
  EXPECT_EQ(report.counters.pixels_cleared, 660u);
  for (std::uint32_t y = 0; y < 70; ++y)
    for (std::uint32_t x = 0; x < 130; ++x) {
      const bool in = x >= 60 && x < 70 && y >= 3 && y < 69;
      ASSERT_EQ(b.pixel(x, y), in ? 0xF800u : 0u) << x << ", " << y;
      ASSERT_EQ(b.depth(x, y), in ? 8388608u : 0u) << x << ", " << y;
    }
}

TEST(Clear, BetweenDrawsKeepsTheOrderOfTheList) {
  Bench b(64, 64);
  b.streams(kWholeSquare, {}, rgba8(255, 0, 0)).draw(Topology::kTriangleFan, 4);
  b.put(SetScissor{0, 0, 32, 64}).put(Clear{kClearColour, rgba8(0, 255, 0), 1});
  b.put(SetScissor{0, 0, 16, 64}).streams(kWholeSquare, {}, rgba8(0, 0, 255)).draw(Topology::kTriangleFan, 4);
  ASSERT_TRUE(b.run().status.ok());
  EXPECT_EQ(b.pixel(8, 8), 0xFF0000FFu);
  EXPECT_EQ(b.pixel(24, 8), 0xFF00FF00u);
  EXPECT_EQ(b.pixel(40, 8), 0xFFFF0000u);
}

TEST(Light, FollowsTheFormulaByHand) {
  // Normal (0, 0, 1), light from (0, 0.6, 0.8): n.l = 0.8. Red 200 * (0.1 + 0.5 * 0.8) = 100; green 100 * min(1, 0.5 +
  // 0.9 * 0.8) = 100; blue 50 * 0.2 = 10.
  Bench b(16, 16);
  SetVertexStreams s;
  s.vertex_count = 3;
  s.positions = b.upload(std::vector<Vec3>{{0, 0, 0}, {16, 0, 0}, {0, 16, 0}});
  s.normals = b.upload(std::vector<PackedNormal>(3, pack_normal({0, 0, 1})));
  s.constant_colour = rgba8(200, 100, 50);
  b.put(s).put(SetLight{1, {0, 0.6f, 0.8f}, {0.1f, 0.5f, 0.2f}, {0.5f, 0.9f, 0}}).draw(Topology::kTriangles, 3);
  ASSERT_TRUE(b.run().status.ok());
  EXPECT_EQ(b.pixel(3, 3), 0xFF64640Au);
}

TEST(Light, FromBehindLeavesTheAmbientPart) {
  Bench b(16, 16);
  SetVertexStreams s;
  s.vertex_count = 3;
  s.positions = b.upload(std::vector<Vec3>{{0, 0, 0}, {16, 0, 0}, {0, 16, 0}});
  s.normals = b.upload(std::vector<PackedNormal>(3, pack_normal({0, 0, -1})));
  s.constant_colour = rgba8(200, 100, 50);
  b.put(s).put(SetLight{1, {0, 0, 1}, {0.5f, 0.25f, 1}, {1, 1, 1}}).draw(Topology::kTriangles, 3);
  ASSERT_TRUE(b.run().status.ok());
  EXPECT_EQ(b.pixel(3, 3), 0xFF641932u);
}

TEST(Light, WithoutNormalsTheColourIsTheBase) {
  Bench b(16, 16);
  b.put(SetLight{1, {0, 0, 1}, {0, 0, 0}, {0, 0, 0}});
  b.streams({{0, 0, 0}, {16, 0, 0}, {0, 16, 0}}, {}, rgba8(9, 8, 7)).draw(Topology::kTriangles, 3);
  ASSERT_TRUE(b.run().status.ok());
  EXPECT_EQ(b.pixel(3, 3), 0xFF090807u);
}

}  // namespace
}  // namespace usuzumi::gfx::test
