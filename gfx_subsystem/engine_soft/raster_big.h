// Raster of big triangles, one tile at a time: the tile's own form of the triangle, then blocks that are outside,
// inside or crossed by an edge.
#pragma once

#include "gfx_subsystem/engine_soft/raster_small.h"

namespace usuzumi::gfx::soft::USUZUMI_KERNEL {
namespace {

/// A big triangle within one tile. Pixel offsets count from the tile's first pixel.
struct TileTriangle {
  std::int32_t edge[3], a[3], b[3];   // |a|, |b| < 2^23 and the edge crosses the tile, so every e in it is below 2^31
  int edges;                          // that cross; the tile lies inside of the others
  std::int32_t x0, y0, x1, y1;        // bounding box within the tile, inclusive
  Planes planes;
  PerspectivePlanes perspective{};
};

/// Keeps the edges that cross the box. False when the box is all outside of one of them.
inline bool cross_edges(const BigTriangle& t, TileOrigin origin, TileTriangle& out) {
  out.edges = 0;
  for (int i = 0; i < 3; ++i) {
    const std::int64_t a = t.a[i], b = t.b[i];
    const std::int64_t e = (t.edge[i] + (a * origin.x + b * origin.y) * kSubpixelOne) >> kSubpixelBits;
    const std::int64_t most = e + std::max(a * out.x0, a * out.x1) + std::max(b * out.y0, b * out.y1);
    const std::int64_t least = e + std::min(a * out.x0, a * out.x1) + std::min(b * out.y0, b * out.y1);
    if (most < 0) return false;
    if (least >= 0) continue;
    out.edge[out.edges] = static_cast<std::int32_t>(e);
    out.a[out.edges] = t.a[i];
    out.b[out.edges] = t.b[i];
    ++out.edges;
  }
  return true;
}

struct BigPlane {
  std::uint32_t value, dx, dy;
};
/// A plane (dx, dy) away in 24.8. All modulo 2^64, of which the low 40 bits of the result are right.
[[gnu::always_inline]] inline BigPlane derive_plane(std::uint64_t value, std::uint64_t step_x, std::uint64_t step_y,
                                                    std::int32_t dx, std::int32_t dy) {
  const auto wide = [](std::int32_t v) { return static_cast<std::uint64_t>(std::int64_t{v}); };
  const auto shifted = [](std::uint64_t v, int by) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(v) >> by);
  };
  return {static_cast<std::uint32_t>(
              shifted(value + shifted(step_x * wide(dx) + step_y * wide(dy), kSubpixelBits), 16)),
          static_cast<std::uint32_t>(shifted(step_x + 0x8000, 16)),
          static_cast<std::uint32_t>(shifted(step_y + 0x8000, 16))};
}

/// Perspective planes at the tile's first pixel.
inline void derive_perspective(const BigTriangle& t, TileOrigin origin, TileTriangle& out) {
  const double px = static_cast<double>(origin.x * kSubpixelOne + kSubpixelHalf - t.from_x) / kSubpixelOne;
  const double py = static_cast<double>(origin.y * kSubpixelOne + kSubpixelHalf - t.from_y) / kSubpixelOne;
  for (int k = 0; k < 4; ++k) {
    out.perspective.value[k] =
        static_cast<float>(t.perspective[k] + t.perspective_dx[k] * px + t.perspective_dy[k] * py);
    out.perspective.dx[k] = static_cast<float>(t.perspective_dx[k]);
    out.perspective.dy[k] = static_cast<float>(t.perspective_dy[k]);
  }
}

/// Planes at the tile's first pixel.
inline void derive_planes(const BigTriangle& t, TileOrigin origin, TileTriangle& out) {
  std::uint32_t base[4], step_x[4], step_y[4];
  for (int k = 0; k < 4; ++k) {
    const BigPlane p = derive_plane(t.plane[k], t.plane_dx[k], t.plane_dy[k],
                                    origin.x * kSubpixelOne + kSubpixelHalf - t.from_x,
                                    origin.y * kSubpixelOne + kSubpixelHalf - t.from_y);
    base[k] = p.value;
    step_x[k] = p.dx;
    step_y[k] = p.dy;
  }
  const auto low = [](const std::uint32_t* v) { return (v[2] & 0xFFFF) | v[0] << 16; };
  out.planes = {base[3],     step_x[3],          step_y[3],  base[1] & 0xFFFF, low(base), step_x[1] & 0xFFFF,
                low(step_x), step_y[1] & 0xFFFF, low(step_y)};
  const auto shading = static_cast<Shading>(t.shading);
  if (shading == Shading::kConstant) out.planes.high = t.constant_pixel;
  if (shading == Shading::kPerspective) derive_perspective(t, origin, out);
}

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
  return raster_blocks(Shader<kShading, kDepth, kRgb565>(d, t.planes, &t.perspective), t, tile);
}

/// Derives what a triangle of fragments has besides its planes.
inline TexturePlanes derive_texture(const BigTriangle& t, TileOrigin origin, TileTriangle& out) {
  const auto& big = *reinterpret_cast<const BigTexture*>(&t + 1);
  TexturePlanes local{};
  local.shading = big.shading;
  const std::int32_t dx = origin.x * kSubpixelOne + kSubpixelHalf - t.from_x,
                     dy = origin.y * kSubpixelOne + kSubpixelHalf - t.from_y;
  const double px = static_cast<double>(dx) / kSubpixelOne, py = static_cast<double>(dy) / kSubpixelOne;
  for (int k = 0; k < 4; ++k) {
    local.value[k] = static_cast<float>(big.value[k] + big.dx[k] * px + big.dy[k] * py);
    local.dx[k] = static_cast<float>(big.dx[k]);
    local.dy[k] = static_cast<float>(big.dy[k]);
  }
  if (big.shading == Shading::kConstant) {
    out.planes.high = t.constant_pixel;
    out.planes.low = big.constant_low;
  } else if (big.shading == Shading::kAffine) {
    const BigPlane a = derive_plane(big.alpha, big.alpha_dx, big.alpha_dy, dx, dy);
    out.planes.high |= a.value << 16;
    out.planes.high_dx |= a.dx << 16;
    out.planes.high_dy |= a.dy << 16;
  } else {
    derive_perspective(t, origin, out);
  }
  return local;
}

template <TexelFetch kFetch>
[[gnu::noinline]] std::uint32_t raster_fragments(const DrawSetup& d, const BigTriangle& t, TileOrigin origin,
                                                 const TileBuffers& tile, TileTriangle& local) {
  const TexturePlanes texture = derive_texture(t, origin, local);
  return raster_blocks(FragmentShader<kFetch>(d, local.planes, texture, &local.perspective), local, tile);
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
