#include "sim/pack/picture_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace usuzumi::sim {
namespace {

template <std::size_t kCount>
bool begins_with(std::span<const std::byte> file, const std::array<unsigned char, kCount>& magic) {
  return file.size() >= kCount && std::memcmp(file.data(), magic.data(), kCount) == 0;
}

}  // namespace

std::optional<Picture> picture_of(std::uint32_t width, std::uint32_t height, std::string& fault) {
  if (std::max(width, height) > kMostDecoded) {
    fault = fmt::format("has {}x{} texels, and at most {} each way are read", width, height, kMostDecoded);
    return std::nullopt;
  }
  Picture picture{{}, width, height, {}};
  picture.texels.resize(std::size_t{width} * height);
  return picture;
}

std::optional<Picture> decode_picture(std::span<const std::byte> file, std::string& fault) {
  if (begins_with<8>(file, {0x89, 'P', 'N', 'G', 0x0D, 0x0A, 0x1A, 0x0A})) return decode_png(file, fault);
  if (begins_with<3>(file, {0xFF, 0xD8, 0xFF})) return decode_jpeg(file, fault);
  fault = file.empty() ? "is empty" : "is neither PNG nor JPEG";
  return std::nullopt;
}

}  // namespace usuzumi::sim
