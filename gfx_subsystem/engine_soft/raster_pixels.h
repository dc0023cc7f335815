// Rasters for a processor without vectors: edge functions stepped from pixel to pixel. The pixels are those of
// raster_small.h and raster_big.h: the same sums modulo 2^32 and 2^16, the same float operations in the same order.
#pragma once

#include <algorithm>

#include "gfx_subsystem/engine_soft/fragment_shader.h"
#include "gfx_subsystem/engine_soft/tile_triangle.h"

namespace usuzumi::gfx::soft::USUZUMI_KERNEL {
namespace {

/// The colour of one pixel, (x, y) counted from the planes' origin.
template <Shading kShading, bool kRgb565>
[[gnu::always_inline]] inline std::uint32_t pixel_colour(const DrawSetup& d, const Planes& p,
                                                         const PerspectivePlanes* perspective, std::uint32_t x,
                                                         std::uint32_t y) {
  if constexpr (kShading == Shading::kConstant) return p.high;
  if constexpr (kShading == Shading::kAffine) {
    // Lane by lane: what a lower one carries into a higher one is not looked at.
    const std::uint32_t green = p.high + x * p.high_dx + y * p.high_dy;
    const std::uint32_t blue = p.low + x * p.low_dx + y * p.low_dy;
    const std::uint32_t red = (p.low >> 16) + x * (p.low_dx >> 16) + y * (p.low_dy >> 16);
    return pack_lanes<kRgb565>(green, (blue & 0xFFFF) | red << 16);
  }
  const auto xs = static_cast<float>(static_cast<std::int32_t>(x));
  const auto ys = static_cast<float>(static_cast<std::int32_t>(y));
  const auto plane = [&](int k) { return (perspective->value[k] + perspective->dy[k] * ys) + perspective->dx[k] * xs; };
  const float w = 1.0f / plane(0);
  std::uint32_t lane[3];
  for (int k = 0; k < 3; ++k) {
    float c = plane(k + 1) * w;
    c = c > 0.0f ? c : 0.0f;  // not a number becomes 0
    c = c < d.lane_limit[k] ? c : d.lane_limit[k];
    lane[k] = static_cast<std::uint32_t>(static_cast<std::int32_t>(c)) + d.lane_half[k];
  }
  return pack_lanes<kRgb565>(lane[1], lane[2] | lane[0] << 16);
}

/// Calls visit(x, y, at) for every pixel covered, (x, y) counted from the planes' origin, `at` its place in the tile.
/// Returns how many. Of a triangle that its box does not cut, no pixel outside the box is covered.
template <class Visit>
[[gnu::always_inline]] inline std::uint32_t visit_small_pixels(const SmallTriangle& t, TileOrigin origin, Visit visit) {
  const std::int32_t x = t.x - origin.x, y = t.y - origin.y;  // of the record's origin pixel within the tile
  constexpr std::int32_t kLast = kTileSize - 1;
  const std::int32_t first_x = std::max<std::int32_t>(x, 0), last_x = std::min<std::int32_t>(x + t.last_x, kLast);
  const std::int32_t first_y = std::max<std::int32_t>(y, 0), last_y = std::min<std::int32_t>(y + t.last_y, kLast);
  std::uint32_t row_edge[3], step_x[3], step_y[3];
  for (int k = 0; k < 2; ++k) {
    step_x[k] = static_cast<std::uint32_t>(std::int32_t{t.step[k][0]});
    step_y[k] = static_cast<std::uint32_t>(std::int32_t{t.step[k][1]});
  }
  step_x[2] = 0u - step_x[0] - step_x[1];
  step_y[2] = 0u - step_y[0] - step_y[1];
  const auto px0 = static_cast<std::uint32_t>(first_x - x), py0 = static_cast<std::uint32_t>(first_y - y);
  for (int k = 0; k < 3; ++k)
    row_edge[k] = static_cast<std::uint32_t>(t.edge[k]) + px0 * step_x[k] + py0 * step_y[k];
  std::uint32_t covered = 0;
  for (std::int32_t row = first_y; row <= last_y; ++row) {
    std::uint32_t e0 = row_edge[0], e1 = row_edge[1], e2 = row_edge[2];
    const auto py = static_cast<std::uint32_t>(row - y);
    for (std::int32_t column = first_x; column <= last_x; ++column) {
      const bool inside = static_cast<std::int32_t>(e0 | e1 | e2) >= 0;
      e0 += step_x[0], e1 += step_x[1], e2 += step_x[2];
      if (!inside) continue;
      ++covered;
      visit(static_cast<std::uint32_t>(column - x), py,
            block_offset(column / kBlockSize, row / kBlockSize) +
                static_cast<std::size_t>(row % kBlockSize * kBlockSize + column % kBlockSize));
    }
    for (int k = 0; k < 3; ++k) row_edge[k] += step_y[k];
  }
  return covered;
}

/// The same of a big triangle: blocks that are not outside of an edge, their pixels within the box.
template <class Visit>
[[gnu::always_inline]] inline std::uint32_t visit_big_pixels(const TileTriangle& t, Visit visit) {
  constexpr std::int32_t kSpan = kBlockSize - 1;
  std::int32_t edge[3] = {}, a[3] = {}, b[3] = {};  // one that does not cross the tile stays 0, which is inside
  for (int k = 0; k < t.edges; ++k) {
    edge[k] = t.edge[k];
    a[k] = t.a[k];
    b[k] = t.b[k];
  }
  std::uint32_t covered = 0;
  for (std::int32_t row = t.y0 / kBlockSize; row <= t.y1 / kBlockSize; ++row) {
    for (std::int32_t column = t.x0 / kBlockSize; column <= t.x1 / kBlockSize; ++column) {
      const std::int32_t x = column * kBlockSize, y = row * kBlockSize;
      std::int32_t outside = 0;
      for (int k = 0; k < 3; ++k)
        outside |= edge[k] + a[k] * (x + (a[k] > 0 ? kSpan : 0)) + b[k] * (y + (b[k] > 0 ? kSpan : 0));
      if (outside < 0) continue;
      const std::int32_t first_x = std::max(x, t.x0), last_x = std::min(x + kSpan, t.x1);
      for (std::int32_t py = std::max(y, t.y0); py <= std::min(y + kSpan, t.y1); ++py) {
        std::int32_t e[3];
        for (int k = 0; k < 3; ++k) e[k] = edge[k] + a[k] * first_x + b[k] * py;
        std::size_t at = block_offset(column, row) + static_cast<std::size_t>((py - y) * kBlockSize + (first_x - x));
        for (std::int32_t px = first_x; px <= last_x; ++px, ++at) {
          const bool inside = (e[0] | e[1] | e[2]) >= 0;
          for (int k = 0; k < 3; ++k) e[k] += a[k];
          if (!inside) continue;
          ++covered;
          visit(static_cast<std::uint32_t>(px), static_cast<std::uint32_t>(py), at);
        }
      }
    }
  }
  return covered;
}

/// Depth and colour of one pixel where there are no fragments.
template <Shading kShading, bool kDepth, bool kRgb565>
[[gnu::always_inline]] inline void draw_pixel(const DrawSetup& d, const Planes& p, const PerspectivePlanes* perspective,
                                              std::uint32_t x, std::uint32_t y, const TileBuffers& tile,
                                              std::size_t at) {
  if constexpr (kDepth) {
    const std::uint32_t depth = (p.depth + x * p.depth_dx + y * p.depth_dy) >> 8;
    if (static_cast<std::int32_t>(depth) >= static_cast<std::int32_t>(tile.depth[at]) + d.depth_bias) return;
    if (d.depth_write != 0) tile.depth[at] = depth;
  }
  tile.colour[at] = pixel_colour<kShading, kRgb565>(d, p, perspective, x, y);
}

}  // namespace
}  // namespace usuzumi::gfx::soft::USUZUMI_KERNEL
