// The signature unit against a CRC computed bit by bit from the definition, over pixels known in advance.
#include <gtest/gtest.h>

#include "tests/gfx_subsystem/display/display_bench.h"

namespace usuzumi::gfx {
namespace {

constexpr std::uint64_t kFrame = SmallDisplay::kFrameTicks, kFirstBlank = SmallDisplay::kFirstBlank;
constexpr BusAddress kA = 0x80000000;

/// CRC-32/ISO-HDLC by its definition, one bit at a time.
std::uint32_t bitwise_crc(const std::vector<std::uint32_t>& pixels) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const std::uint32_t p : pixels)
    for (const unsigned shift : {16u, 8u, 0u}) {
      crc ^= p >> shift & 0xFF;
      for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
    }
  return ~crc;
}

/// Pixel i of the 8 x 4 picture.
std::uint32_t pattern(std::uint32_t i) { return (i * 0x01F307) & 0xFFFFFF; }

struct Signed : SmallDisplay {
  Signed() {
    for (std::uint32_t i = 0; i < 32; ++i) memory.put32(kA + 4 * i, pattern(i));
    show_layer(0, kA, 0, 0, 8, 4);
  }
  /// Window 2..4 x 1..2.
  void choose_window() {
    write(0x284, 1u << 16 | 2);
    write(0x288, 1u << 16 | 2);
  }
};

std::vector<std::uint32_t> picture_pixels() {
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t i = 0; i < 32; ++i) pixels.push_back(pattern(i));
  return pixels;
}
const std::vector<std::uint32_t> kWindowPixels = {pattern(10), pattern(11), pattern(12),
                                                  pattern(18), pattern(19), pattern(20)};

TEST(Signature, BitwiseReferenceMeetsThePublishedCheckValue) {
  EXPECT_EQ(bitwise_crc({0x313233, 0x343536, 0x373839}), 0xCBF43926u) << "\"123456789\"";
}

TEST(Signature, PictureCrcCoversEveryPixelAsSentAndAppearsAtTheVerticalBlank) {
  Signed d;
  d.write(0x280, 1);
  d.turn_on();
  d.controller.advance_to(kFirstBlank - 1);
  EXPECT_EQ(d.read(0x290), 0u);
  d.controller.advance_to(kFirstBlank);
  EXPECT_EQ(d.read(0x290), bitwise_crc(picture_pixels()));
  EXPECT_EQ(d.read(0x298), 1u);
  EXPECT_EQ(d.read(0x294), 0u) << "no window was asked for";
}

TEST(Signature, WindowCrcCoversTheWindowWithAndWithoutThePictures) {
  for (const std::uint32_t control : {2u, 3u}) {
    Signed d;
    d.choose_window();
    d.write(0x280, control);
    d.run_one_picture();
    EXPECT_EQ(d.read(0x294), bitwise_crc(kWindowPixels));
    EXPECT_EQ(d.read(0x290), control == 3 ? bitwise_crc(picture_pixels()) : 0u);
    EXPECT_EQ(d.read(0x020), 1u);
  }
}

TEST(Signature, MismatchInterruptComesOnlyWhenCheckedAndDifferent) {
  Signed d;
  d.choose_window();
  d.write(0x024, 4);
  d.write(0x28C, bitwise_crc(kWindowPixels));
  d.write(0x280, 6);
  d.run_one_picture();
  EXPECT_EQ(d.read(0x020), 1u);
  d.memory.put32(kA, 0);  // outside the window
  d.controller.advance_to(kFirstBlank + kFrame);
  EXPECT_FALSE(d.controller.fault_asserted());
  d.memory.put32(kA + 4 * 19, pattern(19) ^ 1);  // one bit of one pixel inside
  d.controller.advance_to(kFirstBlank + 2 * kFrame - 1);
  EXPECT_FALSE(d.controller.fault_asserted());
  d.controller.advance_to(kFirstBlank + 2 * kFrame);
  EXPECT_TRUE(d.controller.fault_asserted());
  EXPECT_EQ(d.read(0x020), 5u);
}

TEST(Signature, ReferenceIsShadowedUntilTheFrameAfter) {
  Signed d;
  d.choose_window();
  d.write(0x28C, bitwise_crc(kWindowPixels));
  d.write(0x280, 6);
  d.turn_on();
  d.write(0x28C, 0);
  d.controller.advance_to(kFirstBlank);
  EXPECT_EQ(d.read(0x020) & 4u, 0u) << "the frame sent was ruled by the old reference";
  d.controller.advance_to(kFirstBlank + kFrame);
  EXPECT_EQ(d.read(0x020) & 4u, 4u);
}

TEST(Signature, WindowOutsideThePictureIsAConfigurationError) {
  Signed d;
  d.choose_window();
  d.write(0x288, 1u << 16 | 6);  // 2 + 7 > 8
  d.write(0x280, 6);
  d.run_one_picture();
  EXPECT_EQ(d.read(0x03C), 2u);
  EXPECT_EQ(d.read(0x294), 0u);
  EXPECT_EQ(d.read(0x020), 9u) << "and no mismatch is claimed";
}

TEST(Signature, AStarvedPictureHasAnotherCrc) {
  SmallDisplay good, starved({.bus_bytes_per_second = 100'000'000, .fifo_bytes = 8});
  for (SmallDisplay* d : {&good, &starved}) {
    for (std::uint32_t i = 0; i < 32; ++i) d->memory.put32(kA + 4 * i, pattern(i));
    d->show_layer(0, kA, 0, 0, 8, 4);
    d->write(0x280, 1);
    d->run_one_picture();
  }
  EXPECT_NE(good.read(0x290), starved.read(0x290));
}

}  // namespace
}  // namespace usuzumi::gfx
