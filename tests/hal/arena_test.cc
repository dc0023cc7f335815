#include "hal/arena.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>

namespace usuzumi {
namespace {

struct ArenaTest : ::testing::Test {
  alignas(64) std::byte memory[256]{};
  Arena arena{std::span<std::byte>(memory)};
};

TEST_F(ArenaTest, HandsOutMemoryInOrderWithoutOverlap) {
  const auto a = arena.allocate<std::uint32_t>(4);
  const auto b = arena.allocate<std::uint32_t>(2);
  EXPECT_EQ(static_cast<void*>(a.data()), memory);
  EXPECT_EQ(static_cast<void*>(b.data()), memory + 16);
  EXPECT_EQ(a.size(), 4u);
  EXPECT_EQ(b.size(), 2u);
  EXPECT_EQ(arena.used(), 24u);
  EXPECT_EQ(arena.available(), 232u);
}

TEST_F(ArenaTest, PadsToTheTypesAlignment) {
  (void)arena.allocate<std::uint8_t>(1);
  const auto wide = arena.allocate<std::uint64_t>(1);
  EXPECT_EQ(static_cast<void*>(wide.data()), memory + 8);
  const auto line = arena.allocate<std::uint8_t>(1, 64);
  EXPECT_EQ(static_cast<void*>(line.data()), memory + 64);
}

TEST_F(ArenaTest, PadsByAddressWhenItsOwnMemoryIsUnaligned) {
  Arena odd(std::span<std::byte>(memory + 1, 20));
  const auto word = odd.allocate<std::uint32_t>(4);
  EXPECT_EQ(static_cast<void*>(word.data()), memory + 4);
  EXPECT_EQ(odd.allocate<std::uint32_t>(1).data(), nullptr) << "1 byte is left after 3 of padding and 16 taken";
}

TEST_F(ArenaTest, FillsToTheLastByteAndNotBeyond) {
  EXPECT_NE(arena.allocate<std::uint8_t>(256).data(), nullptr);
  EXPECT_EQ(arena.available(), 0u);
  const auto more = arena.allocate<std::uint8_t>(1);
  EXPECT_EQ(more.data(), nullptr);
  EXPECT_EQ(more.size(), 0u);
}

TEST_F(ArenaTest, RefusesCountsWhoseBytesOverflow) {
  EXPECT_EQ(arena.allocate<std::uint64_t>(std::numeric_limits<std::size_t>::max() / 4).data(), nullptr);
  EXPECT_EQ(arena.allocate<std::uint64_t>(std::numeric_limits<std::size_t>::max()).data(), nullptr);
  EXPECT_EQ(arena.allocate<std::uint64_t>((std::size_t{1} << 61) + 1).data(), nullptr) << "2^64 + 8 bytes are not 8";
  EXPECT_EQ(arena.used(), 0u) << "a refused allocation takes nothing";
}

TEST_F(ArenaTest, RefusesWhenNotEvenThePaddingFits) {
  Arena odd(std::span<std::byte>(memory, 255));
  (void)odd.allocate<std::uint8_t>(255);
  EXPECT_EQ(odd.allocate<std::uint64_t>(1).data(), nullptr);
  EXPECT_EQ(odd.used(), 255u);
}

TEST_F(ArenaTest, ZeroObjectsSucceedEvenWhenFull) {
  (void)arena.allocate<std::uint8_t>(256);
  EXPECT_NE(arena.allocate<std::uint8_t>(0).data(), nullptr);
  EXPECT_EQ(Arena().allocate<std::uint8_t>(0).data(), nullptr) << "an arena of no memory has no address to give";
}

TEST_F(ArenaTest, RewindsToAMarkAndKeepsTheHighWater) {
  (void)arena.allocate<std::uint8_t>(10);
  const std::size_t mark = arena.used();
  (void)arena.allocate<std::uint8_t>(100);
  arena.rewind(mark);
  EXPECT_EQ(arena.used(), 10u);
  EXPECT_EQ(arena.high_water(), 110u);
  arena.rewind(50);  // ahead of used(): nothing to give back
  EXPECT_EQ(arena.used(), 10u);
  (void)arena.allocate<std::uint8_t>(20);
  EXPECT_EQ(arena.high_water(), 110u) << "30 bytes in use are no new height";
  arena.reset();
  EXPECT_EQ(arena.used(), 0u);
  EXPECT_EQ(arena.high_water(), 110u);
}

TEST_F(ArenaTest, ScratchScopesRewindInTheReverseOfTheirOrder) {
  (void)arena.allocate<std::uint8_t>(8);
  {
    const ScratchScope outer(arena);
    (void)arena.allocate<std::uint8_t>(16);
    {
      const ScratchScope inner(arena);
      (void)arena.allocate<std::uint8_t>(32);
      EXPECT_EQ(arena.used(), 56u);
    }
    EXPECT_EQ(arena.used(), 24u);
  }
  EXPECT_EQ(arena.used(), 8u);
  EXPECT_EQ(arena.high_water(), 56u);
}

}  // namespace
}  // namespace usuzumi
