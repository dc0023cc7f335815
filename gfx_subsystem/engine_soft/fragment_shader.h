// The pixel where draws make fragments: depth, texel times colour, alpha test, blending. In the place of Shader.
#pragma once

#include "gfx_subsystem/engine_soft/shader.h"
#include "gfx_subsystem/engine_soft/texture_sampler.h"

namespace usuzumi::gfx::soft::USUZUMI_KERNEL {
namespace {

/// v / 255 rounded to nearest, exact for v <= 255 * 255.
[[gnu::always_inline]] inline Halves over_255(Halves v) {
  v += in_halves<Halves>(128);
  return shifted(v + shifted(v, 8), 8);
}

/// A pixel as a tile's buffer has it, opened into channels of 8 bits, and back.
[[gnu::always_inline]] inline Channels open_pixel(Words pixel, bool rgb565) {
  if (!rgb565) return {bits_as<Halves>(pixel >> 8 & 0xFF), bits_as<Halves>(pixel & 0xFF00FF)};
  const Words red = pixel >> 11 & 31, green = pixel >> 5 & 63, blue = pixel & 31;
  return {bits_as<Halves>(green << 2 | green >> 4),
          bits_as<Halves>((red << 3 | red >> 2) << 16 | blue << 3 | blue >> 2)};
}
[[gnu::always_inline]] inline Words close_pixel(const Channels& c, bool rgb565) {
  const Words high = bits_as<Words>(c.high), low = bits_as<Words>(c.low);
  if (!rgb565) return 0xFF000000u | (high & 0xFF) << 8 | low;
  // round(v * 31 / 255) and round(v * 63 / 255), exact for v <= 255.
  const auto scaled = [](Halves v, std::uint16_t by, std::uint16_t plus, int shift) {
    return bits_as<Words>(shifted(v * by + in_halves<Halves>(plus), shift));
  };
  const Words red_blue = scaled(c.low, 249, 1014, 11), green = scaled(c.high, 253, 505, 10);
  return (red_blue >> 16) << 11 | (green & 63) << 5 | (red_blue & 31);
}

template <TexelFetch kFetch>
class FragmentShader {
 public:
  [[gnu::always_inline]] FragmentShader(const DrawSetup& d, const Planes& planes, const TexturePlanes& texture,
                                        const PerspectivePlanes* perspective)
      : d_(d), p_(planes), texture_(texture), perspective_(perspective), sampler_(d.texture),
        plain_(texture.shading == Shading::kConstant && planes.high == 0xFF00FF && planes.low == 0xFF00FF) {
    depth_ = p_.depth + bits_as<Words>(lane_column<Ints>()) * p_.depth_dx +
             bits_as<Words>(lane_row<Ints>()) * p_.depth_dy;
  }

  /// As Shader::part().
  template <bool kAll>
  [[gnu::always_inline]] void part(Ints mask, std::int32_t x, std::int32_t y, const TileBuffers& tile,
                                   std::size_t at) const {
    draw(kAll ? every<Ints>(-1) : mask, x, y, tile, at);
  }

  /// The same of one pixel, for kPixelwise. Not inlined into both rasters: that takes more code and more time.
  [[gnu::noinline]] void pixel(std::uint32_t x, std::uint32_t y, const TileBuffers& tile, std::size_t at) const {
    draw(every<Ints>(-1), static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), tile, at);
  }

 private:
  /// The alpha test comes before the depth is written.
  [[gnu::always_inline]] void draw(Ints mask, std::int32_t x, std::int32_t y, const TileBuffers& tile,
                                   std::size_t at) const {
    Words depth{};
    if (d_.depth_test) {
      depth = (depth_ + (static_cast<std::uint32_t>(x) * p_.depth_dx + static_cast<std::uint32_t>(y) * p_.depth_dy)) >>
              8;
      mask &= mask_of(bits_as<Ints>(depth) < load<Ints>(tile.depth + at) + d_.depth_bias);
      if (sign_bits(mask) == 0) return;
    }
    Channels c = fragment(mask, x, y);
    if (d_.alpha_reference != 0) {
      mask &= mask_of(alpha_of(c) >= static_cast<std::int32_t>(d_.alpha_reference));
      if (sign_bits(mask) == 0) return;
    }
    if (d_.depth_test)
      store(tile.depth + at, select(mask & d_.depth_write, depth, load<Words>(tile.depth + at)));
    const Words there = load<Words>(tile.colour + at);
    if (d_.blend) c = blended(c, open_pixel(there, d_.rgb565));
    store(tile.colour + at, select(mask, close_pixel(c, d_.rgb565), there));
  }

  struct Place {
    Floats x, y;  // of the pixel, from the planes' origin
    Floats w;
  };

  [[gnu::always_inline]] static Floats plane(const TexturePlanes& p, int k, const Place& at) {
    return (p.value[k] + p.dy[k] * at.y) + p.dx[k] * at.x;
  }

  [[gnu::always_inline]] Channels fragment(Ints mask, std::int32_t x, std::int32_t y) const {
    Place at{to_floats(lane_column<Ints>() + x), to_floats(lane_row<Ints>() + y), Floats{}};
    if (!fetches(TexelFetch::kNone) || texture_.shading == Shading::kPerspective)
      at.w = 1.0f / plane(texture_, 0, at);
    if (fetches(TexelFetch::kNone)) return colour(at, x, y);
    const Channels t = texels(mask, at);
    if (plain_) return t;
    const Channels c = colour(at, x, y);
    return {over_255(product(t.high, c.high)), over_255(product(t.low, c.low))};
  }

  [[gnu::always_inline]] bool fetches(TexelFetch what) const {
    if constexpr (kFetch != TexelFetch::kAny) return kFetch == what;
    return d_.texels_per_pixel == (what == TexelFetch::kNone ? 0 : what == TexelFetch::kNearest ? 1 : 4);
  }

  /// Lanes of one level are sampled together, level after level; mostly there is but one.
  [[gnu::always_inline]] Channels texels(Ints mask, const Place& at) const {
    const Floats s = plane(texture_, 1, at) * at.w, t = plane(texture_, 2, at) * at.w;
    const Floats s_place = wrap(s, d_.texture.wrap_s), t_place = wrap(t, d_.texture.wrap_t);
    const bool nearest = fetches(TexelFetch::kNearest);
    if (!kPixelwise && d_.texture.level_count == 1) return sampler_.sample(s_place, t_place, 0, nearest);
    const Ints level = d_.texture.level_count == 1 ? Ints{} : levels(s, t, at.w);
    if (kPixelwise) return sampler_.sample(s_place, t_place, lane_of(level, 0), nearest);
    Channels out{};
    for (std::uint32_t left = sign_bits(mask); left != 0;) {
      const std::int32_t one = lane_of(level, std::countr_zero(left));
      const Ints here = mask_of(level == one);
      const Channels c = sampler_.sample(s_place, t_place, one, nearest);
      out.high |= c.high & bits_as<Halves>(here);
      out.low |= c.low & bits_as<Halves>(here);
      left &= ~sign_bits(here);
    }
    return out;
  }

  /// The level of each lane, from the exponent of rho^2.
  [[gnu::always_inline]] Ints levels(Floats s, Floats t, Floats w) const {
    const auto width = static_cast<float>(d_.texture.width), height = static_cast<float>(d_.texture.height);
    const auto footprint = [&](const float (&step)[4]) {
      const Floats ds = (step[1] - s * step[0]) * width, dt = (step[2] - t * step[0]) * height;
      return ds * ds + dt * dt;
    };
    const Floats right = footprint(texture_.dx), down = footprint(texture_.dy);
    const Floats rho_squared = (right > down ? right : down) * (w * w);
    const Ints exponent = ((bits_as<Ints>(rho_squared) >> 23) & 0xFF) - 127;
    const Ints level = (exponent + 1) >> 1;
    const auto last = static_cast<std::int32_t>(d_.texture.level_count) - 1;
    return level < 0 ? every<Ints>(0) : level > last ? every<Ints>(last) : level;
  }

  [[gnu::always_inline]] Channels colour(const Place& at, std::int32_t x, std::int32_t y) const {
    switch (texture_.shading) {
      case Shading::kConstant: return {bits_as<Halves>(every<Words>(p_.high)), bits_as<Halves>(every<Words>(p_.low))};
      case Shading::kAffine: {
        const auto word = [&](std::uint32_t base, std::uint32_t dx, std::uint32_t dy) {
          return shifted(affine<Halves>(base, dx, dy, x, y), 8);
        };
        return {word(p_.high, p_.high_dx, p_.high_dy), word(p_.low, p_.low_dx, p_.low_dy)};
      }
      default: break;
    }
    const auto channel = [&](Floats over_w) {
      const Floats c = held(over_w * at.w, 0.0f, d_.lane_limit[1]);
      return bits_as<Words>((to_ints(c) + 128) >> 8);
    };
    const auto over_w = [&](int k) {
      return (perspective_->value[k] + perspective_->dy[k] * at.y) + perspective_->dx[k] * at.x;
    };
    return {bits_as<Halves>(channel(over_w(2)) | channel(plane(texture_, 3, at)) << 16),
            bits_as<Halves>(channel(over_w(3)) | channel(over_w(1)) << 16)};
  }

  [[gnu::always_inline]] static Ints alpha_of(const Channels& c) { return bits_as<Ints>(bits_as<Words>(c.high) >> 16); }

  [[gnu::always_inline]] static Channels blended(const Channels& c, const Channels& there) {
    const Halves alpha = factor(alpha_of(c)), rest = 255 - alpha;
    return {over_255(c.high * alpha + there.high * rest), over_255(c.low * alpha + there.low * rest)};
  }

  const DrawSetup& d_;
  const Planes& p_;
  const TexturePlanes& texture_;
  const PerspectivePlanes* perspective_;
  Sampler sampler_;
  bool plain_;  // the colour changes nothing
  Words depth_;
};

}  // namespace
}  // namespace usuzumi::gfx::soft::USUZUMI_KERNEL
