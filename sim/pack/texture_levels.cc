#include "sim/pack/texture_levels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "sim/pack/colour.h"

namespace usuzumi::sim {
namespace {

constexpr std::uint32_t kFull = 65535;  // linear light and alpha in 16 bits

/// sRGB code values to linear light in 16 bits (IEC 61966-2-1), and back to the nearest code value.
class Curve {
 public:
  Curve() {
    for (std::uint32_t code = 0; code < 256; ++code) linear_[code] = to_linear(code);
    for (std::uint32_t code = 0; code < 255; ++code) ceiling_[code] = to_linear(code + 0.5);
  }
  std::uint32_t linear(std::uint32_t code) const { return linear_[code]; }
  std::uint32_t code(std::uint32_t linear) const {
    return static_cast<std::uint32_t>(std::upper_bound(ceiling_.begin(), ceiling_.end(), linear) - ceiling_.begin());
  }

 private:
  static std::uint32_t to_linear(double code) {
    const double c = code / 255;
    const double light = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    return static_cast<std::uint32_t>(light * kFull + 0.5);
  }
  std::array<std::uint32_t, 256> linear_{};
  std::array<std::uint32_t, 255> ceiling_{};  // up to here it is this code value
};

const Curve& curve() {
  static const Curve the_curve;
  return the_curve;
}

/// 16 bits each: linear light times alpha, alpha, and linear light as it stands, which counts where all is unseen: the
/// engine's bilinear filter mixes the colours of unseen texels in as well.
constexpr std::size_t kAlpha = 3, kPlain = 4, kChannels = 7;
using Light = std::array<std::uint16_t, kChannels>;

/// A level in linear light; halving keeps 16 bits, so that the last level still has the colour of the first.
struct LightImage {
  std::uint32_t width = 0, height = 0;
  std::vector<Light> texels;
};

LightImage to_light(const Picture& picture) {
  LightImage out{picture.width, picture.height, {}};
  out.texels.reserve(picture.texels.size());
  for (const Rgba8 c : picture.texels) {
    const std::uint32_t alpha = c.a() * 257;
    Light light{};
    light[kAlpha] = static_cast<std::uint16_t>(alpha);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t plain = curve().linear(c.bits >> (8 * k) & 0xFF);
      light[kPlain + k] = static_cast<std::uint16_t>(plain);
      light[k] = static_cast<std::uint16_t>((std::uint64_t{plain} * alpha + kFull / 2) / kFull);
    }
    out.texels.push_back(light);
  }
  return out;
}

Picture to_picture(const LightImage& image, const std::string& name) {
  Picture out{name, image.width, image.height, {}};
  out.texels.reserve(image.texels.size());
  for (const Light& t : image.texels) {
    const std::uint32_t alpha = t[kAlpha];
    const auto code = [&](std::size_t k) {
      const std::uint64_t light = alpha == 0 ? t[kPlain + k] : (std::uint64_t{t[k]} * kFull + alpha / 2) / alpha;
      return curve().code(static_cast<std::uint32_t>(std::min<std::uint64_t>(kFull, light)));
    };
    out.texels.push_back(rgba8(code(0), code(1), code(2), (alpha + 128) / 257));
  }
  return out;
}

/// How much of source texel `from` + i lies in a destination texel, in units of 1 / destination size; the weights of
/// one destination texel sum to the source's size.
struct Footprint {
  std::uint32_t from = 0;
  std::vector<std::uint32_t> weights;
};
std::vector<Footprint> footprints(std::uint32_t source, std::uint32_t destination) {
  std::vector<Footprint> out(destination);
  for (std::uint32_t i = 0; i < destination; ++i) {
    const std::uint64_t begin = std::uint64_t{i} * source, end = begin + source;
    out[i].from = static_cast<std::uint32_t>(begin / destination);
    for (std::uint64_t j = out[i].from; j * destination < end; ++j)
      out[i].weights.push_back(
          static_cast<std::uint32_t>(std::min(end, (j + 1) * destination) - std::max(begin, j * destination)));
  }
  return out;
}

/// Sums are below 2^14 * 2^14 * 2^16.
LightImage halved(const LightImage& image) {
  LightImage out{std::max(1u, image.width / 2), std::max(1u, image.height / 2), {}};
  out.texels.reserve(std::size_t{out.width} * out.height);
  const std::vector<Footprint> columns = footprints(image.width, out.width),
                               rows = footprints(image.height, out.height);
  const std::uint64_t whole = std::uint64_t{image.width} * image.height;
  for (const Footprint& row : rows)
    for (const Footprint& column : columns) {
      std::array<std::uint64_t, kChannels> sum{};
      for (std::size_t y = 0; y < row.weights.size(); ++y)
        for (std::size_t x = 0; x < column.weights.size(); ++x) {
          const Light& t = image.texels[(row.from + y) * image.width + column.from + x];
          const std::uint64_t weight = std::uint64_t{row.weights[y]} * column.weights[x];
          for (std::size_t k = 0; k < kChannels; ++k) sum[k] += weight * t[k];
        }
      Light mean{};
      for (std::size_t k = 0; k < kChannels; ++k) mean[k] = static_cast<std::uint16_t>((sum[k] + whole / 2) / whole);
      out.texels.push_back(mean);
    }
  return out;
}

/// `code` in `bits` bits, rounded up from a threshold that an ordered 4x4 pattern spreads over [margin, 255 - margin]
/// of 255: within the margin of a step the colour stays plain. A code that `bits` hold exactly (its top bits repeated
/// below) lies up to 21 of 255 parts of a step off its number in five bits, up to 45 in six.
std::uint32_t dithered(std::uint32_t code, std::uint32_t bits, std::uint32_t x, std::uint32_t y) {
  constexpr std::uint32_t kBayer[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
  const std::uint32_t margin = bits == 5 ? 24 : 48, most = (1u << bits) - 1;
  const std::uint32_t threshold = margin + kBayer[y % 4][x % 4] * (255 - 2 * margin) / 15;
  return (code * most + threshold) / 255;
}

std::uint32_t to_rgb565(Rgba8 c, std::uint32_t x, std::uint32_t y) {
  return dithered(c.r(), 5, x, y) << 11 | dithered(c.g(), 6, x, y) << 5 | dithered(c.b(), 5, x, y);
}

void put(std::vector<std::byte>& out, std::uint32_t value, std::uint32_t bytes) {
  for (std::uint32_t i = 0; i < bytes; ++i) out.push_back(static_cast<std::byte>(value >> (8 * i) & 0xFF));
}

}  // namespace

std::uint32_t full_level_count(std::uint32_t width, std::uint32_t height) {
  return static_cast<std::uint32_t>(std::bit_width(std::max(width, height)));
}

std::vector<Picture> levels_of(const Picture& picture, std::uint32_t most) {
  std::vector<Picture> levels{picture};
  LightImage image;
  while (levels.size() < most && std::max(levels.back().width, levels.back().height) > 1) {
    if (image.texels.empty()) image = to_light(picture);
    image = halved(image);
    levels.push_back(to_picture(image, picture.name));
  }
  return levels;
}

Picture fitted(const Picture& picture, std::uint32_t most) {
  if (std::max(picture.width, picture.height) <= most) return picture;
  LightImage image = to_light(picture);
  while (std::max(image.width, image.height) > most) image = halved(image);
  return to_picture(image, picture.name);
}

std::vector<std::byte> texels_of(const Picture& level, command::TextureFormat format) {
  std::vector<std::byte> out;
  out.reserve(std::size_t{4} * level.texels.size());
  for (std::uint32_t y = 0; y < level.height; ++y) {
    for (std::uint32_t x = 0; x < level.width; ++x) {
      const Rgba8 c = level.texels[std::size_t{y} * level.width + x];
      const std::uint32_t alpha = format == command::TextureFormat::kArgb8888 ? c.a() : 0xFF;
      if (format == command::TextureFormat::kRgb565) put(out, to_rgb565(c, x, y), 2);
      else put(out, alpha << 24 | c.r() << 16 | c.g() << 8 | c.b(), 4);
    }
    out.resize((out.size() + 3) / 4 * 4);
  }
  return out;
}

}  // namespace usuzumi::sim
