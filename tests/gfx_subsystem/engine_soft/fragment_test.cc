// What becomes of a fragment: texel times colour, alpha test, blending, depth; by hand calculations.
#include "tests/gfx_subsystem/engine_soft/texture_bench.h"

namespace usuzumi::gfx::test {
namespace {

std::uint32_t over_255(std::uint32_t v) { return (2 * v + 255) / 510; }  // rounded to nearest, as a fraction says it

TexturedQuad coloured(const TexturedQuad& quad, Rgba8 colour) {
  TexturedQuad q = quad;
  for (Rgba8& c : q.colour) c = colour;
  return q;
}

TEST(Fragment, TexelTimesColourIsRoundedToNearestForEveryPair) {
  on_every_kernel([](const EngineSetup& setup) {
    TestImage ramp{256, 1, {}};
    for (std::uint32_t i = 0; i < 256; ++i) ramp.texels.push_back(0xFF000000u | i << 16 | (255 - i) << 8 | i);
    Bench b(256, 256);
    b.put(upload_argb(b, ramp, TextureFilter::kNearest));
    for (std::uint32_t c = 0; c < 256; ++c) {
      const auto y = static_cast<float>(c);
      draw_quad(b, coloured(image_over(0, y, 256, y + 1), rgba8(c, c, 255 - c)));
    }
    ASSERT_TRUE(b.run(setup).status.ok());
    for (std::uint32_t c = 0; c < 256; ++c)
      for (std::uint32_t i = 0; i < 256; ++i)
        ASSERT_EQ(b.pixel(i, c), 0xFF000000u | over_255(i * c) << 16 | over_255((255 - i) * c) << 8 |
                                     over_255(i * (255 - c)))
            << i << " * " << c;
  });
}

TEST(Fragment, LightAndVertexColoursModulateTheTexture) {
  Bench b(8, 8);
  b.put(upload_argb(b, {1, 1, {0xFF8040FFu}}, TextureFilter::kBilinear));
  b.put(SetLight{1, {0, 0, 1}, {0.5f, 0.5f, 0.5f}, {0, 0, 0}});
  SetVertexStreams s;
  s.vertex_count = 3;
  s.positions = b.upload(std::vector<Vec3>{{0, 0, 0}, {20, 0, 0}, {0, 20, 0}});
  s.normals = b.upload(std::vector<PackedNormal>(3));
  s.texture_coordinates = b.upload(std::vector<TexCoord>(3));
  s.constant_colour = rgba8(200, 100, 50);
  b.put(s).draw(Topology::kTriangles, 3);
  ASSERT_TRUE(b.run().status.ok());
  EXPECT_EQ(b.pixel(3, 3), 0xFF000000u | over_255(128 * 100) << 16 | over_255(64 * 50) << 8 | over_255(255 * 25));
}

TEST(Fragment, ColourAndAlphaRunAcrossATriangleWithTheTexture) {
  // Alpha and red from 0 to 255 over 255 pixels; blended over white, green 255 shows alpha.
  on_every_kernel([](const EngineSetup& setup) {
    for (const float size : {1.0f, 300.0f}) {  // small triangles, and big ones
      Bench b(256, 8);
      b.put(Clear{kClearColour, rgba8(0, 0, 0), 1});
      b.put(upload_argb(b, {1, 1, {0xFFFFFFFFu}}, TextureFilter::kNearest));
      b.put(SetFragmentState{0, 0, BlendMode::kAlpha});
      for (std::uint32_t x = 0; x < 255; x += 51) {
        const float x0 = static_cast<float>(x), x1 = size > 1 ? 255 : x0 + 51;
        TexturedQuad q = image_over(size > 1 ? 0 : x0, 0, x1, 8);
        q.colour[0] = q.colour[3] = rgba8(size > 1 ? 0 : x, 255, 255, size > 1 ? 0 : x);
        q.colour[1] = q.colour[2] = rgba8(size > 1 ? 255 : x + 51, 255, 255, size > 1 ? 255 : x + 51);
        draw_quad(b, q);
        if (size > 1) break;
      }
      ASSERT_TRUE(b.run(setup).status.ok());
      for (std::uint32_t x = 0; x < 255; ++x) {
        const double alpha = x + 0.5;  // halfway: either neighbour
        ASSERT_NEAR(b.pixel(x, 4) >> 8 & 255, alpha, 0.51) << x;
        const std::uint32_t a = b.pixel(x, 4) >> 8 & 255;
        ASSERT_EQ(b.pixel(x, 4) >> 16 & 255, over_255(a * a)) << x << ": red is alpha, times alpha";
      }
    }
  });
}

TEST(Fragment, BlendingWeighsByAlphaWithoutATextureToo) {
  on_every_kernel([](const EngineSetup& setup) {
    Bench b(256, 1);
    b.put(Clear{kClearColour, rgba8(10, 200, 255), 1}).put(SetFragmentState{0, 0, BlendMode::kAlpha});
    for (std::uint32_t a = 0; a < 256; ++a) {
      const auto x = static_cast<float>(a);
      b.streams({{x, 0, 0}, {x + 2, 0, 0}, {x, 2, 0}}, {}, rgba8(250, 100, 3, a));
      b.put(SetScissor{a, 0, 1, 1}).draw(Topology::kTriangles, 3);
    }
    const auto report = b.run(setup);
    ASSERT_TRUE(report.status.ok());
    EXPECT_EQ(report.counters.pixels_blended, 256u);
    EXPECT_EQ(report.counters.texels_fetched, 0u);
    for (std::uint32_t a = 0; a < 256; ++a) {
      const auto mix = [a](std::uint32_t over, std::uint32_t under) { return over_255(over * a + under * (255 - a)); };
      ASSERT_EQ(b.pixel(a, 0), 0xFF000000u | mix(250, 10) << 16 | mix(100, 200) << 8 | mix(3, 255)) << a;
    }
  });
}

TEST(Fragment, LayersBlendInTheOrderTheyAreDrawn) {
  on_every_kernel([](const EngineSetup& setup) {
    Bench b(100, 100);
    b.put(Clear{kClearColour, rgba8(0, 0, 0), 1}).put(SetFragmentState{0, 0, BlendMode::kAlpha});
    std::uint32_t red = 0, green = 0;
    for (std::uint32_t i = 0; i < 50; ++i) {
      const bool is_red = i % 3 == 0;
      b.streams({{-1, -1, 0}, {300, -1, 0}, {-1, 300, 0}}, {}, is_red ? rgba8(255, 0, 0, 60) : rgba8(0, 255, 0, 30));
      b.draw(Topology::kTriangles, 3);
      const std::uint32_t a = is_red ? 60 : 30;
      red = over_255((is_red ? 255 * a : 0) + red * (255 - a));
      green = over_255((is_red ? 0 : 255 * a) + green * (255 - a));
    }
    ASSERT_TRUE(b.run(setup).status.ok());
    for (std::uint32_t i = 0; i < 100; ++i) ASSERT_EQ(b.pixel(i, 99 - i), 0xFF000000u | red << 16 | green << 8);
  });
}

TEST(Fragment, TheAlphaTestKeepsTheReferenceAndWhatIsAboveAndLeavesDepthAlone) {
  on_every_kernel([](const EngineSetup& setup) {
    Bench b(4, 1, PixelFormat::kXrgb8888, DepthFormat::kUnorm16);
    b.put(Clear{kClearColour | kClearDepth, rgba8(9, 9, 9), 1});
    SetRasterState raster;
    raster.depth_test = 1;
    b.put(raster);
    b.put(upload_argb(b, {4, 1, {0x00FFFFFFu, 0x7FFFFFFFu, 0x80FFFFFFu, 0xFFFFFFFFu}}, TextureFilter::kNearest));
    b.put(SetFragmentState{1, 128, BlendMode::kNone});
    draw_quad(b, image_over(0, 0, 4, 1));
    ASSERT_TRUE(b.run(setup).status.ok());
    for (const std::uint32_t x : {0u, 1u}) {
      EXPECT_EQ(b.pixel(x, 0), 0xFF090909u);
      EXPECT_EQ(b.depth(x, 0), 65535u);
    }
    for (const std::uint32_t x : {2u, 3u}) {
      EXPECT_EQ(b.pixel(x, 0), 0xFFFFFFFFu);
      EXPECT_EQ(b.depth(x, 0), 32768u);  // 0.5 * 65535, rounded up
    }
  });
}

TEST(Fragment, AlphaIsTexelTimesVertexForTheTestToo) {
  Bench b(1, 1);
  b.put(upload_argb(b, {1, 1, {0xC8FFFFFFu}}, TextureFilter::kNearest));  // 200 * 100 / 255 = 78.4
  for (const auto& [reference, drawn] : {std::pair{78u, true}, std::pair{79u, false}}) {
    Bench c = b;
    c.put(SetFragmentState{1, reference, BlendMode::kNone});
    draw_quad(c, coloured(image_over(0, 0, 1, 1), rgba8(255, 255, 255, 100)));
    ASSERT_TRUE(c.run().status.ok());
    EXPECT_EQ(c.pixel(0, 0) != 0, drawn) << reference;
  }
}

TEST(Fragment, WhatDepthHidesIsNeitherBlendedNorWritten) {
  on_every_kernel([](const EngineSetup& setup) {
    Bench b(8, 8, PixelFormat::kXrgb8888, DepthFormat::kUnorm24);
    b.put(Clear{kClearColour | kClearDepth, rgba8(0, 0, 0), 0.4f});
    SetRasterState raster;
    raster.depth_test = 1;
    raster.depth_write = 0;
    b.put(raster).put(SetFragmentState{0, 0, BlendMode::kAlpha});
    b.put(upload_argb(b, {1, 1, {0x80FFFFFFu}}, TextureFilter::kNearest));
    TexturedQuad behind = image_over(0, 0, 8, 8), before = image_over(0, 0, 4, 8);
    before.z = 0.25f;
    draw_quad(b, behind);
    draw_quad(b, before);
    const auto report = b.run(setup);
    ASSERT_TRUE(report.status.ok());
    EXPECT_EQ(b.pixel(6, 3), 0xFF000000u);
    EXPECT_EQ(b.pixel(2, 3), 0xFF808080u);
    EXPECT_EQ(b.depth(2, 3), 6710886u);  // 0.4 * 16777215: as cleared
    EXPECT_EQ(report.counters.texels_fetched, 64u + 32u) << "hidden pixels count too";
    EXPECT_EQ(report.counters.pixels_blended, 64u + 32u);
  });
}

TEST(Fragment, SixteenBitTargetsTakeTheNearestStep) {
  // Every channel value by the texel; then half of it blended over white.
  on_every_kernel([](const EngineSetup& setup) {
    TestImage ramp{256, 1, {}};
    for (std::uint32_t i = 0; i < 256; ++i) ramp.texels.push_back(0xFF000000u | i * 0x010101u);
    Bench b(256, 2, PixelFormat::kRgb565);
    b.put(Clear{kClearColour, rgba8(255, 255, 255), 1});
    b.put(upload_argb(b, ramp, TextureFilter::kNearest));
    draw_quad(b, image_over(0, 0, 256, 1));
    b.put(SetFragmentState{0, 0, BlendMode::kAlpha});
    draw_quad(b, coloured(image_over(0, 1, 256, 2), rgba8(255, 255, 255, 128)));
    ASSERT_TRUE(b.run(setup).status.ok());
    const auto step = [](std::uint32_t v, std::uint32_t most) { return (2 * v * most + 255) / 510; };
    for (std::uint32_t i = 0; i < 256; ++i) {
      ASSERT_EQ(b.pixel(i, 0), step(i, 31) << 11 | step(i, 63) << 5 | step(i, 31)) << i;
      const std::uint32_t half = over_255(i * 128 + 255 * 127);
      ASSERT_EQ(b.pixel(i, 1), step(half, 31) << 11 | step(half, 63) << 5 | step(half, 31)) << i;
    }
  });
}

TEST(Fragment, FlatShadingTakesColourAndAlphaOfTheLastVertex) {
  Bench b(8, 8);
  b.put(Clear{kClearColour, rgba8(0, 0, 0), 1}).put(SetFragmentState{0, 0, BlendMode::kAlpha});
  SetRasterState raster;
  raster.shade_model = ShadeModel::kFlat;
  b.put(raster);
  const std::vector<Rgba8> colours{rgba8(255, 0, 0, 10), rgba8(0, 255, 0, 90), rgba8(0, 0, 255, 51)};
  b.streams({{-1, -1, 0}, {30, -1, 0}, {-1, 30, 0}}, colours).draw(Topology::kTriangles, 3);
  ASSERT_TRUE(b.run().status.ok());
  for (std::uint32_t i = 0; i < 8; ++i) EXPECT_EQ(b.pixel(i, i), 0xFF000033u);
}

TEST(Fragment, WithEverythingOffAgainTheOldPathDrawsTheOldBytes) {
  const auto draw = [](bool detour) {
    Bench b(64, 64);
    if (detour) {
      b.put(upload_argb(b, {1, 1, {0xFFFFFFFFu}}, TextureFilter::kNearest));
      b.put(SetFragmentState{1, 3, BlendMode::kAlpha});
      b.put(SetTexture{}).put(SetFragmentState{});
    }
    b.streams({{1, 2, 0}, {60, 5, 0}, {20, 61, 0}}, {rgba8(255, 0, 9), rgba8(3, 255, 0), rgba8(0, 20, 255)});
    b.draw(Topology::kTriangles, 3);
    EXPECT_TRUE(b.run().status.ok());
    return b.vram();
  };
  EXPECT_TRUE(draw(true) == draw(false));
}

}  // namespace
}  // namespace usuzumi::gfx::test
