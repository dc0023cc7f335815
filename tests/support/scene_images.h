// Images for scenes to be covered with, made by whole numbers so that every compiler makes the same.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/support/scene_builder.h"

namespace usuzumi::scenes {

/// Row by row, top row first, each texel alpha 31-24, red, green, blue.
struct TexelImage {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint32_t> texels;

  std::uint32_t& at(std::uint32_t x, std::uint32_t y) { return texels[std::size_t{y} * width + x]; }
  std::uint32_t at(std::uint32_t x, std::uint32_t y) const { return texels[std::size_t{y} * width + x]; }
};

constexpr std::uint32_t argb(std::uint32_t a, std::uint32_t r, std::uint32_t g, std::uint32_t b) {
  return a << 24 | r << 16 | g << 8 | b;
}

TexelImage filled(std::uint32_t width, std::uint32_t height, std::uint32_t texel);
/// Squares of `cell` texels in two colours, with a frame one texel wide, so that the image's edge shows.
TexelImage chequers(std::uint32_t width, std::uint32_t height, std::uint32_t cell);
/// Hills of each channel that rise and fall a few times across the image and go on where it repeats.
TexelImage hills(std::uint32_t width, std::uint32_t height);
/// A white disc on nothing: alpha 255 within, falling to 0 over the outer `soft` texels.
TexelImage spot(std::uint32_t size, std::uint32_t soft);
/// A coarse map of a planet: seas, lands, ice at the top and the bottom; meridians and parallels.
TexelImage globe_map(std::uint32_t width, std::uint32_t height);
TexelImage noise(std::uint32_t width, std::uint32_t height, RandomSequence& random);

/// Each level the mean of two by two (or as many as there are) of the level above, rounded; `levels` in all.
std::vector<TexelImage> level_chain(const TexelImage& image, std::uint32_t levels);

/// Puts the levels into RAM in the format and sets the texture.
void set_texture(SceneBuilder& b, const std::vector<TexelImage>& levels, command::TextureFormat format,
                 command::TextureFilter filter, command::TextureWrap wrap_s = command::TextureWrap::kRepeat,
                 command::TextureWrap wrap_t = command::TextureWrap::kRepeat);

}  // namespace usuzumi::scenes
