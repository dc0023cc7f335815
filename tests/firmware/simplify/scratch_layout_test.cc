// What a list of arrays takes, and where each lies.
#include "firmware/simplify/scratch_layout.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace usuzumi::testing {
namespace {

using firmware::ScratchLayout;

struct Arrays {
  std::span<std::uint8_t> bytes;
  std::span<std::uint32_t> table;
  std::span<std::uint64_t> words;

  auto list(std::uint64_t table_entries) {
    return [this, table_entries](ScratchLayout& layout) {
      layout.array(bytes, 5);
      layout.array_under_the_rest(table, table_entries);
      layout.array(words, 3);
    };
  }
};

TEST(ScratchLayout, CountsEveryArrayUpToItsAlignmentAndThoseThatShareOnce) {
  Arrays arrays;
  EXPECT_EQ(firmware::layout_bytes(16, arrays.list(0)), 16u + 16 + 32);
  EXPECT_EQ(firmware::layout_bytes(16, arrays.list(8)), 16u + 16 + 32);
  EXPECT_EQ(firmware::layout_bytes(16, arrays.list(9)), 16u + 16 + 36) << "the table is the longer";
  EXPECT_EQ(firmware::layout_bytes(64, arrays.list(9)), 64u + 64 + 64);
  EXPECT_EQ(firmware::layout_bytes(16, arrays.list(0xFFFFFFFF)), 16u + 16 + 0x3FFFFFFFC) << "more than 32 bits hold";
  EXPECT_EQ(arrays.words.data(), nullptr) << "what is counted is not carved";
}

TEST(ScratchLayout, CarvesWhatItCountsFromWhereverTheArenaStands) {
  alignas(64) std::array<std::byte, 256> memory;
  for (const std::size_t start : {0u, 1u, 16u, 17u, 63u}) {
    Arena arena(memory);
    (void)arena.allocate<std::byte>(start);
    const auto first = static_cast<std::ptrdiff_t>((start + 15) / 16 * 16);
    Arrays arrays;
    ASSERT_TRUE(firmware::carve_layout(arena, 16, arrays.list(9))) << start;
    const auto at = [&](const void* p) { return static_cast<const std::byte*>(p) - memory.data(); };
    EXPECT_EQ(at(arrays.bytes.data()), first);
    EXPECT_EQ(at(arrays.table.data()), first + 16);
    EXPECT_EQ(at(arrays.words.data()), first + 16);
    EXPECT_EQ(arrays.bytes.size(), 5u);
    EXPECT_EQ(arrays.table.size(), 9u);
    EXPECT_EQ(arrays.words.size(), 3u);
    EXPECT_EQ(static_cast<std::ptrdiff_t>(arena.used()), first + 16 + 36);
  }
}

TEST(ScratchLayout, TakesNothingWhereItDoesNotFit) {
  alignas(64) std::array<std::byte, 52> memory;
  for (std::size_t bytes = 0; bytes < 52; ++bytes) {
    Arena arena(std::span<std::byte>(memory).first(bytes));
    Arrays arrays;
    EXPECT_FALSE(firmware::carve_layout(arena, 16, arrays.list(9))) << bytes;
    EXPECT_EQ(arena.used(), 0u);
    EXPECT_EQ(arrays.bytes.data(), nullptr);
  }
  Arena arena(memory);
  Arrays arrays;
  EXPECT_TRUE(firmware::carve_layout(arena, 16, arrays.list(9)));
}

}  // namespace
}  // namespace usuzumi::testing
