// A picture in host memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace usuzumi::sim {

struct Image {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint32_t> xrgb;  // width * height words 0x00RRGGBB, top row first

  Image() = default;
  Image(std::uint32_t w, std::uint32_t h, std::uint32_t rgb = 0) : width(w), height(h), xrgb(std::size_t{w} * h, rgb) {}

  std::uint32_t& at(std::uint32_t x, std::uint32_t y) { return xrgb[std::size_t{y} * width + x]; }
  std::uint32_t at(std::uint32_t x, std::uint32_t y) const { return xrgb[std::size_t{y} * width + x]; }
  friend bool operator==(const Image&, const Image&) = default;
};

/// CRC-32/ISO-HDLC over the bytes R, G, B of each pixel, left to right and top to bottom: equal to what the display
/// controller's signature unit computes for the same picture.
std::uint32_t picture_crc32(const Image& image);

}  // namespace usuzumi::sim
