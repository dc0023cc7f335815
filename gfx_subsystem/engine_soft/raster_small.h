// Raster of small triangles: the few 4x4 blocks of the bounding box, all three edge functions at once, no hierarchy.
// Where the processor has no vectors, raster_pixels.h does the same pixel by pixel.
#pragma once

#include <bit>

#include "gfx_subsystem/engine_soft/fragment_shader.h"
#include "gfx_subsystem/engine_soft/raster_pixels.h"
#include "gfx_subsystem/engine_soft/shader.h"

namespace usuzumi::gfx::soft::USUZUMI_KERNEL {
namespace {

/// All ones where both 16-bit halves lie in 0 .. last.
[[gnu::always_inline]] inline I32 inside_box(I16 xy, std::int32_t last_x, std::int32_t last_y) {
  const I16 last = bits_as<I16>(splat_u(pair(last_x, last_y)));
  return bits_as<I32>((xy >= 0) & (xy <= last)) == -1;
}

template <class PixelShader>
[[gnu::always_inline]] inline std::uint32_t raster_small_blocks(const PixelShader& shader, const SmallTriangle& t,
                                                                TileOrigin origin, const TileBuffers& tile) {
  const bool clipped = (t.draw & kClippedBox) != 0;
  const std::int32_t x = t.x - origin.x, y = t.y - origin.y;  // of the record's origin pixel within the tile
  const std::int32_t first_column = std::max<std::int32_t>(x, 0) / kBlockSize,
                     last_column = std::min<std::int32_t>(x + t.last_x, kTileSize - 1) / kBlockSize;
  const std::int32_t first_row = std::max<std::int32_t>(y, 0) / kBlockSize,
                     last_row = std::min<std::int32_t>(y + t.last_y, kTileSize - 1) / kBlockSize;
  const LanePattern lanes = lane_pattern();
  const I16 step0 = bits_as<I16>(splat_u(pair(t.step[0][0], t.step[0][1])));
  const I16 step1 = bits_as<I16>(splat_u(pair(t.step[1][0], t.step[1][1])));
  const I16 step2 = -(step0 + step1);
  std::uint32_t covered = 0;
  for (std::int32_t row = first_row; row <= last_row; ++row) {
    for (std::int32_t column = first_column; column <= last_column; ++column) {
      for (std::int32_t part = 0; part < kParts; ++part) {
        const std::int32_t px = column * kBlockSize - x, py = row * kBlockSize + part * kPartRows - y;
        const I16 xy = lanes.pairs + bits_as<I16>(splat_u(pair(px, py)));
        const I32 outside = (dot_pairs(step0, xy) + t.edge[0]) | (dot_pairs(step1, xy) + t.edge[1]) |
                            (dot_pairs(step2, xy) + t.edge[2]);
        I32 mask = ~(outside >> 31);
        if (clipped) mask &= inside_box(xy, t.last_x, t.last_y);
        const std::uint32_t bits = sign_bits(mask);
        if (bits == 0) continue;
        covered += static_cast<std::uint32_t>(std::popcount(bits));
        shader.template part<false>(mask, px, py, tile,
                                    block_offset(column, row) + static_cast<std::size_t>(part * kLanes));
      }
    }
  }
  return covered;
}

/// Returns the pixels covered.
template <Shading kShading, bool kDepth, bool kRgb565>
std::uint32_t raster_small(const DrawSetup& d, const SmallTriangle& t, TileOrigin origin, const TileBuffers& tile) {
  const auto* perspective = reinterpret_cast<const PerspectivePlanes*>(&t + 1);
  if constexpr (kPixelwise)
    return visit_small_pixels(t, origin, [&](std::uint32_t x, std::uint32_t y, std::size_t at) {
      draw_pixel<kShading, kDepth, kRgb565>(d, t.planes, perspective, x, y, tile, at);
    });
  else return raster_small_blocks(Shader<kShading, kDepth, kRgb565>(d, t.planes, perspective), t, origin, tile);
}

/// The same of a triangle of fragments.
template <TexelFetch kFetch>
[[gnu::noinline]] std::uint32_t raster_small_fragments(const DrawSetup& d, const SmallTriangle& t, TileOrigin origin,
                                                       const TileBuffers& tile) {
  const auto& texture = *reinterpret_cast<const TexturePlanes*>(&t + 1);
  const FragmentShader<kFetch> shader(d, t.planes, texture, reinterpret_cast<const PerspectivePlanes*>(&t + 2));
  if constexpr (kPixelwise)
    return visit_small_pixels(t, origin, [&](std::uint32_t x, std::uint32_t y, std::size_t at) {
      shader.pixel(x, y, tile, at);
    });
  else return raster_small_blocks(shader, t, origin, tile);
}

}  // namespace
}  // namespace usuzumi::gfx::soft::USUZUMI_KERNEL
