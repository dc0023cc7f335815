// Smaller versions of textures, and texels as the engine reads them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hal/command_list.h"
#include "sim/pack/model.h"

namespace usuzumi::sim {

/// The picture at max(1, width >> 1) by max(1, height >> 1), and so on down to one texel: `picture` itself first, at
/// most `most` in all. Each texel is the mean of the area that it covers (a box filter, also of odd sizes), in linear
/// light, weighted by alpha, so that what cannot be seen tints nothing. Integers but for the tables of the sRGB curve:
/// the same bytes everywhere.
std::vector<Picture> levels_of(const Picture& picture, std::uint32_t most);

/// The first of levels_of() that is no larger than `most` texels either way.
Picture fitted(const Picture& picture, std::uint32_t most);

/// 1 + floor(log2(max(width, height))): as many levels as there can be.
std::uint32_t full_level_count(std::uint32_t width, std::uint32_t height);

/// A level's texels in `format`, row by row, every row padded to 4 bytes (command::SetTexture). RGB565 is dithered by
/// an ordered 4x4 pattern; colours that it holds exactly stay as they are. kXrgb8888 has 0xFF in its top byte.
std::vector<std::byte> texels_of(const Picture& level, command::TextureFormat format);

}  // namespace usuzumi::sim
