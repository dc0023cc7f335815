#include "tests/support/scene_images.h"

#include <algorithm>
#include <cstring>

namespace usuzumi::scenes {
namespace {

using namespace command;

/// 0 at 0, 255 at half the period, 0 at the period.
std::uint32_t wave(std::uint32_t at, std::uint32_t period) {
  const std::uint32_t p = at % period, up = std::min(p, period - p);
  return up * 2 * 255 / period;
}

std::uint32_t channel(std::uint32_t texel, unsigned shift) { return texel >> shift & 255; }

std::uint32_t mean_of(const TexelImage& image, std::uint32_t x, std::uint32_t y) {
  const std::uint32_t x1 = std::min(2 * x + 1, image.width - 1), y1 = std::min(2 * y + 1, image.height - 1);
  std::uint32_t mean = 0;
  for (const unsigned shift : {0u, 8u, 16u, 24u}) {
    std::uint32_t sum = 2;
    for (const std::uint32_t sy : {std::min(2 * y, y1), y1})
      for (const std::uint32_t sx : {std::min(2 * x, x1), x1}) sum += channel(image.at(sx, sy), shift);
    mean |= sum / 4 << shift;
  }
  return mean;
}

void append_level(std::vector<std::byte>& to, const TexelImage& level, TextureFormat format) {
  const std::size_t pitch = (level.width * bytes_per_texel(format) + 3) / 4 * 4;
  for (std::uint32_t y = 0; y < level.height; ++y) {
    const std::size_t row = to.size();
    to.resize(row + pitch);
    for (std::uint32_t x = 0; x < level.width; ++x) {
      const std::uint32_t t = level.at(x, y);
      if (format != TextureFormat::kRgb565) {
        std::memcpy(&to[row + 4 * x], &t, 4);
        continue;
      }
      const auto step = [](std::uint32_t v, std::uint32_t most) { return (2 * v * most + 255) / 510; };
      const auto packed = static_cast<std::uint16_t>(step(channel(t, 16), 31) << 11 | step(channel(t, 8), 63) << 5 |
                                                     step(channel(t, 0), 31));
      std::memcpy(&to[row + 2 * x], &packed, 2);
    }
  }
}

}  // namespace

TexelImage filled(std::uint32_t width, std::uint32_t height, std::uint32_t texel) {
  return {width, height, std::vector<std::uint32_t>(std::size_t{width} * height, texel)};
}

TexelImage chequers(std::uint32_t width, std::uint32_t height, std::uint32_t cell) {
  TexelImage image = filled(width, height, 0);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const bool edge = x == 0 || y == 0 || x + 1 == width || y + 1 == height;
      const bool dark = (x / cell + y / cell) % 2 != 0;
      // Colours run across the image, so that no two cells are the same.
      image.at(x, y) = edge ? argb(255, 255, 220, 0)
                            : argb(255, dark ? 30 : 255 - 160 * x / width, dark ? 40 + 90 * y / height : 240,
                                   dark ? 120 : 255 - 200 * y / height);
    }
  return image;
}

TexelImage hills(std::uint32_t width, std::uint32_t height) {
  TexelImage image = filled(width, height, 0);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x)
      image.at(x, y) = argb(255, wave(x, width), wave(y, height), (wave(x, width) + wave(2 * y, height)) / 2);
  return image;
}

TexelImage spot(std::uint32_t size, std::uint32_t soft) {
  TexelImage image = filled(size, size, 0);
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = 0; x < size; ++x) {
      // Distance from the centre in half texels, squared; the alpha falls with the square.
      const auto off = [size](std::uint32_t v) { return static_cast<std::int64_t>(2 * v + 1) - size; };
      const std::int64_t d = off(x) * off(x) + off(y) * off(y), outer = std::int64_t{size} * size,
                         inner_side = std::int64_t{size} - 2 * std::int64_t{soft}, inner = inner_side * inner_side;
      const std::int64_t a = d <= inner ? 255 : d >= outer ? 0 : 255 * (outer - d) / (outer - inner);
      image.at(x, y) = argb(static_cast<std::uint32_t>(a), 255, 255, 255);
    }
  return image;
}

TexelImage globe_map(std::uint32_t width, std::uint32_t height) {
  TexelImage image = filled(width, height, 0);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::uint32_t land = wave(3 * x + y, width) + wave(2 * x + 3 * y, width) / 2 + wave(2 * y, height) / 2;
      const bool line = x % (width / 12) == 0 || y % (height / 6) == 0;
      std::uint32_t c = land > 270 ? argb(255, 80 + land / 6, 130, 60) : argb(255, 20, 60 + land / 4, 150 + land / 3);
      if (y * 10 < height || y * 10 >= height * 9) c = argb(255, 236, 240, 248);
      image.at(x, y) = line ? argb(255, 250, 210, 90) : c;
    }
  return image;
}

TexelImage noise(std::uint32_t width, std::uint32_t height, RandomSequence& random) {
  TexelImage image = filled(width, height, 0);
  for (std::uint32_t& texel : image.texels) texel = random.next();
  return image;
}

std::vector<TexelImage> level_chain(const TexelImage& image, std::uint32_t levels) {
  std::vector<TexelImage> chain{image};
  while (chain.size() < levels) {
    const TexelImage& above = chain.back();
    TexelImage level = filled(std::max(above.width / 2, 1u), std::max(above.height / 2, 1u), 0);
    for (std::uint32_t y = 0; y < level.height; ++y)
      for (std::uint32_t x = 0; x < level.width; ++x) level.at(x, y) = mean_of(above, x, y);
    chain.push_back(level);
  }
  return chain;
}

void set_texture(SceneBuilder& b, const std::vector<TexelImage>& levels, TextureFormat format, TextureFilter filter,
                 TextureWrap wrap_s, TextureWrap wrap_t) {
  std::vector<std::byte> bytes;
  for (const TexelImage& level : levels) append_level(bytes, level, format);
  b.put(SetTexture{format, b.store(bytes), levels[0].width, levels[0].height,
                   static_cast<std::uint32_t>(levels.size()), filter, wrap_s, wrap_t});
}

}  // namespace usuzumi::scenes
