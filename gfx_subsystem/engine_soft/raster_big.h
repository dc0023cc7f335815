// Raster of big triangles, one tile at a time: the tile's own form of the triangle, then blocks that are outside,
// inside or crossed by an edge. Where the processor has no vectors, raster_pixels.h does the same pixel by pixel.
#pragma once

#include "gfx_subsystem/engine_soft/raster_small.h"
#include "gfx_subsystem/engine_soft/tile_triangle.h"

namespace usuzumi::gfx::soft::USUZUMI_KERNEL {
namespace {

/// For a row of blocks, one bit per block: wholly outside of an edge, and not wholly inside of all.
struct RowOfBlocks {
  std::uint32_t outside = 0, crossed = 0;
};

[[gnu::always_inline]] inline RowOfBlocks classify_row(const TileTriangle& t, std::int32_t row) {
  static_assert(kBlocksPerRow % kLanes == 0);
  RowOfBlocks blocks;
  I32 lane{};
  for (int l = 0; l < kLanes; ++l) lane[l] = l * kBlockSize;
  constexpr std::int32_t kSpan = kBlockSize - 1;
  for (std::int32_t first = 0; first < kBlocksPerRow; first += kLanes) {
    I32 outside{}, crossed{};
    for (int i = 0; i < t.edges; ++i) {
      const std::int32_t a = t.a[i], b = t.b[i];
      const I32 e = lane * a + (t.edge[i] + a * (first * kBlockSize) + b * (row * kBlockSize));
      outside |= e + (std::max<std::int32_t>(a, 0) + std::max<std::int32_t>(b, 0)) * kSpan;
      crossed |= e + (std::min<std::int32_t>(a, 0) + std::min<std::int32_t>(b, 0)) * kSpan;
    }
    blocks.outside |= sign_bits(outside) << first;
    blocks.crossed |= sign_bits(crossed) << first;
  }
  return blocks;
}

/// Bits first .. last.
constexpr std::uint32_t bit_range(std::int32_t first, std::int32_t last) { return (2u << last) - (1u << first); }

template <class PixelShader>
[[gnu::always_inline]] inline std::uint32_t raster_blocks(const PixelShader& shader, const TileTriangle& t,
                                                          const TileBuffers& tile) {
  const LanePattern lanes = lane_pattern();
  const I16 box = bits_as<I16>(splat_u(pair(t.x1 - t.x0, t.y1 - t.y0)));
  // Columns of blocks that the box touches, and those it holds from side to side.
  const std::uint32_t touched = bit_range(t.x0 / kBlockSize, t.x1 / kBlockSize);
  const std::uint32_t held = touched & ~((t.x0 % kBlockSize != 0 ? 1u << (t.x0 / kBlockSize) : 0u) |
                                         (t.x1 % kBlockSize != kBlockSize - 1 ? 1u << (t.x1 / kBlockSize) : 0u));
  std::uint32_t covered = 0;
  for (std::int32_t row = t.y0 / kBlockSize; row <= t.y1 / kBlockSize; ++row) {
    const std::int32_t y = row * kBlockSize;
    const RowOfBlocks blocks = t.edges != 0 ? classify_row(t, row) : RowOfBlocks{};
    const std::uint32_t visit = touched & ~blocks.outside;
    const bool row_held = y >= t.y0 && y + kBlockSize - 1 <= t.y1;
    const std::uint32_t whole = row_held ? visit & held & ~blocks.crossed : 0;
    for (std::uint32_t left = whole; left != 0; left &= left - 1) {
      const int column = std::countr_zero(left);
      for (std::int32_t part = 0; part < kParts; ++part)
        shader.template part<true>(I32{}, column * kBlockSize, y + part * kPartRows, tile,
                                   block_offset(column, row) + static_cast<std::size_t>(part * kLanes));
    }
    covered += static_cast<std::uint32_t>(std::popcount(whole) * kBlockPixels);
    for (std::uint32_t left = visit & ~whole; left != 0; left &= left - 1) {
      const int column = std::countr_zero(left);
      const std::int32_t x = column * kBlockSize;
      for (std::int32_t part = 0; part < kParts; ++part) {
        const std::int32_t py = y + part * kPartRows;
        I32 outside{};
        for (int i = 0; i < t.edges; ++i)
          outside |= lanes.x * t.a[i] + lanes.y * t.b[i] + (t.edge[i] + t.a[i] * x + t.b[i] * py);
        const I16 xy = lanes.pairs + bits_as<I16>(splat_u(pair(x - t.x0, py - t.y0)));
        const I32 mask = ~(outside >> 31) & (bits_as<I32>((xy >= 0) & (xy <= box)) == -1);
        const std::uint32_t bits = sign_bits(mask);
        if (bits == 0) continue;
        covered += static_cast<std::uint32_t>(std::popcount(bits));
        shader.template part<false>(mask, x, py, tile,
                                    block_offset(column, row) + static_cast<std::size_t>(part * kLanes));
      }
    }
  }
  return covered;
}

template <Shading kShading, bool kDepth, bool kRgb565>
std::uint32_t raster_colours(const DrawSetup& d, const TileTriangle& t, const TileBuffers& tile) {
  if constexpr (kPixelwise)
    return visit_big_pixels(t, [&](std::uint32_t x, std::uint32_t y, std::size_t at) {
      draw_pixel<kShading, kDepth, kRgb565>(d, t.planes, &t.perspective, x, y, tile, at);
    });
  else return raster_blocks(Shader<kShading, kDepth, kRgb565>(d, t.planes, &t.perspective), t, tile);
}

template <TexelFetch kFetch>
[[gnu::noinline]] std::uint32_t raster_fragments(const DrawSetup& d, const BigTriangle& t, TileOrigin origin,
                                                 const TileBuffers& tile, TileTriangle& local) {
  const TexturePlanes texture = derive_texture(t, origin, local);
  const FragmentShader<kFetch> shader(d, local.planes, texture, &local.perspective);
  if constexpr (kPixelwise)
    return visit_big_pixels(local, [&](std::uint32_t x, std::uint32_t y, std::size_t at) {
      shader.pixel(x, y, tile, at);
    });
  else return raster_blocks(shader, local, tile);
}

/// Returns the pixels covered.
template <bool kRgb565>
std::uint32_t raster_big(const DrawSetup& d, const BigTriangle& t, TileOrigin origin, const TileBuffers& tile) {
  TileTriangle local;
  local.x0 = std::max<std::int32_t>(t.x - origin.x, 0);
  local.y0 = std::max<std::int32_t>(t.y - origin.y, 0);
  local.x1 = std::min<std::int32_t>(t.last_x - origin.x, kTileSize - 1);
  local.y1 = std::min<std::int32_t>(t.last_y - origin.y, kTileSize - 1);
  if (!cross_edges(t, origin, local)) return 0;
  derive_planes(t, origin, local);
  if (static_cast<Shading>(t.shading) == Shading::kFragment)
    return with_fetch(d, [&](auto fetch) {
      return raster_fragments<decltype(fetch)::value>(d, t, origin, tile, local);
    });
  const auto raster = [&](auto depth) {
    constexpr bool kDepth = decltype(depth)::value;
    switch (static_cast<Shading>(t.shading)) {
      case Shading::kConstant: return raster_colours<Shading::kConstant, kDepth, kRgb565>(d, local, tile);
      case Shading::kAffine: return raster_colours<Shading::kAffine, kDepth, kRgb565>(d, local, tile);
      default: return raster_colours<Shading::kPerspective, kDepth, kRgb565>(d, local, tile);
    }
  };
  return d.depth_test ? raster(std::true_type{}) : raster(std::false_type{});
}

}  // namespace
}  // namespace usuzumi::gfx::soft::USUZUMI_KERNEL
