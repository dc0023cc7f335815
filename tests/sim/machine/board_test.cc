#include "sim/machine/board.h"

#include <gtest/gtest.h>

#include "sim/machine/address_map.h"

namespace usuzumi::sim {
namespace {

TEST(Board, IsFoundByItsName) {
  ASSERT_NE(find_board("host-sim"), nullptr);
  ASSERT_NE(find_board("small"), nullptr);
  EXPECT_EQ(find_board("host-sim")->ram_bytes, 536870912u);
  EXPECT_EQ(find_board("Host-Sim"), nullptr);
  EXPECT_EQ(find_board(""), nullptr);
  EXPECT_EQ(boards().size(), 5u);
}

TEST(Board, SmallBoardIsTheOneOfTheContract) {
  const BoardDescription& b = small_board();
  EXPECT_EQ(b.ram_bytes, 2097152u);
  EXPECT_EQ(b.vram_bytes, 1048576u);
  EXPECT_EQ(b.width, 480u);
  EXPECT_EQ(b.height, 272u);
  EXPECT_EQ(b.pixel_format, command::PixelFormat::kRgb565);
  EXPECT_EQ(b.depth_format, command::DepthFormat::kUnorm16);
}

TEST(Board, EveryBoardHoldsTwoPicturesAndDepth) {
  for (const BoardDescription& b : boards()) {
    const std::size_t pixels = std::size_t{b.width} * b.height;
    const std::size_t need =
        pixels * (2 * command::bytes_per_pixel(b.pixel_format) + command::bytes_per_depth(b.depth_format));
    EXPECT_LE(need, b.vram_bytes) << b.name;
    EXPECT_LE(b.ram_bytes, kRamBytesMax) << b.name;
    EXPECT_LE(b.vram_bytes, kVramBytesMax) << b.name;
  }
}

TEST(Board, EveryBusFeedsOneLayerAtSixtyFrames) {
  for (const BoardDescription& b : boards())
    EXPECT_GE(b.bus_bytes_per_second, std::uint64_t{60} * b.width * b.height * command::bytes_per_pixel(b.pixel_format))
        << b.name;
}

TEST(AddressMap, LeavesEachMemoryTheRoomOfThePage) {
  EXPECT_EQ(kRomBytesMax, 0x40000000u);
  EXPECT_EQ(kRamBytesMax, 0x30000000u);
  EXPECT_EQ(kVramBytesMax, 0x70000000u);
}

TEST(AddressMap, CyclesAreTwoAndAHalfNanoseconds) {
  EXPECT_EQ(ns_from_cycles(0), 0u);
  EXPECT_EQ(ns_from_cycles(1), 2u);
  EXPECT_EQ(ns_from_cycles(2), 5u);
  EXPECT_EQ(ns_from_cycles(400'000'000), 1'000'000'000u);
  EXPECT_EQ(ns_from_cycles(400'000'000ull * 86400 * 365 * 500), 1'000'000'000ull * 86400 * 365 * 500);
  EXPECT_EQ(cycles_from_us(1), 400u);
}

}  // namespace
}  // namespace usuzumi::sim
