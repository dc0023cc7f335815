// The pixel's colour and depth: evaluates planes for the lanes of a part of a block, compares depth and writes.
#pragma once

#include "gfx_subsystem/engine_soft/draw_setup.h"
#include "gfx_subsystem/engine_soft/simd.h"

namespace usuzumi::gfx::soft::USUZUMI_KERNEL {
namespace {

/// A part is the kLanes pixels that one vector holds: a block is kParts of them, each kPartRows rows of kBlockSize
/// pixels.
inline constexpr int kPartRows = kLanes / kBlockSize;
inline constexpr int kParts = kBlockPixels / kLanes;

/// Column and row of each lane within its part.
struct LanePattern {
  I32 x, y;
  I16 pairs;       // x in the low half, y in the high half
  U16 x_twice, y_twice;
};

[[gnu::always_inline]] inline LanePattern lane_pattern() {
  LanePattern p{};
  for (int l = 0; l < kLanes; ++l) {
    p.x[l] = l % kBlockSize;
    p.y[l] = l / kBlockSize;
  }
  p.pairs = bits_as<I16>(p.x | p.y << 16);
  p.x_twice = bits_as<U16>(p.x | p.x << 16);
  p.y_twice = bits_as<U16>(p.y | p.y << 16);
  return p;
}

/// Where a tile's pixels are while it is worked on.
struct TileBuffers {
  std::uint32_t* colour;
  std::uint32_t* depth;
};

/// Position of a tile's first pixel on the target.
struct TileOrigin {
  std::int32_t x, y;
};

[[gnu::always_inline]] inline std::size_t block_offset(std::int32_t column, std::int32_t row) {
  return static_cast<std::size_t>(row * kBlocksPerRow + column) * kBlockPixels;
}

/// A pixel of the two words of colour lanes; Word is a vector of them or one alone.
template <bool kRgb565, class Word>
[[gnu::always_inline]] inline Word pack_lanes(Word high, Word low) {
  if constexpr (kRgb565) return (low >> 16 & 0xF800) | (high >> 5 & 0x07E0) | (low >> 11 & 0x001F);
  return 0xFF000000u | (high & 0xFF00) | (low >> 8 & 0xFF00FF);
}

/// Planes are split in two: what depends on the lane is added up once per triangle, what depends on the part is one
/// scalar. The sums are modulo their width, so the split does not change them.
template <Shading kShading, bool kDepth, bool kRgb565>
class Shader {
 public:
  [[gnu::always_inline]] Shader(const DrawSetup& d, const Planes& planes, const PerspectivePlanes* perspective)
      : d_(d), p_(planes), perspective_(perspective) {
    const LanePattern lanes = lane_pattern();
    if constexpr (kDepth) depth_ = p_.depth + bits_as<U32>(lanes.x) * p_.depth_dx + bits_as<U32>(lanes.y) * p_.depth_dy;
    if constexpr (kShading == Shading::kAffine) {
      const auto plane = [&](std::uint32_t base, std::uint32_t dx, std::uint32_t dy) {
        return bits_as<U16>(splat_u(base)) + bits_as<U16>(splat_u(dx)) * lanes.x_twice +
               bits_as<U16>(splat_u(dy)) * lanes.y_twice;
      };
      high_ = plane(p_.high, p_.high_dx, p_.high_dy);
      low_ = plane(p_.low, p_.low_dx, p_.low_dy);
    }
  }

  /// Writes the lanes of `mask`, or all. (x, y) is the part's first pixel, counted from the planes' origin; `at` its
  /// place in the tile.
  template <bool kAll>
  [[gnu::always_inline]] void part(I32 mask, std::int32_t x, std::int32_t y, const TileBuffers& tile,
                                   std::size_t at) const {
    const auto ux = static_cast<std::uint32_t>(x), uy = static_cast<std::uint32_t>(y);
    if constexpr (kDepth) {
      const U32 depth = (depth_ + (ux * p_.depth_dx + uy * p_.depth_dy)) >> 8;
      const U32 stored = load<U32>(tile.depth + at);
      const I32 passes = bits_as<I32>(depth) < bits_as<I32>(stored) + d_.depth_bias;
      mask = kAll ? passes : mask & passes;
      store(tile.depth + at, select(mask & d_.depth_write, depth, stored));
    }
    if constexpr (kAll && !kDepth) store(tile.colour + at, colour(x, y));
    else store(tile.colour + at, select(mask, colour(x, y), load<U32>(tile.colour + at)));
  }

 private:
  [[gnu::always_inline]] U32 colour(std::int32_t x, std::int32_t y) const {
    if constexpr (kShading == Shading::kConstant) return splat_u(p_.high);
    if constexpr (kShading == Shading::kAffine) {
      const auto ux = static_cast<std::uint32_t>(x), uy = static_cast<std::uint32_t>(y);
      const std::uint32_t high = ux * p_.high_dx + uy * p_.high_dy;  // its upper lane is not used
      const std::uint32_t low = ((ux * (p_.low_dx & 0xFFFF) + uy * (p_.low_dy & 0xFFFF)) & 0xFFFF) |
                                (ux * (p_.low_dx >> 16) + uy * (p_.low_dy >> 16)) << 16;
      return pack(bits_as<U32>(high_ + bits_as<U16>(splat_u(high))), bits_as<U32>(low_ + bits_as<U16>(splat_u(low))));
    }
    return perspective_colour(x, y);
  }

  [[gnu::always_inline]] U32 perspective_colour(std::int32_t x, std::int32_t y) const {
    const LanePattern lanes = lane_pattern();
    const F32 xs = __builtin_convertvector(lanes.x + x, F32), ys = __builtin_convertvector(lanes.y + y, F32);
    const auto plane = [&](int k) {
      return (perspective_->value[k] + perspective_->dy[k] * ys) + perspective_->dx[k] * xs;
    };
    const F32 w = 1.0f / plane(0);
    U32 lane[3];
    for (int k = 0; k < 3; ++k) {
      F32 c = plane(k + 1) * w;
      c = c > 0.0f ? c : splat_f(0);  // not a number becomes 0
      c = c < d_.lane_limit[k] ? c : splat_f(d_.lane_limit[k]);
      lane[k] = bits_as<U32>(__builtin_convertvector(c, I32)) + d_.lane_half[k];
    }
    return pack(lane[1], lane[2] | lane[0] << 16);
  }

  [[gnu::always_inline]] static U32 pack(U32 high, U32 low) { return pack_lanes<kRgb565>(high, low); }

  const DrawSetup& d_;
  const Planes& p_;
  const PerspectivePlanes* perspective_;
  U32 depth_{};
  U16 high_{}, low_{};
};

}  // namespace
}  // namespace usuzumi::gfx::soft::USUZUMI_KERNEL
