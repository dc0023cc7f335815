#include "boards/common/picture_crc.h"

#include <cstring>

#include "hal/crc32.h"

namespace usuzumi::boards {
namespace {

void put_rgb(command::PixelFormat format, const std::byte* pixel, std::byte* rgb) {
  std::uint32_t r, g, b;
  if (format == command::PixelFormat::kRgb565) {
    std::uint16_t v;
    std::memcpy(&v, pixel, sizeof v);
    const std::uint32_t r5 = v >> 11, g6 = v >> 5 & 63u, b5 = v & 31u;
    r = r5 << 3 | r5 >> 2, g = g6 << 2 | g6 >> 4, b = b5 << 3 | b5 >> 2;
  } else {
    std::uint32_t v;
    std::memcpy(&v, pixel, sizeof v);
    r = v >> 16 & 255, g = v >> 8 & 255, b = v & 255;
  }
  rgb[0] = static_cast<std::byte>(r);
  rgb[1] = static_cast<std::byte>(g);
  rgb[2] = static_cast<std::byte>(b);
}

}  // namespace

std::uint32_t picture_crc32(const Scanout& scanout, std::span<const std::byte> pixels) {
  constexpr std::uint32_t kRun = 64;  // pixels
  std::byte rgb[3 * kRun];
  const std::uint32_t bytes = command::bytes_per_pixel(scanout.format);
  std::uint32_t crc = kCrc32Start;
  for (std::uint32_t y = 0; y < scanout.height; ++y) {
    const std::byte* row = pixels.data() + std::size_t{y} * scanout.stride_bytes;
    for (std::uint32_t x = 0; x < scanout.width; x += kRun) {
      const std::uint32_t count = scanout.width - x < kRun ? scanout.width - x : kRun;
      for (std::uint32_t i = 0; i < count; ++i)
        put_rgb(scanout.format, row + std::size_t{x + i} * bytes, rgb + std::size_t{3} * i);
      crc = crc32(crc, std::span(rgb, std::size_t{3} * count));
    }
  }
  return crc;
}

}  // namespace usuzumi::boards
