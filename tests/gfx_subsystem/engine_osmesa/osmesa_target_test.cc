// Targets in VRAM: formats, strides, what is loaded before and what is stored after.
#include <gtest/gtest.h>

#include "tests/gfx_subsystem/engine_osmesa/osmesa_test_bench.h"

namespace usuzumi::gfx {
namespace {

TEST(OsmesaTarget, ClearWritesOnesAboveTheColour) {
  Bench bench;
  bench.put(Clear{kClearColour, rgba8(0x12, 0x34, 0x56, 0x78), 1});
  const ExecutionReport report = bench.run();
  ASSERT_TRUE(report.status.ok()) << report.status.message;
  EXPECT_EQ(bench.count_pixels(0xFF123456u), 16u * 12u);
  EXPECT_EQ(report.counters.pixels_cleared, 16u * 12u);
}

TEST(OsmesaTarget, Rgb565RoundsToTheNearestStep) {
  Bench bench(PixelFormat::kRgb565);
  // 200 * 31 / 255 = 24.3, 100 * 63 / 255 = 24.7, 30 * 31 / 255 = 3.6
  bench.put(Clear{kClearColour, rgba8(200, 100, 30), 1});
  ASSERT_TRUE(bench.run().status.ok());
  EXPECT_EQ(bench.count_pixels(24u << 11 | 25u << 5 | 4u), 16u * 12u);
}

TEST(OsmesaTarget, WhatIsNotDrawnKeepsEveryBit) {
  for (const PixelFormat format : {PixelFormat::kXrgb8888, PixelFormat::kRgb565}) {
    Bench bench(format, DepthFormat::kUnorm24, 12);
    for (std::size_t i = 0; i < bench.memory.vram().size(); ++i)
      bench.memory.vram()[i] = static_cast<std::byte>(i * 37 + (i >> 8));
    const std::vector<std::byte> before(bench.memory.vram().begin(), bench.memory.vram().end());
    bench.put(SetScissor{3, 2, 5, 4});
    bench.put(Clear{kClearColour | kClearDepth, rgba8(255, 0, 0), 0.5f});
    bench.set_pixel_transform();
    SetRasterState raster;
    raster.depth_test = 1;
    bench.put(raster);
    bench.rectangle(0, 0, 16, 12, 0.25f, rgba8(0, 255, 0));
    ASSERT_TRUE(bench.run().status.ok());
    const std::uint32_t size = bytes_per_pixel(format);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const auto in_scissor = [i](std::size_t plane, std::uint32_t stride, std::uint32_t bytes) {
        if (i < plane || i - plane >= std::size_t{stride} * 12) return false;
        const std::size_t y = (i - plane) / stride, x = (i - plane) % stride / bytes;
        return x >= 3 && x < 8 && y >= 2 && y < 6;
      };
      if (in_scissor(0, bench.colour.stride_bytes, size) ||
          in_scissor(Bench::kDepthOffset, bench.depth.stride_bytes, 4))
        continue;
      ASSERT_EQ(bench.memory.vram()[i], before[i]) << "byte " << i << " of VRAM";
    }
    EXPECT_EQ(bench.pixel(3, 2), format == PixelFormat::kRgb565 ? 0x07E0u : 0xFF00FF00u);
    EXPECT_EQ(bench.pixel(7, 5), format == PixelFormat::kRgb565 ? 0x07E0u : 0xFF00FF00u);
    EXPECT_EQ(bench.depth_at(3, 2), 4194304u);  // floor(0.25 * 16777215 + 0.5)
  }
}

TEST(OsmesaTarget, DepthsAreStoredAsTheContractRounds) {
  struct Case {
    DepthFormat format;
    float depth;
    std::uint32_t stored;
  };
  // floor(d * 65535 + 0.5), floor(d * 16777215 + 0.5)
  const Case cases[] = {{DepthFormat::kUnorm16, 0.5f, 32768},
                        {DepthFormat::kUnorm16, 0.25f, 16384},
                        {DepthFormat::kUnorm16, 1, 65535},
                        {DepthFormat::kUnorm24, 0.5f, 8388608},
                        {DepthFormat::kUnorm24, 0.75f, 12582911},
                        {DepthFormat::kUnorm24, 1, 16777215},
                        {DepthFormat::kUnorm24, 0, 0}};
  for (const Case& c : cases) {
    Bench bench(PixelFormat::kXrgb8888, c.format);
    bench.put(Clear{kClearDepth, {}, c.depth});
    ASSERT_TRUE(bench.run().status.ok());
    EXPECT_EQ(bench.depth_at(0, 0), c.stored) << "clear to " << c.depth;
    if (c.depth >= 1) continue;
    bench.begin();
    bench.put(Clear{kClearDepth, {}, 1});
    bench.set_pixel_transform();
    SetRasterState raster;
    raster.depth_test = 1;
    bench.put(raster);
    bench.rectangle(0, 0, 16, 12, c.depth, {});
    ASSERT_TRUE(bench.run().status.ok());
    EXPECT_NEAR(bench.depth_at(5, 5), c.stored, 1) << "rectangle at " << c.depth;
  }
}

TEST(OsmesaTarget, DepthsInVramHideWhatLiesBehindThem) {
  for (const DepthFormat format : {DepthFormat::kUnorm16, DepthFormat::kUnorm24}) {
    const std::uint32_t one = format == DepthFormat::kUnorm16 ? 65535 : 16777215;
    Bench bench(PixelFormat::kXrgb8888, format, 8);
    for (std::uint32_t y = 0; y < Bench::kHeight; ++y)
      for (std::uint32_t x = 0; x < Bench::kWidth; ++x) bench.set_depth(x, y, x < 5 ? one / 4 : one - x);
    bench.set_pixel_transform();
    SetRasterState raster;
    raster.depth_test = 1;
    bench.put(raster);
    bench.rectangle(0, 0, 16, 12, 0.5f, rgba8(255, 255, 255));
    const ExecutionReport report = bench.run();
    ASSERT_TRUE(report.status.ok());
    EXPECT_EQ(bench.pixel(4, 7), 0u);
    EXPECT_EQ(bench.pixel(5, 7), 0xFFFFFFFFu);
    EXPECT_EQ(bench.depth_at(4, 7), one / 4);
    EXPECT_NEAR(bench.depth_at(5, 7), one / 2, 1);
    EXPECT_EQ(report.counters.pixels_tested, 16u * 12u) << "hidden pixels count too";
  }
}

TEST(OsmesaTarget, ListMayDrawIntoSeveralTargets) {
  Bench bench;
  SetColourTarget second = bench.colour;
  second.base += 0x2000;
  second.format = PixelFormat::kRgb565;
  bench.put(Clear{kClearColour, rgba8(1, 2, 3), 1});
  bench.put(second);
  bench.put(Clear{kClearColour, rgba8(255, 255, 255), 1});
  bench.put(bench.colour);
  bench.set_pixel_transform();
  bench.rectangle(2, 2, 1, 1, 0.5f, rgba8(7, 7, 7));
  ASSERT_TRUE(bench.run().status.ok());
  EXPECT_EQ(bench.pixel(2, 2), 0xFF070707u);
  EXPECT_EQ(bench.count_pixels(0xFF010203u), 16u * 12u - 1);
  std::uint16_t v = 0;
  std::memcpy(&v, bench.memory.vram().data() + 0x2000 + 11 * second.stride_bytes + 15 * 2, 2);
  EXPECT_EQ(v, 0xFFFF);
}

TEST(OsmesaTarget, ChangeOfTheCpuBetweenListsIsSeen) {
  Bench bench;
  bench.put(Clear{kClearColour, rgba8(1, 2, 3), 1});
  ASSERT_TRUE(bench.run().status.ok());
  std::memset(bench.memory.vram().data(), 0x44, 4);
  bench.begin();
  bench.set_pixel_transform();
  bench.rectangle(5, 5, 1, 1, 0.5f, rgba8(7, 7, 7));
  ASSERT_TRUE(bench.run().status.ok());
  EXPECT_EQ(bench.pixel(0, 0), 0x44444444u);
}

TEST(OsmesaTarget, FaultStopsTheListAndKeepsWhatWasDrawn) {
  Bench bench;
  bench.put(Clear{kClearColour, rgba8(1, 2, 3), 1});
  const auto fault_at = static_cast<std::uint32_t>(bench.words.size());
  bench.words.push_back(0x7F000000u);
  bench.put(Clear{kClearColour, rgba8(9, 9, 9), 1});
  const ExecutionReport report = bench.run();
  EXPECT_EQ(report.status.code, StatusCode::kUnsupported);
  EXPECT_EQ(report.status.where, fault_at);
  EXPECT_EQ(bench.count_pixels(0xFF010203u), 16u * 12u);
}

}  // namespace
}  // namespace usuzumi::gfx
