// The pixel where draws make fragments: depth, texel times colour, alpha test, blending. In the place of Shader.
#pragma once

#include "gfx_subsystem/engine_soft/shader.h"
#include "gfx_subsystem/engine_soft/texture_sampler.h"

namespace usuzumi::gfx::soft::USUZUMI_KERNEL {
namespace {

/// v / 255 rounded to nearest, exact for v <= 255 * 255.
[[gnu::always_inline]] inline U16 over_255(U16 v) {
  v += 128;
  return (v + (v >> 8)) >> 8;
}

/// A pixel as a tile's buffer has it, opened into channels of 8 bits, and back.
[[gnu::always_inline]] inline Channels open_pixel(U32 pixel, bool rgb565) {
  if (!rgb565) return {bits_as<U16>(pixel >> 8 & 0xFF), bits_as<U16>(pixel & 0xFF00FF)};
  const U32 red = pixel >> 11 & 31, green = pixel >> 5 & 63, blue = pixel & 31;
  return {bits_as<U16>(green << 2 | green >> 4),
          bits_as<U16>((red << 3 | red >> 2) << 16 | blue << 3 | blue >> 2)};
}
[[gnu::always_inline]] inline U32 close_pixel(const Channels& c, bool rgb565) {
  const U32 high = bits_as<U32>(c.high), low = bits_as<U32>(c.low);
  if (!rgb565) return 0xFF000000u | (high & 0xFF) << 8 | low;
  // round(v * 31 / 255) and round(v * 63 / 255), exact for v <= 255.
  const U32 red_blue = bits_as<U32>((c.low * 249 + 1014) >> 11), green = bits_as<U32>((c.high * 253 + 505) >> 10);
  return (red_blue >> 16) << 11 | (green & 63) << 5 | (red_blue & 31);
}

template <TexelFetch kFetch>
class FragmentShader {
 public:
  [[gnu::always_inline]] FragmentShader(const DrawSetup& d, const Planes& planes, const TexturePlanes& texture,
                                        const PerspectivePlanes* perspective)
      : d_(d), p_(planes), texture_(texture), perspective_(perspective), sampler_(d.texture),
        plain_(texture.shading == Shading::kConstant && planes.high == 0xFF00FF && planes.low == 0xFF00FF) {
    const LanePattern lanes = lane_pattern();
    depth_ = p_.depth + bits_as<U32>(lanes.x) * p_.depth_dx + bits_as<U32>(lanes.y) * p_.depth_dy;
  }

  /// As Shader::part(). The alpha test comes before the depth is written.
  template <bool kAll>
  [[gnu::always_inline]] void part(I32 mask, std::int32_t x, std::int32_t y, const TileBuffers& tile,
                                   std::size_t at) const {
    if constexpr (kAll) mask = splat(-1);
    U32 depth{};
    if (d_.depth_test) {
      depth = (depth_ + (static_cast<std::uint32_t>(x) * p_.depth_dx + static_cast<std::uint32_t>(y) * p_.depth_dy)) >>
              8;
      mask &= bits_as<I32>(depth) < load<I32>(tile.depth + at) + d_.depth_bias;
      if (sign_bits(mask) == 0) return;
    }
    Channels c = fragment(mask, x, y);
    if (d_.alpha_reference != 0) {
      mask &= bits_as<I32>(bits_as<U32>(c.high) >> 16) >= static_cast<std::int32_t>(d_.alpha_reference);
      if (sign_bits(mask) == 0) return;
    }
    if (d_.depth_test)
      store(tile.depth + at, select(mask & d_.depth_write, depth, load<U32>(tile.depth + at)));
    const U32 there = load<U32>(tile.colour + at);
    if (d_.blend) c = blended(c, open_pixel(there, d_.rgb565));
    store(tile.colour + at, select(mask, close_pixel(c, d_.rgb565), there));
  }

 private:
  struct Place {
    F32 x, y;  // of the pixel, from the planes' origin
    F32 w;
  };

  [[gnu::always_inline]] static F32 plane(const TexturePlanes& p, int k, const Place& at) {
    return (p.value[k] + p.dy[k] * at.y) + p.dx[k] * at.x;
  }

  [[gnu::always_inline]] Channels fragment(I32 mask, std::int32_t x, std::int32_t y) const {
    const LanePattern lanes = lane_pattern();
    Place at{__builtin_convertvector(lanes.x + x, F32), __builtin_convertvector(lanes.y + y, F32), F32{}};
    if (kFetch != TexelFetch::kNone || texture_.shading == Shading::kPerspective)
      at.w = 1.0f / plane(texture_, 0, at);
    if constexpr (kFetch == TexelFetch::kNone) return colour(at, x, y);
    const Channels t = texels(mask, at);
    if (plain_) return t;
    const Channels c = colour(at, x, y);
    return {over_255(t.high * c.high), over_255(t.low * c.low)};
  }

  /// Lanes of one level are sampled together, level after level; mostly there is but one.
  [[gnu::always_inline]] Channels texels(I32 mask, const Place& at) const {
    const F32 s = plane(texture_, 1, at) * at.w, t = plane(texture_, 2, at) * at.w;
    const F32 s_place = wrap(s, d_.texture.wrap_s), t_place = wrap(t, d_.texture.wrap_t);
    if (d_.texture.level_count == 1) return sampler_.template sample<kFetch>(s_place, t_place, 0);
    const I32 level = levels(s, t, at.w);
    Channels out{};
    for (std::uint32_t left = sign_bits(mask); left != 0;) {
      const std::int32_t one = level[std::countr_zero(left)];
      const I32 here = level == one;
      const Channels c = sampler_.template sample<kFetch>(s_place, t_place, one);
      out.high |= c.high & bits_as<U16>(here);
      out.low |= c.low & bits_as<U16>(here);
      left &= ~sign_bits(here);
    }
    return out;
  }

  /// The level of each lane, from the exponent of rho^2.
  [[gnu::always_inline]] I32 levels(F32 s, F32 t, F32 w) const {
    const auto width = static_cast<float>(d_.texture.width), height = static_cast<float>(d_.texture.height);
    const auto footprint = [&](const float (&step)[4]) {
      const F32 ds = (step[1] - s * step[0]) * width, dt = (step[2] - t * step[0]) * height;
      return ds * ds + dt * dt;
    };
    const F32 right = footprint(texture_.dx), down = footprint(texture_.dy);
    const F32 rho_squared = (right > down ? right : down) * (w * w);
    const I32 exponent = ((bits_as<I32>(rho_squared) >> 23) & 0xFF) - 127;
    const I32 level = (exponent + 1) >> 1;
    const auto last = static_cast<std::int32_t>(d_.texture.level_count) - 1;
    return level < 0 ? splat(0) : level > last ? splat(last) : level;
  }

  [[gnu::always_inline]] Channels colour(const Place& at, std::int32_t x, std::int32_t y) const {
    switch (texture_.shading) {
      case Shading::kConstant: return {bits_as<U16>(splat_u(p_.high)), bits_as<U16>(splat_u(p_.low))};
      case Shading::kAffine: {
        const LanePattern lanes = lane_pattern();
        const auto lane = [&](std::uint32_t base, std::uint32_t dx, std::uint32_t dy) {
          const U16 xs = lanes.x_twice + static_cast<std::uint16_t>(x),
                    ys = lanes.y_twice + static_cast<std::uint16_t>(y);
          return (bits_as<U16>(splat_u(base)) + bits_as<U16>(splat_u(dx)) * xs + bits_as<U16>(splat_u(dy)) * ys) >> 8;
        };
        return {lane(p_.high, p_.high_dx, p_.high_dy), lane(p_.low, p_.low_dx, p_.low_dy)};
      }
      default: break;
    }
    const auto channel = [&](F32 over_w) {
      const F32 c = held(over_w * at.w, 0.0f, d_.lane_limit[1]);
      return bits_as<U32>((__builtin_convertvector(c, I32) + 128) >> 8);
    };
    const auto over_w = [&](int k) {
      return (perspective_->value[k] + perspective_->dy[k] * at.y) + perspective_->dx[k] * at.x;
    };
    return {bits_as<U16>(channel(over_w(2)) | channel(plane(texture_, 3, at)) << 16),
            bits_as<U16>(channel(over_w(3)) | channel(over_w(1)) << 16)};
  }

  [[gnu::always_inline]] static Channels blended(const Channels& c, const Channels& there) {
    const U32 high = bits_as<U32>(c.high);
    const U16 alpha = bits_as<U16>((high >> 16) | (high & 0xFFFF0000u)), rest = 255 - alpha;
    return {over_255(c.high * alpha + there.high * rest), over_255(c.low * alpha + there.low * rest)};
  }

  const DrawSetup& d_;
  const Planes& p_;
  const TexturePlanes& texture_;
  const PerspectivePlanes* perspective_;
  Sampler sampler_;
  bool plain_;  // the colour changes nothing
  U32 depth_;
};

}  // namespace
}  // namespace usuzumi::gfx::soft::USUZUMI_KERNEL
