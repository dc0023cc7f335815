// Texels for the lanes of a part: wrapping, the level, nearest and bilinear. See conventions.h for the numbers.
#pragma once

#include "gfx_subsystem/engine_soft/draw_setup.h"
#include "gfx_subsystem/engine_soft/simd.h"

namespace usuzumi::gfx::soft::USUZUMI_KERNEL {
namespace {

/// How many texels make a fragment; each its own code.
enum class TexelFetch { kNone, kNearest, kBilinear };

/// Calls f with the draw's TexelFetch as an integral_constant.
template <class F>
[[gnu::always_inline]] inline auto with_fetch(const DrawSetup& d, F f) {
  if (d.texels_per_pixel == 4) return f(std::integral_constant<TexelFetch, TexelFetch::kBilinear>{});
  if (d.texels_per_pixel == 1) return f(std::integral_constant<TexelFetch, TexelFetch::kNearest>{});
  return f(std::integral_constant<TexelFetch, TexelFetch::kNone>{});
}

/// Four channels of 8 bits in 16-bit lanes, as the words of Planes: green and alpha, blue and red.
struct Channels {
  U16 high, low;
};

[[gnu::always_inline]] inline F32 floor_of(F32 v) {  // |v| <= kMaxTexturePlace
  const F32 whole = __builtin_convertvector(__builtin_convertvector(v, I32), F32);
  return whole > v ? whole - 1.0f : whole;
}

/// Not a number becomes the lower limit.
[[gnu::always_inline]] inline F32 held(F32 v, float low, float high) {
  v = v > low ? v : splat_f(low);
  return v < high ? v : splat_f(high);
}

/// A coordinate as a place along the image, in [0, 1].
[[gnu::always_inline]] inline F32 wrap(F32 v, command::TextureWrap mode) {
  if (mode == command::TextureWrap::kClamp) return held(v, 0.0f, 1.0f);
  v = held(v, -kMaxTexturePlace, kMaxTexturePlace);
  if (mode == command::TextureWrap::kRepeat) return v - floor_of(v);
  const F32 half = v * 0.5f;
  const F32 turned = (half - floor_of(half)) * 2.0f;  // [0, 2]: there and back
  return turned > 1.0f ? 2.0f - turned : turned;
}

class Sampler {
 public:
  [[gnu::always_inline]] explicit Sampler(const TextureSetup& t)
      : t_(t), opaque_(t.format == command::TextureFormat::kArgb8888 ? 0 : 0xFF000000u),
        narrow_(t.format == command::TextureFormat::kRgb565),
        turns_s_(t.wrap_s == command::TextureWrap::kRepeat), turns_t_(t.wrap_t == command::TextureWrap::kRepeat) {}

  /// s and t are places; `level` is within the texture.
  template <TexelFetch kFetch>
  [[gnu::always_inline]] Channels sample(F32 s, F32 t, std::int32_t level) const {
    const Level l(t_, level);
    if constexpr (kFetch == TexelFetch::kNearest) {
      const auto texel = [](F32 place, std::int32_t size) {
        const I32 at = __builtin_convertvector(place * static_cast<float>(size), I32);
        return at < size ? at : splat(size - 1);
      };
      return split(fetch(l, texel(t, l.height) * l.pitch, texel(s, l.width)));
    }
    const Pair x = pair_of(s, l.width, turns_s_), y = pair_of(t, l.height, turns_t_);
    const I32 row0 = y.first * l.pitch, row1 = y.second * l.pitch;
    const U16 fx = twice(x.fraction), fy = twice(y.fraction);
    const Channels top = mix(split(fetch(l, row0, x.first)), split(fetch(l, row0, x.second)), fx);
    const Channels bottom = mix(split(fetch(l, row1, x.first)), split(fetch(l, row1, x.second)), fx);
    return mix(top, bottom, fy);
  }

 private:
  struct Level {
    const std::byte* texels;
    std::int32_t width, height, pitch;
    [[gnu::always_inline]] Level(const TextureSetup& t, std::int32_t level)
        : texels(t.texels + t.offset[level]), width(std::max<std::int32_t>(t.width >> level, 1)),
          height(std::max<std::int32_t>(t.height >> level, 1)),
          pitch(t.format == command::TextureFormat::kRgb565 ? (width * 2 + 3) & ~3 : width * 4) {}
  };

  /// Neighbours that a place lies between, and how far from the first, 0..255.
  struct Pair {
    I32 first, second, fraction;
  };
  [[gnu::always_inline]] static Pair pair_of(F32 place, std::int32_t size, bool turns) {
    const I32 at = __builtin_convertvector(place * static_cast<float>(size * 256) + 0.5f, I32) - 128;
    const I32 first = at >> 8, second = first + 1;  // -1 .. size
    return {first < 0 ? splat(turns ? size - 1 : 0) : first, second >= size ? splat(turns ? 0 : size - 1) : second,
            at & 0xFF};
  }

  /// A texel each as alpha, red, green, blue. Rows are padded to words, so a word that holds a texel is all in memory.
  [[gnu::always_inline]] U32 fetch(const Level& l, I32 row, I32 x) const {
    if (!narrow_) return gather_words(l.texels, row + x * 4) | opaque_;
    const U32 v = gather_words(l.texels, row + (x >> 1) * 4) >> bits_as<U32>((x & 1) * 16);
    return 0xFF000000u | (v & 0xF800) << 8 | (v & 0xE000) << 3 | (v & 0x07E0) << 5 | (v & 0x0600) >> 1 |
           (v & 0x001F) << 3 | (v & 0x001C) >> 2;
  }

  [[gnu::always_inline]] static Channels split(U32 argb) {
    return {bits_as<U16>(argb >> 8 & 0xFF00FF), bits_as<U16>(argb & 0xFF00FF)};
  }
  [[gnu::always_inline]] static U16 twice(I32 v) { return bits_as<U16>(v | v << 16); }
  [[gnu::always_inline]] static U16 mix(U16 a, U16 b, U16 f) { return ((a << 8) + (b - a) * f + 128) >> 8; }
  [[gnu::always_inline]] static Channels mix(const Channels& a, const Channels& b, U16 f) {
    return {mix(a.high, b.high, f), mix(a.low, b.low, f)};
  }

  const TextureSetup& t_;
  std::uint32_t opaque_;
  bool narrow_, turns_s_, turns_t_;
};

}  // namespace
}  // namespace usuzumi::gfx::soft::USUZUMI_KERNEL
