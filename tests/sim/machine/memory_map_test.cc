#include "sim/machine/memory_map.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "sim/common/error.h"

namespace usuzumi::sim {
namespace {

class Memories final : public MemoryMap {
 public:
  using MemoryMap::MemoryMap;
};

std::vector<std::byte> counting(std::size_t size) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * 7 & 0xFF);
  return bytes;
}

struct MemoryMapTest : ::testing::Test {
  std::vector<std::byte> image = counting(5000);  // no whole number of pages
  Memories memory{image, 1 << 20, 1 << 16};
};

TEST_F(MemoryMapTest, ShowsTheRomAtItsAddress) {
  const auto window = memory.read_window(0x10000000u, 5000);
  ASSERT_NE(window.data(), nullptr);
  EXPECT_TRUE(std::equal(window.begin(), window.end(), image.begin()));
  EXPECT_EQ(memory.read_window(0x10000003u, 1)[0], image[3]);
}

TEST_F(MemoryMapTest, EndsEachMemoryAtItsLastByte) {
  struct Place {
    BusAddress base;
    std::size_t size;
  };
  for (const Place& p : {Place{0x10000000u, 5000}, Place{0x50000000u, 1 << 20}, Place{0x80000000u, 1 << 16}}) {
    const auto end = p.base + static_cast<BusAddress>(p.size);
    EXPECT_NE(memory.read_window(p.base, p.size).data(), nullptr);
    EXPECT_NE(memory.read_window(end - 1, 1).data(), nullptr);
    EXPECT_EQ(memory.read_window(end - 1, 2).data(), nullptr);
    EXPECT_EQ(memory.read_window(end, 1).data(), nullptr);
    EXPECT_EQ(memory.read_window(p.base - 1, 1).data(), nullptr);
    EXPECT_EQ(memory.read_window(p.base - 1, 2).data(), nullptr) << "a window does not begin before memory";
    EXPECT_EQ(memory.read_window(p.base, p.size + 1).data(), nullptr);
    EXPECT_EQ(memory.read_window(p.base, SIZE_MAX).data(), nullptr);
  }
}

TEST_F(MemoryMapTest, EmptyWindowsNeedMemoryToo) {
  EXPECT_NE(memory.read_window(0x50000000u, 0).data(), nullptr);
  EXPECT_EQ(memory.read_window(0x40000000u, 0).data(), nullptr);
  EXPECT_EQ(memory.read_window(0, 0).data(), nullptr);
  EXPECT_EQ(memory.read_window(0xF0000000u, 4).data(), nullptr) << "registers are no memory";
}

TEST_F(MemoryMapTest, WhatMastersWriteTheCpuSees) {
  memory.write_window(0x50000010u, 1)[0] = std::byte{0x5A};
  EXPECT_EQ(memory.ram()[0x10], std::byte{0x5A});
  memory.write_window(0x8000FFFFu, 1)[0] = std::byte{0xA5};
  EXPECT_EQ(memory.vram()[0xFFFF], std::byte{0xA5});
}

TEST_F(MemoryMapTest, NoMasterWritesRom) {
  EXPECT_EQ(memory.write_window(0x10000000u, 1).data(), nullptr);
  EXPECT_EQ(memory.write_window(0x10000000u, 0).data(), nullptr);
}

TEST_F(MemoryMapTest, AStrayWriteIntoRomFaults) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  auto* stray = const_cast<volatile std::byte*>(memory.rom().data() + 4999);
  EXPECT_DEATH(*stray = std::byte{1}, "");
}

TEST_F(MemoryMapTest, RomCrcIsTheImagesAndStays) {
  EXPECT_EQ(Memories(std::as_bytes(std::span("123456789", 9)), 4096, 4096).rom_crc32(), 0xCBF43926u);
  const std::uint32_t before = memory.rom_crc32();
  memory.ram()[0] = std::byte{1};
  EXPECT_EQ(memory.rom_crc32(), before);
}

TEST_F(MemoryMapTest, RamAndVramBeginAsZero) {
  for (const std::byte b : memory.ram()) ASSERT_EQ(b, std::byte{0});
  for (const std::byte b : memory.vram()) ASSERT_EQ(b, std::byte{0});
}

TEST_F(MemoryMapTest, PointersTranslateThereAndBack) {
  const auto round_trip = [this](std::span<const std::byte> bytes, BusAddress base) {
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}, bytes.size() / 2, bytes.size() - 1}) {
      const BusAddress address = memory.bus_address(&bytes[i]);
      EXPECT_EQ(address, base + i);
      EXPECT_EQ(memory.read_window(address, 1).data(), &bytes[i]);
    }
    EXPECT_NE(memory.bus_address(bytes.data() + bytes.size()), base + bytes.size()) << "one past the end is not inside";
  };
  round_trip(memory.rom(), 0x10000000u);
  round_trip(memory.ram(), 0x50000000u);
  round_trip(memory.vram(), 0x80000000u);
}

TEST_F(MemoryMapTest, PointersElsewhereHaveNoBusAddress) {
  const int on_the_stack = 0;
  EXPECT_EQ(memory.bus_address(&on_the_stack), 0u);
  EXPECT_EQ(memory.bus_address(nullptr), 0u);
  EXPECT_EQ(memory.bus_address(image.data()), 0u) << "the image was copied";
}

TEST(MemoryMap, AnEmptyRomIsNowhereOnTheBus) {
  const Memories memory({}, 4096, 4096);
  EXPECT_TRUE(memory.rom().empty());
  EXPECT_EQ(memory.read_window(0x10000000u, 0).data(), nullptr);
  EXPECT_EQ(memory.rom_crc32(), 0u);
}

TEST(MemoryMap, RefusesWhatTheAddressMapHasNoRoomFor) {
  const std::byte byte{};
  // Only its size is looked at before it is refused.
  const std::span<const std::byte> huge(&byte, (std::size_t{1} << 30) + 1);
  try {
    const Memories memory(huge, 4096, 4096);
    FAIL() << "a ROM of 1 GiB and a byte was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kBadInput);
    EXPECT_STREQ(error.what(), "ROM of 1073741825 bytes: the address map has room for 1073741824");
  }
  EXPECT_THROW(Memories({}, (std::size_t{768} << 20) + 1, 4096), Error);
  EXPECT_THROW(Memories({}, 4096, (std::size_t{1792} << 20) + 1), Error);
}

TEST(MemoryMap, ReservesTheLargestMapWithoutTouchingIt) {
  const Memories memory({}, std::size_t{768} << 20, std::size_t{1792} << 20);
  memory.ram().back() = std::byte{1};
  EXPECT_EQ(memory.read_window(0x7FFFFFFFu, 1)[0], std::byte{1});
  EXPECT_NE(memory.read_window(0xEFFFFFFFu, 1).data(), nullptr);
}

}  // namespace
}  // namespace usuzumi::sim
