// Sampling: which texels a pixel gets, by hand calculations and by a reference in double precision.
#include <cmath>
#include <limits>

#include "tests/gfx_subsystem/engine_soft/texture_bench.h"

namespace usuzumi::gfx::test {
namespace {

/// Texel (x, y) is red x, green y.
TestImage numbered(std::uint32_t width, std::uint32_t height) {
  TestImage image{width, height, {}};
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) image.texels.push_back(0xFF000000u | x << 16 | y << 8);
  return image;
}

/// One row of grey texels.
TestImage greys(const std::vector<std::uint32_t>& values) {
  TestImage image{static_cast<std::uint32_t>(values.size()), 1, {}};
  for (const std::uint32_t v : values) image.texels.push_back(0xFF000000u | v * 0x010101u);
  return image;
}

TEST(Texture, AnImageOverAsManyPixelsComesOutTexelByTexel) {
  on_every_kernel([](const EngineSetup& setup) {
    for (const auto filter : {TextureFilter::kNearest, TextureFilter::kBilinear})
      for (const auto& [width, height] : {std::pair{8u, 8u}, std::pair{13u, 7u}, std::pair{1u, 9u}}) {
        Bench b(20, 16);
        const TestImage image = numbered(width, height);
        b.put(upload_argb(b, image, filter));
        draw_quad(b, image_over(3, 2, 3 + static_cast<float>(width), 2 + static_cast<float>(height)));
        const auto report = b.run(setup);
        ASSERT_TRUE(report.status.ok()) << report.status.message;
        for (std::uint32_t y = 0; y < height; ++y)
          for (std::uint32_t x = 0; x < width; ++x)
            ASSERT_EQ(b.pixel(3 + x, 2 + y), image.texels[y * width + x]) << x << ", " << y;
        EXPECT_EQ(b.covered(), width * height);
        EXPECT_EQ(report.counters.texels_fetched, width * height * (filter == TextureFilter::kNearest ? 1 : 4));
        EXPECT_EQ(report.counters.pixels_blended, 0u);
      }
  });
}

TEST(Texture, BilinearWeighsTheNearestTwoAlongEachAxis) {
  // Four texels a, b / c, d over 8 x 8 pixels: pixel i lies at texel (i + 0.5) / 4 - 0.5, so pixels 2 .. 5 have the
  // fractions 1/8, 3/8, 5/8, 7/8 of 256: 32, 96, 160, 224. Each axis rounds to whole channels.
  on_every_kernel([](const EngineSetup& setup) {
    Bench b(8, 8);
    b.put(upload_argb(b, {2, 2, {0xFF000000u, 0xFF0000FFu, 0xFF00FF00u, 0xFFFF0080u}}, TextureFilter::kBilinear));
    draw_quad(b, image_over(0, 0, 8, 8));
    ASSERT_TRUE(b.run(setup).status.ok());
    const auto mix = [](unsigned p, unsigned q, unsigned f) { return (p * (256 - f) + q * f + 128) / 256; };
    const unsigned fraction[8] = {0, 0, 32, 96, 160, 224, 256, 256};
    for (std::uint32_t y = 0; y < 8; ++y)
      for (std::uint32_t x = 0; x < 8; ++x) {
        const unsigned fx = fraction[x], fy = fraction[y];
        const unsigned red = mix(0, mix(0, 255, fx), fy), green = mix(0, mix(255, 0, fx), fy),
                       blue = mix(mix(0, 255, fx), mix(0, 128, fx), fy);
        ASSERT_EQ(b.pixel(x, y), 0xFF000000u | red << 16 | green << 8 | blue) << x << ", " << y;
      }
  });
}

TEST(Texture, EveryWrapModeGoesOnAsItsNameSays) {
  // Three texels 10, 20, 30, three pixels to each repeat of the image, from 2 repeats before it to 2 behind.
  const struct { TextureWrap wrap; std::vector<std::uint32_t> expected; } cases[] = {
      {TextureWrap::kRepeat, {10, 20, 30, 10, 20, 30, 10, 20, 30, 10, 20, 30, 10, 20, 30}},
      {TextureWrap::kClamp, {10, 10, 10, 10, 10, 10, 10, 20, 30, 30, 30, 30, 30, 30, 30}},
      {TextureWrap::kMirror, {10, 20, 30, 30, 20, 10, 10, 20, 30, 30, 20, 10, 10, 20, 30}}};
  on_every_kernel([&](const EngineSetup& setup) {
    for (const auto& c : cases)
      for (const bool along_t : {false, true})
        for (const auto filter : {TextureFilter::kNearest, TextureFilter::kBilinear}) {
          Bench b(15, 15);
          TestImage image = greys({10, 20, 30});
          if (along_t) std::swap(image.width, image.height);
          SetTexture t = upload_argb(b, image, filter);
          (along_t ? t.wrap_t : t.wrap_s) = c.wrap;
          b.put(t);
          draw_quad(b, image_part(0, 0, 15, 15, -2, 3));
          ASSERT_TRUE(b.run(setup).status.ok());
          for (std::uint32_t i = 0; i < 15; ++i)
            ASSERT_EQ(b.pixel(along_t ? 4 : i, along_t ? i : 4) & 0xFF, c.expected[i])
                << i << " wrap " << static_cast<int>(c.wrap) << " along t " << along_t;
        }
  });
}

TEST(Texture, BilinearAcrossTheImagesEdgeMixesWhatTheWrapModePutsThere) {
  // Texels 0, 200: at s = 0 exactly, halfway between the neighbours of the edge.
  const struct { TextureWrap wrap; std::uint32_t expected; } cases[] = {
      {TextureWrap::kRepeat, 100}, {TextureWrap::kClamp, 0}, {TextureWrap::kMirror, 0}};
  for (const auto& c : cases) {
    Bench b(1, 1);
    b.put(upload_argb(b, greys({0, 200}), TextureFilter::kBilinear, c.wrap));
    draw_quad(b, image_part(0, 0, 1, 1, -0.25f, 0.25f));
    ASSERT_TRUE(b.run().status.ok());
    EXPECT_EQ(b.pixel(0, 0) & 0xFF, c.expected);
  }
}

TEST(Texture, TenThousandRepeatsAwayTheImageIsStillThere) {
  on_every_kernel([](const EngineSetup& setup) {
    for (const auto wrap : {TextureWrap::kRepeat, TextureWrap::kMirror})
      for (const float far : {10000.0f, -10000.0f}) {
        Bench b(16, 16);
        b.put(upload_argb(b, numbered(16, 16), TextureFilter::kNearest, wrap));
        draw_quad(b, image_part(0, 0, 16, 16, far, far + 1));
        ASSERT_TRUE(b.run(setup).status.ok());
        for (std::uint32_t i = 0; i < 16; ++i) ASSERT_EQ(b.pixel(i, i), 0xFF000000u | i << 16 | i << 8) << far;
      }
  });
}

TEST(Texture, FarRepeatsAreAsFineAsTheFirst) {
  // At 10,000 a single's steps are 1/1024: two texels of this image, were they the pixel's.
  on_every_kernel([](const EngineSetup& setup) {
    TestImage image{2000, 1, {}};
    for (std::uint32_t x = 0; x < 2000; ++x) image.texels.push_back(0xFF000000u | x);
    for (const auto wrap : {TextureWrap::kRepeat, TextureWrap::kMirror}) {
      Bench b(2000, 1);
      b.put(upload_argb(b, image, TextureFilter::kNearest, wrap));
      draw_quad(b, image_part(0, 0, 2000, 1, 10000, 10001));
      ASSERT_TRUE(b.run(setup).status.ok());
      for (std::uint32_t x = 0; x < 2000; ++x) ASSERT_EQ(b.pixel(x, 0), 0xFF000000u | x);
    }
  });
}

TEST(Texture, CoordinatesThatAreNoNumbersOrTooLargeDrawTexelsOfTheImage) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
  on_every_kernel([&](const EngineSetup& setup) {
    for (const auto wrap : {TextureWrap::kRepeat, TextureWrap::kClamp, TextureWrap::kMirror})
      for (const auto filter : {TextureFilter::kNearest, TextureFilter::kBilinear})
        for (const float bad : {kNan, -kNan, kInfinity, -kInfinity, 3e38f, -3e38f}) {
          Bench b(16, 16);
          b.put(upload_argb(b, greys({70, 70, 70, 70, 70}), filter, wrap));
          TexturedQuad quad = image_over(0, 0, 16, 16);
          quad.st[1].s = quad.st[2].t = bad;
          draw_quad(b, quad);
          ASSERT_TRUE(b.run(setup).status.ok());
          for (std::uint32_t i = 0; i < 256; ++i) ASSERT_EQ(b.pixel(i % 16, i / 16), 0xFF464646u);
        }
  });
}

TEST(Texture, NotANumberIsZeroAndTheRestIsHeldAt65536) {
  Bench b(2, 1);
  b.put(upload_argb(b, numbered(8, 1), TextureFilter::kNearest));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  draw_quad(b, {0, 0, 1, 1, {{nan, 0}, {nan, 0}, {nan, 0}, {nan, 0}}});
  // One such corner is 0, and the others stay what they are: the image from right to left.
  Bench back(8, 1);
  back.put(upload_argb(back, numbered(8, 1), TextureFilter::kNearest));
  draw_quad(back, {0, 0, 8, 1, {{1, 0}, {nan, 0}, {nan, 0}, {1, 0}}});
  ASSERT_TRUE(back.run().status.ok());
  for (std::uint32_t x = 0; x < 8; ++x) EXPECT_EQ(back.pixel(x, 0), 0xFF000000u | (7 - x) << 16) << x;
  const float most = std::numeric_limits<float>::max();
  draw_quad(b, {1, 0, 2, 1, {{most, 0}, {most, 0}, {most, 0}, {most, 0}}});
  ASSERT_TRUE(b.run().status.ok());
  EXPECT_EQ(b.pixel(0, 0), 0xFF000000u);
  EXPECT_EQ(b.pixel(1, 0), 0xFF070000u);
}

TEST(Texture, FormatsOpenTheirChannelsAndOnlyArgbHasAlpha) {
  on_every_kernel([](const EngineSetup& setup) {
    Bench b(4, 2);
    // 16 bits: red 31, green 63, blue 31 alone, and 10-21-5; rows of 3 texels are padded to 8 bytes.
    const std::vector<std::uint16_t> narrow{0xF800, 0x07E0, 0x001F, 0xDEAD, 10u << 11 | 21u << 5 | 5u, 0, 0xFFFF, 0};
    b.put(SetTexture{TextureFormat::kRgb565, b.upload(narrow), 3, 2, 1, TextureFilter::kNearest, TextureWrap::kClamp,
                     TextureWrap::kClamp});
    b.put(SetFragmentState{1, 255, BlendMode::kAlpha});  // opaque texels pass and cover
    draw_quad(b, image_over(0, 0, 3, 2));
    b.put(SetTexture{TextureFormat::kXrgb8888, b.upload(std::vector<std::uint32_t>{0x00123456u}), 1, 1, 1});
    draw_quad(b, image_over(3, 0, 4, 1));
    b.put(SetTexture{TextureFormat::kArgb8888, b.upload(std::vector<std::uint32_t>{0xFE123456u}), 1, 1, 1});
    draw_quad(b, image_over(3, 1, 4, 2));
    ASSERT_TRUE(b.run(setup).status.ok());
    EXPECT_EQ(b.pixel(0, 0), 0xFFFF0000u);
    EXPECT_EQ(b.pixel(1, 0), 0xFF00FF00u);
    EXPECT_EQ(b.pixel(2, 0), 0xFF0000FFu);
    EXPECT_EQ(b.pixel(0, 1), 0xFF525529u);  // 10 -> 01010'010, 21 -> 010101'01, 5 -> 00101'001
    EXPECT_EQ(b.pixel(2, 1), 0xFFFFFFFFu);
    EXPECT_EQ(b.pixel(3, 0), 0xFF123456u);
    EXPECT_EQ(b.pixel(3, 1), 0u) << "alpha 254 is below 255";
  });
}

/// A 64 x 64 chain whose level i is one grey, 10 * (i + 1).
SetTexture upload_levels(Bench& b, TextureFilter filter, std::uint32_t levels = 7) {
  SetTexture t{TextureFormat::kXrgb8888, 0, 64, 64, levels, filter, TextureWrap::kRepeat, TextureWrap::kRepeat};
  std::vector<std::uint32_t> texels;
  for (std::uint32_t i = 0; i < levels; ++i)
    texels.insert(texels.end(), level_size(64, i) * level_size(64, i), 0x010101u * 10 * (i + 1));
  t.base = b.upload(texels);
  return t;
}

TEST(Texture, TheLevelIsTheNearestToTexelsPerPixelOnALogarithmicScale) {
  // rho texels a pixel along the longer axis; the level changes at rho = sqrt 2 * 2^i.
  const struct { float rho; std::uint32_t level; } cases[] = {{0.1f, 0}, {1, 0}, {1.40f, 0}, {1.42f, 1}, {2, 1},
                                                              {2.82f, 1}, {2.84f, 2}, {5.65f, 2}, {5.67f, 3},
                                                              {40, 5}, {64, 6}, {5000, 6}};
  on_every_kernel([&](const EngineSetup& setup) {
    for (const auto filter : {TextureFilter::kNearest, TextureFilter::kBilinear})
      for (const auto& c : cases)
        for (const bool down : {false, true}) {
          Bench b(8, 8);
          b.put(upload_levels(b, filter));
          const float s = c.rho * 8 / 64, small = s / 3;  // over 8 pixels
          const float sx = down ? small : s, ty = down ? s : small;
          draw_quad(b, {0, 0, 8, 8, {{0, 0}, {sx, 0}, {sx, ty}, {0, ty}}});
          ASSERT_TRUE(b.run(setup).status.ok());
          for (std::uint32_t i = 0; i < 8; ++i) ASSERT_EQ(b.pixel(i, 3) & 0xFF, 10 * (c.level + 1)) << c.rho;
        }
  });
}

TEST(Texture, LevelsThatAreNotThereAreNotTaken) {
  Bench b(8, 8);
  b.put(upload_levels(b, TextureFilter::kBilinear, 3));
  draw_quad(b, image_part(0, 0, 8, 8, 0, 8));
  ASSERT_TRUE(b.run().status.ok());
  EXPECT_EQ(b.pixel(4, 4) & 0xFF, 30u);
}

TEST(Texture, PerspectiveIsThatOfAReferenceInDoubles) {
  // Corners in clip space by the position (x, y, w): x_clip = x, y_clip = y, w_clip = w.
  constexpr std::uint32_t kWidth = 96, kHeight = 80;
  const Vec3 corners[4] = {{-3, -0.9f, 1}, {3, -0.9f, 1}, {3, 2.5f, 9}, {-3, 2.5f, 9}};
  const TexCoord st[4] = {{-1, 0.25f}, {2, 0.25f}, {2, 7.25f}, {-1, 7.25f}};
  const TestImage image = numbered(64, 48);
  on_every_kernel([&](const EngineSetup& setup) {
    Bench b(kWidth, kHeight);
    b.put(SetTransform{{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0}}});
    b.put(upload_argb(b, image, TextureFilter::kNearest, TextureWrap::kRepeat));
    SetVertexStreams s;
    s.vertex_count = 4;
    s.positions = b.upload(std::vector<Vec3>(corners, corners + 4));
    s.texture_coordinates = b.upload(std::vector<TexCoord>(st, st + 4));
    b.put(s).draw(Topology::kTriangleFan, 4);
    ASSERT_TRUE(b.run(setup).status.ok());
    // The quad is a plane: w = 1 + 8 k and y = -0.9 + 3.4 k with k = (t - 0.25) / 7, so k follows from the window's y.
    std::uint32_t compared = 0;
    for (std::uint32_t py = 0; py < kHeight; ++py)
      for (std::uint32_t px = 0; px < kWidth; ++px) {
        const double nx = (px + 0.5) / kWidth * 2 - 1, ny = 1 - (py + 0.5) / kHeight * 2;
        const double k = (ny + 0.9) / (3.4 - 8 * ny), w = 1 + 8 * k, x = nx * w;
        if (k <= 0 || k >= 1 || x <= -3 || x >= 3) continue;
        const double u = ((x + 3) / 6 * 3 - 1) * 64, v = (k * 7 + 0.25) * 48;
        const double fu = u - std::floor(u), fv = v - std::floor(v);
        // Corners are snapped to 1/256 pixel: next to a texel's edge the neighbour may be right.
        const double margin = 0.03 * w;
        if (fu < margin || fu > 1 - margin || fv < margin * w || fv > 1 - margin * w) continue;
        const auto turned = [](double at, int size) {
          return static_cast<std::uint32_t>((static_cast<int>(std::floor(at)) % size + size) % size);
        };
        ASSERT_EQ(b.pixel(px, py), 0xFF000000u | turned(u, 64) << 16 | turned(v, 48) << 8) << px << ", " << py;
        ++compared;
      }
    EXPECT_GT(compared, 1500u);
  });
}

TEST(Texture, PointsHaveTheirVertexsTexelAndLinesRunAlongTheImage) {
  on_every_kernel([](const EngineSetup& setup) {
    Bench b(16, 8);
    b.put(upload_argb(b, numbered(8, 8), TextureFilter::kNearest));
    SetRasterState raster;
    raster.point_size = 4;
    b.put(raster);
    SetVertexStreams s;
    s.vertex_count = 3;
    s.positions = b.upload(std::vector<Vec3>{{2, 6, 0}, {4, 1.5f, 0}, {12, 1.5f, 0}});
    s.texture_coordinates = b.upload(std::vector<TexCoord>{{0.3f, 0.8f}, {0, 0.5f}, {1, 0.5f}});
    b.put(s).draw(Topology::kPoints, 1).draw(Topology::kLines, 2, 1);
    ASSERT_TRUE(b.run(setup).status.ok());
    for (std::uint32_t i = 0; i < 16; ++i) EXPECT_EQ(b.pixel(i % 4, 4 + i / 4), 0xFF020600u);
    for (std::uint32_t i = 0; i < 8; ++i) EXPECT_EQ(b.pixel(4 + i, 1), 0xFF000400u | i << 16);
    EXPECT_EQ(b.covered(), 24u);
  });
}

TEST(Texture, ClippingKeepsCoordinatesWhereTheyWere) {
  // The same triangles, whole and with corners behind the near plane or beyond the guard band: what both show is the
  // same but for the rounding of the cut.
  const TestImage image = numbered(32, 32);
  const auto draw = [&](float reach) {
    Bench b(64, 64);
    b.put(upload_argb(b, image, TextureFilter::kBilinear, TextureWrap::kMirror));
    const float a = 0.5f - reach, e = 0.5f + reach;  // the image is the target
    draw_quad(b, {64 * a, 64 * a, 64 * e, 64 * e, {{a, a}, {e, a}, {e, e}, {a, e}}});
    EXPECT_TRUE(b.run().status.ok());
    return b;
  };
  const Bench near = draw(0.5f), far = draw(300);  // 38,400 pixels: cut at the guard band
  for (std::uint32_t y = 0; y < 64; ++y)
    for (std::uint32_t x = 0; x < 64; ++x)
      for (const unsigned shift : {0u, 8u, 16u})
        ASSERT_NEAR(static_cast<double>(near.pixel(x, y) >> shift & 255),
                    static_cast<double>(far.pixel(x, y) >> shift & 255), 1)
            << x << ", " << y;
}

}  // namespace
}  // namespace usuzumi::gfx::test
