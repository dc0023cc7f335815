#include "boards/common/picture_crc.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace usuzumi {
namespace {

TEST(BoardPictureCrc, IsThatOfRgbBytesInScanOrder) {
  // "123456789" as three pixels, in rows of one: the check value of CRC-32/ISO-HDLC.
  const Scanout scanout{1, 3, command::PixelFormat::kXrgb8888, 64, {}};
  std::vector<std::byte> pixels(std::size_t{64} * 3, std::byte{0xEE});
  const std::uint32_t rgb[] = {0xFF313233, 0x00343536, 0x77373839};
  for (std::size_t y = 0; y < 3; ++y) std::memcpy(&pixels[64 * y], &rgb[y], 4);
  EXPECT_EQ(boards::picture_crc32(scanout, pixels), 0xCBF43926u);
}

TEST(BoardPictureCrc, SixteenBitsAreWidenedByRepeatingTheUpperOnes) {
  // 31 63 31 becomes 255 255 255; 16 32 16 becomes 132 130 132.
  const std::uint16_t narrow[] = {0xFFFF, 16 << 11 | 32 << 5 | 16};
  const std::uint32_t wide[] = {0xFFFFFF, 132 << 16 | 130 << 8 | 132};
  std::vector<std::byte> a(64), b(64);
  std::memcpy(a.data(), narrow, sizeof narrow);
  std::memcpy(b.data(), wide, sizeof wide);
  EXPECT_EQ(boards::picture_crc32({2, 1, command::PixelFormat::kRgb565, 64, {}}, a),
            boards::picture_crc32({2, 1, command::PixelFormat::kXrgb8888, 64, {}}, b));
}

TEST(BoardPictureCrc, LongRowsAreTakenWhole) {
  const std::uint32_t width = 200;
  std::vector<std::byte> pixels(default_stride_bytes(width, command::PixelFormat::kXrgb8888));
  const Scanout scanout{width, 1, command::PixelFormat::kXrgb8888, static_cast<std::uint32_t>(pixels.size()), {}};
  const std::uint32_t before = boards::picture_crc32(scanout, pixels);
  for (const std::size_t x : {0u, 63u, 64u, 127u, 128u, 199u}) {
    pixels[4 * x] = std::byte{1};
    EXPECT_NE(boards::picture_crc32(scanout, pixels), before) << x;
    pixels[4 * x] = std::byte{0};
  }
  pixels[4 * width] = std::byte{1};
  EXPECT_EQ(boards::picture_crc32(scanout, pixels), before) << "what lies behind a row is no pixel";
}

}  // namespace
}  // namespace usuzumi
