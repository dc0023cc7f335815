// Textures, alpha test and blending on OSMesa, against values worked out by hand.
#include <gtest/gtest.h>

#include "tests/gfx_subsystem/engine_osmesa/osmesa_test_bench.h"

namespace usuzumi::gfx {
namespace {

constexpr std::uint32_t kRed = 0xFFFF0000u, kGreen = 0xFF00FF00u, kBlue = 0xFF0000FFu, kGrey = 0xFF808080u;

/// Covers [x, x + width) x [0, 4) with coordinates from 0 to `repeats`.
void textured_rectangle(Bench& bench, float x, float width, float repeats, Rgba8 colour = {}) {
  SetVertexStreams s;
  s.vertex_count = 4;
  s.positions =
      bench.store<Vec3>({{x, 0, 0.5f}, {x, 4, 0.5f}, {x + width, 0, 0.5f}, {x + width, 4, 0.5f}});
  s.texture_coordinates = bench.store<TexCoord>({{0, 0}, {0, repeats}, {repeats, 0}, {repeats, repeats}});
  s.constant_colour = colour;
  bench.put(s);
  bench.put(Draw{Topology::kTriangleStrip, IndexFormat::kNone, 0, 0, 4});
}

SetTexture two_by_two(Bench& bench, TextureWrap wrap = TextureWrap::kRepeat) {
  return {TextureFormat::kArgb8888, bench.store<std::uint32_t>({kRed, kGreen, kBlue, kGrey}), 2, 2, 1,
          TextureFilter::kNearest, wrap, wrap};
}

TEST(OsmesaTexture, TheImagesTopRowIsAtTheTopAndCountsItsTexels) {
  Bench bench;
  bench.set_pixel_transform();
  bench.put(two_by_two(bench));
  textured_rectangle(bench, 0, 4, 1);
  const ExecutionReport report = bench.run();
  ASSERT_TRUE(report.status.ok()) << report.status.message;
  EXPECT_EQ(bench.pixel(0, 0), kRed);
  EXPECT_EQ(bench.pixel(3, 0), kGreen);
  EXPECT_EQ(bench.pixel(0, 3), kBlue);
  EXPECT_EQ(bench.pixel(3, 3), kGrey);
  EXPECT_EQ(report.counters.texels_fetched, 16u);
}

TEST(OsmesaTexture, WrapModesGoOnAsTheirNamesSay) {
  const struct { TextureWrap wrap; std::uint32_t expected[4]; } cases[] = {
      {TextureWrap::kRepeat, {kRed, kGreen, kRed, kGreen}},
      {TextureWrap::kClamp, {kRed, kGreen, kGreen, kGreen}},
      {TextureWrap::kMirror, {kRed, kGreen, kGreen, kRed}}};
  for (const auto& c : cases) {
    Bench bench;
    bench.set_pixel_transform();
    bench.put(two_by_two(bench, c.wrap));
    textured_rectangle(bench, 0, 4, 2);
    ASSERT_TRUE(bench.run().status.ok());
    for (std::uint32_t x = 0; x < 4; ++x) EXPECT_EQ(bench.pixel(x, 0), c.expected[x]) << x;
  }
}

TEST(OsmesaTexture, LevelsAreTakenBySizeOnTheScreen) {
  Bench bench;
  bench.set_pixel_transform();
  std::vector<std::uint32_t> texels(64, kRed);                // 8 x 8
  texels.insert(texels.end(), 16, kGreen);                    // 4 x 4
  texels.insert(texels.end(), 4, kBlue);                      // 2 x 2
  bench.put(SetTexture{TextureFormat::kXrgb8888, bench.store(texels), 8, 8, 3, TextureFilter::kBilinear,
                       TextureWrap::kRepeat, TextureWrap::kRepeat});
  textured_rectangle(bench, 0, 4, 0.5f);
  textured_rectangle(bench, 4, 4, 1);
  textured_rectangle(bench, 8, 4, 8);
  ASSERT_TRUE(bench.run().status.ok());
  EXPECT_EQ(bench.pixel(2, 2), kRed);
  EXPECT_EQ(bench.pixel(6, 2), kGreen);
  EXPECT_EQ(bench.pixel(10, 2), kBlue);
}

TEST(OsmesaTexture, TexelsThatChangeBetweenListsAreSeen) {
  Bench bench;
  bench.set_pixel_transform();
  const SetTexture texture = two_by_two(bench);
  bench.put(texture);
  textured_rectangle(bench, 0, 4, 1);
  ASSERT_TRUE(bench.run().status.ok());
  std::memcpy(bench.memory.ram().data() + (texture.base - SceneMemory::kRamBase), &kBlue, 4);
  bench.begin();
  bench.set_pixel_transform();
  bench.put(texture);
  textured_rectangle(bench, 0, 4, 1);
  ASSERT_TRUE(bench.run().status.ok());
  EXPECT_EQ(bench.pixel(0, 0), kBlue);
}

TEST(OsmesaTexture, TheAlphaTestLeavesColourAndDepthAndCountsAll) {
  Bench bench(PixelFormat::kXrgb8888, DepthFormat::kUnorm16);
  bench.set_pixel_transform();
  bench.put(Clear{kClearColour | kClearDepth, rgba8(0, 0, 255), 1});
  SetRasterState raster;
  raster.depth_test = 1;
  bench.put(raster);
  bench.put(SetTexture{TextureFormat::kArgb8888, bench.store<std::uint32_t>({0x7FFFFFFFu, 0x80FFFFFFu}), 2, 1, 1,
                       TextureFilter::kNearest, TextureWrap::kClamp, TextureWrap::kClamp});
  bench.put(SetFragmentState{1, 128, BlendMode::kNone});
  textured_rectangle(bench, 0, 4, 1);
  const ExecutionReport report = bench.run();
  ASSERT_TRUE(report.status.ok());
  EXPECT_EQ(bench.pixel(1, 1), kBlue);
  EXPECT_EQ(bench.depth_at(1, 1), 0xFFFFu);
  EXPECT_EQ(bench.pixel(2, 1), 0xFFFFFFFFu);
  EXPECT_EQ(bench.depth_at(2, 1), 0x8000u);
  EXPECT_EQ(report.counters.pixels_tested, 16u);
}

TEST(OsmesaTexture, BlendingWeighsByAlphaAndKeepsTheTopByte) {
  Bench bench;
  bench.set_pixel_transform();
  bench.put(Clear{kClearColour, rgba8(200, 100, 0), 1});
  bench.put(SetFragmentState{0, 0, BlendMode::kAlpha});
  bench.rectangle(0, 0, 4, 4, 0.5f, rgba8(0, 200, 255, 51));  // a fifth
  const ExecutionReport report = bench.run();
  ASSERT_TRUE(report.status.ok());
  EXPECT_EQ(bench.pixel(1, 1), 0xFF000000u | 160u << 16 | 120u << 8 | 51u);
  EXPECT_EQ(report.counters.pixels_blended, 16u);
  EXPECT_EQ(report.counters.texels_fetched, 0u);
}

}  // namespace
}  // namespace usuzumi::gfx
