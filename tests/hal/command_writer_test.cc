// The words that command::Writer puts into a list, restated as literals.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>

#include "hal/command_list.h"

namespace usuzumi::command {
namespace {

TEST(CommandWriter, PayloadsHaveTheLengthsOfThePage) {
  EXPECT_EQ(kPayloadWords<SetColourTarget>, 5u);
  EXPECT_EQ(kPayloadWords<SetDepthTarget>, 3u);
  EXPECT_EQ(kPayloadWords<SetScissor>, 4u);
  EXPECT_EQ(kPayloadWords<SetViewport>, 6u);
  EXPECT_EQ(kPayloadWords<SetTransform>, 16u);
  EXPECT_EQ(kPayloadWords<SetLight>, 10u);
  EXPECT_EQ(kPayloadWords<SetRasterState>, 8u);
  EXPECT_EQ(kPayloadWords<SetVertexStreams>, 10u);
  EXPECT_EQ(kPayloadWords<Clear>, 3u);
  EXPECT_EQ(kPayloadWords<Draw>, 5u);
}

TEST(CommandWriter, WritesPacketsAsTheEngineReadsThem) {
  std::array<std::uint32_t, 32> words{};
  Writer writer(words);
  writer.put(SetColourTarget{0x80000000u, 1920, 480, 272, PixelFormat::kXrgb8888});
  writer.put(Clear{kClearColour | kClearDepth, rgba8(1, 2, 3), 1.0f});
  writer.put(Draw{Topology::kTriangleStrip, IndexFormat::kU16, 0x50001000u, 2, 7});
  const auto list = writer.finish();
  ASSERT_TRUE(list.ok());
  const std::array<std::uint32_t, 17> expected{
      0x01000005u, 0x80000000u, 1920,        480,         272, 1,  // target
      0x10000003u, 3,           0xFF030201u, 0x3F800000u,          // clear: colour and depth, 1.0
      0x11000005u, 3,           1,           0x50001000u, 2,   7,  // draw
      0x00000000u};                                                // end
  ASSERT_EQ(list->size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ((*list)[i], expected[i]) << "word " << i;
}

TEST(CommandWriter, KeepsOneWordForTheEnd) {
  std::array<std::uint32_t, 5> exact{};  // one clear and the end
  Writer fits(exact);
  fits.put(Clear{});
  EXPECT_TRUE(fits.finish().ok());
  std::array<std::uint32_t, 4> short_by_one{};
  Writer full(short_by_one);
  full.put(Clear{});
  const auto list = full.finish();
  ASSERT_FALSE(list.ok());
  EXPECT_EQ(list.status().code, StatusCode::kResourceExhausted);
  EXPECT_EQ(list.status().where, 4u);
}

TEST(CommandWriter, LeavesOutEverythingAfterWhatDidNotFit) {
  std::array<std::uint32_t, 8> words{};
  Writer writer(words);
  writer.put(SetTransform{});  // 17 words
  writer.put(Clear{});         // would fit, but a list with a hole draws a wrong picture
  EXPECT_FALSE(writer.finish().ok());
  for (const std::uint32_t word : words) EXPECT_EQ(word, 0u);
}

TEST(CommandWriter, EmptyListHasOnlyAnEnd) {
  std::array<std::uint32_t, 1> words{7};
  const auto list = Writer(words).finish();
  ASSERT_TRUE(list.ok());
  EXPECT_EQ(list->size(), 1u);
  EXPECT_EQ(words[0], 0u);
  EXPECT_FALSE(Writer(std::span<std::uint32_t>()).finish().ok());
}

TEST(CommandWriter, AnEndedListCannotBeEndedAgainWhenFull) {
  std::array<std::uint32_t, 1> words{};
  Writer writer(words);
  EXPECT_TRUE(writer.finish().ok());
  EXPECT_FALSE(writer.finish().ok());
}

}  // namespace
}  // namespace usuzumi::command
