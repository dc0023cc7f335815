#include "sim/image/image.h"

#include "hal/crc32.h"

namespace usuzumi::sim {

std::uint32_t picture_crc32(const Image& image) {
  std::vector<std::byte> rgb;
  rgb.reserve(image.xrgb.size() * 3);
  for (const std::uint32_t p : image.xrgb) {
    rgb.push_back(static_cast<std::byte>(p >> 16 & 0xFF));
    rgb.push_back(static_cast<std::byte>(p >> 8 & 0xFF));
    rgb.push_back(static_cast<std::byte>(p & 0xFF));
  }
  return crc32(kCrc32Start, rgb);
}

}  // namespace usuzumi::sim
