#include "firmware/device/safe_picture.h"

#include <cstring>

namespace usuzumi::firmware {
namespace {

constexpr Rgba8 kAmber = rgba8(255, 176, 0), kBlack = rgba8(0, 0, 0);

/// The sign at (x, y) of a square of side `s`: an amber triangle standing on its base, in it a black bar and a dot.
Rgba8 sign_colour(std::uint32_t x, std::uint32_t y, std::uint32_t s) {
  const std::uint32_t from_middle = 2 * x + 1 > s ? 2 * x + 1 - s : s - 2 * x - 1;  // in half pixels
  if (from_middle > y) return kBlack;
  const bool in_stroke = from_middle < s / 8;
  const bool in_bar = y >= s * 3 / 8 && y < s * 11 / 16, in_dot = y >= s * 3 / 4 && y < s * 7 / 8;
  return in_stroke && (in_bar || in_dot) ? kBlack : kAmber;
}

void put_pixel(command::PixelFormat format, std::byte* at, Rgba8 c) {
  if (format == command::PixelFormat::kRgb565) {
    const auto bits = static_cast<std::uint16_t>((c.r() >> 3) << 11 | (c.g() >> 2) << 5 | c.b() >> 3);
    std::memcpy(at, &bits, sizeof bits);
  } else {
    const std::uint32_t bits = c.r() << 16 | c.g() << 8 | c.b();
    std::memcpy(at, &bits, sizeof bits);
  }
}

}  // namespace

PictureRectangle safe_picture_part(std::uint32_t width, std::uint32_t height) {
  const std::uint32_t side = (width < height ? width : height) * 2 / 5;
  const std::uint32_t least = side < 1 ? 1 : side;
  return {(width - least) / 2, (height - least) / 2, least, least};
}

void paint_safe_picture(const Scanout& scanout, std::span<std::byte> pixels) {
  std::memset(pixels.data(), 0, pixels.size());  // black in either format
  const PictureRectangle part = safe_picture_part(scanout.width, scanout.height);
  const std::uint32_t bytes = command::bytes_per_pixel(scanout.format);
  for (std::uint32_t y = 0; y < part.height; ++y) {
    std::byte* row = pixels.data() + std::size_t{part.y + y} * scanout.stride_bytes + std::size_t{part.x} * bytes;
    for (std::uint32_t x = 0; x < part.width; ++x)
      put_pixel(scanout.format, row + std::size_t{x} * bytes, sign_colour(x, y, part.width));
  }
}

}  // namespace usuzumi::firmware
