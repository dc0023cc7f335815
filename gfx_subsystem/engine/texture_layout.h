// Where the levels of a texture lie, as hal/command_list.h's SetTexture has them.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "hal/command_list.h"

namespace usuzumi::gfx {

inline constexpr std::uint32_t kMaxTextureSize = 4096;
/// Levels of the chain of a texture of the largest size.
inline constexpr std::uint32_t kMaxTextureLevels = 13;

/// Levels down to the one of a single texel. width, height >= 1.
constexpr std::uint32_t full_level_count(std::uint32_t width, std::uint32_t height) {
  return static_cast<std::uint32_t>(std::bit_width(std::max(width, height)));
}
static_assert(full_level_count(kMaxTextureSize, 1) == kMaxTextureLevels);

/// Texels along one side of a level.
constexpr std::uint32_t level_size(std::uint32_t size, std::uint32_t level) {
  return std::max<std::uint32_t>(size >> level, 1);
}

/// Bytes from a row of a level to the next.
constexpr std::uint32_t level_pitch(const command::SetTexture& t, std::uint32_t level) {
  return (level_size(t.width, level) * command::bytes_per_texel(t.format) + 3) / 4 * 4;
}

/// Bytes of the levels before `level`; no more than 2^27 for all of the largest texture.
constexpr std::uint32_t level_offset(const command::SetTexture& t, std::uint32_t level) {
  std::uint32_t bytes = 0;
  for (std::uint32_t i = 0; i < level; ++i) bytes += level_pitch(t, i) * level_size(t.height, i);
  return bytes;
}

/// Bytes of all levels.
constexpr std::uint32_t texture_bytes(const command::SetTexture& t) { return level_offset(t, t.level_count); }

}  // namespace usuzumi::gfx
