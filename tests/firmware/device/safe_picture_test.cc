#include "firmware/device/safe_picture.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace usuzumi {
namespace {

using command::PixelFormat;

struct Painted {
  Painted(std::uint32_t width, std::uint32_t height, PixelFormat format)
      : scanout{width, height, format, default_stride_bytes(width, format), {}},
        pixels(std::size_t{scanout.stride_bytes} * height, std::byte{0x5A}) {
    firmware::paint_safe_picture(scanout, pixels);
  }
  std::uint32_t at(std::uint32_t x, std::uint32_t y) const {
    const std::uint32_t bytes = command::bytes_per_pixel(scanout.format);
    std::uint32_t v = 0;
    std::memcpy(&v, &pixels[std::size_t{y} * scanout.stride_bytes + std::size_t{x} * bytes], bytes);
    return v;
  }
  Scanout scanout;
  std::vector<std::byte> pixels;
};

TEST(SafePicture, StandsInTheMiddleAndIsBlackAroundIt) {
  for (const auto& [width, height] : {std::pair{480u, 272u}, {96u, 160u}, {17u, 16u}}) {
    const Painted painted(width, height, PixelFormat::kXrgb8888);
    const PictureRectangle part = firmware::safe_picture_part(width, height);
    EXPECT_LE(part.width, std::min(width, height) * 2 / 5);
    std::uint32_t amber_inside = 0;
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = 0; x < width; ++x) {
        const bool inside = x - part.x < part.width && y - part.y < part.height;
        amber_inside += inside && painted.at(x, y) == 0xFFB000 ? 1u : 0u;
        ASSERT_TRUE(inside || painted.at(x, y) == 0) << x << " " << y;
      }
    // A triangle is half of its square; the black sign in it takes a little.
    EXPECT_GT(amber_inside, part.width * part.height / 3);
    EXPECT_LT(amber_inside, part.width * part.height * 6 / 10);
  }
}

TEST(SafePicture, IsATriangleThatStandsOnItsBaseMirroredAboutItsMiddle) {
  const Painted painted(250, 250, PixelFormat::kXrgb8888);  // a sign of 100 pixels from (75, 75)
  std::uint32_t before = 0;
  for (std::uint32_t y = 75; y < 175; y += 5) {
    std::uint32_t left = 0, right = 0;
    for (std::uint32_t x = 75; x < 175; ++x) {
      EXPECT_EQ(painted.at(x, y), painted.at(249 - x, y)) << x << " " << y;
      if (painted.at(x, y) != 0) left = left == 0 ? x : left, right = x;
    }
    const std::uint32_t width = left == 0 ? 0 : right - left + 1;
    EXPECT_GE(width, before) << "row " << y;
    before = width;
  }
  EXPECT_GE(before, 94u);
  EXPECT_EQ(painted.at(125, 75 + 50), 0u) << "the bar of the exclamation mark";
  EXPECT_EQ(painted.at(125, 75 + 80), 0u) << "its dot";
  EXPECT_NE(painted.at(125, 75 + 72), 0u) << "between them";
}

TEST(SafePicture, IsTheSameIn16Bits) {
  const Painted wide(64, 48, PixelFormat::kXrgb8888), narrow(64, 48, PixelFormat::kRgb565);
  for (std::uint32_t y = 0; y < 48; ++y)
    for (std::uint32_t x = 0; x < 64; ++x)
      ASSERT_EQ(narrow.at(x, y), wide.at(x, y) == 0 ? 0u : 0xFD80u) << x << " " << y;  // 31, 44, 0
}

}  // namespace
}  // namespace usuzumi
