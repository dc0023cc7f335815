// A big triangle as one tile sees it: the edges that cross it, planes that count from its first pixel.
#pragma once

#include "gfx_subsystem/engine_soft/draw_setup.h"
#include "gfx_subsystem/engine_soft/shader.h"

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

}  // namespace
}  // namespace usuzumi::gfx::soft::USUZUMI_KERNEL
