// Texels of fragments: wrapping, the level, nearest and bilinear. See conventions.h for the numbers.
#pragma once

#include "gfx_subsystem/engine_soft/draw_setup.h"
#include "gfx_subsystem/engine_soft/fragment_lanes.h"

namespace usuzumi::gfx::soft::USUZUMI_KERNEL {
namespace {

/// How many texels make a fragment; each its own code. Where fragments are worked out pixel by pixel, code is dear and
/// a branch is not: there kAny asks the draw.
enum class TexelFetch { kNone, kNearest, kBilinear, kAny };

/// Calls f with the draw's TexelFetch, or kAny, as an integral_constant.
template <class F>
[[gnu::always_inline]] inline auto with_fetch(const DrawSetup& d, F f) {
  if constexpr (kPixelwise) return f(std::integral_constant<TexelFetch, TexelFetch::kAny>{});
  else if (d.texels_per_pixel == 4) return f(std::integral_constant<TexelFetch, TexelFetch::kBilinear>{});
  else if (d.texels_per_pixel == 1) return f(std::integral_constant<TexelFetch, TexelFetch::kNearest>{});
  else return f(std::integral_constant<TexelFetch, TexelFetch::kNone>{});
}

/// Four channels of 8 bits in halves of 16, as the words of Planes: green and alpha, blue and red.
struct Channels {
  Halves high, low;
};

[[gnu::always_inline]] inline Floats floor_of(Floats v) {  // |v| <= kMaxTexturePlace
  const Floats whole = to_floats(to_ints(v));
  return whole > v ? whole - 1.0f : whole;
}

/// Not a number becomes the lower limit.
[[gnu::always_inline]] inline Floats held(Floats v, float low, float high) {
  v = v > low ? v : every<Floats>(low);
  return v < high ? v : every<Floats>(high);
}

/// A coordinate as a place along the image, in [0, 1].
[[gnu::always_inline]] inline Floats wrap(Floats v, command::TextureWrap mode) {
  if (mode == command::TextureWrap::kClamp) return held(v, 0.0f, 1.0f);
  v = held(v, -kMaxTexturePlace, kMaxTexturePlace);
  if (mode == command::TextureWrap::kRepeat) return v - floor_of(v);
  const Floats half = v * 0.5f;
  const Floats turned = (half - floor_of(half)) * 2.0f;  // [0, 2]: there and back
  return turned > 1.0f ? 2.0f - turned : turned;
}

class Sampler {
 public:
  [[gnu::always_inline]] explicit Sampler(const TextureSetup& t)
      : t_(t), opaque_(t.format == command::TextureFormat::kArgb8888 ? 0 : 0xFF000000u),
        narrow_(t.format == command::TextureFormat::kRgb565),
        turns_s_(t.wrap_s == command::TextureWrap::kRepeat), turns_t_(t.wrap_t == command::TextureWrap::kRepeat) {}

  /// s and t are places; `level` is within the texture.
  [[gnu::always_inline]] Channels sample(Floats s, Floats t, std::int32_t level, bool nearest) const {
    const Level l(t_, level);
    if (nearest) {
      const auto texel = [](Floats place, std::int32_t size) {
        const Ints at = to_ints(place * static_cast<float>(size));
        return at < size ? at : every<Ints>(size - 1);
      };
      return split(fetch(l, texel(t, l.height) * l.pitch, texel(s, l.width)));
    }
    const Pair x = pair_of(s, l.width, turns_s_), y = pair_of(t, l.height, turns_t_);
    const Ints row0 = y.first * l.pitch, row1 = y.second * l.pitch;
    const Halves fx = factor(x.fraction), fy = factor(y.fraction);
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
    Ints first, second, fraction;
  };
  [[gnu::always_inline]] static Pair pair_of(Floats place, std::int32_t size, bool turns) {
    const Ints at = to_ints(place * static_cast<float>(size * 256) + 0.5f) - 128;
    const Ints first = at >> 8, second = first + 1;  // -1 .. size
    return {first < 0 ? every<Ints>(turns ? size - 1 : 0) : first,
            second >= size ? every<Ints>(turns ? 0 : size - 1) : second, at & 0xFF};
  }

  /// A texel each as alpha, red, green, blue. Rows are padded to words, so a word that holds a texel is all in memory.
  [[gnu::always_inline]] Words fetch(const Level& l, Ints row, Ints x) const {
    if (!narrow_) return gather_words(l.texels, row + x * 4) | opaque_;
    const Words v = gather_words(l.texels, row + (x >> 1) * 4) >> bits_as<Words>((x & 1) * 16);
    return 0xFF000000u | (v & 0xF800) << 8 | (v & 0xE000) << 3 | (v & 0x07E0) << 5 | (v & 0x0600) >> 1 |
           (v & 0x001F) << 3 | (v & 0x001C) >> 2;
  }

  [[gnu::always_inline]] static Channels split(Words argb) {
    return {bits_as<Halves>(argb >> 8 & 0xFF00FF), bits_as<Halves>(argb & 0xFF00FF)};
  }
  [[gnu::always_inline]] static Halves mix(Halves a, Halves b, Halves f) {
    return shifted(weighted(a, b, f) + in_halves<Halves>(128), 8);
  }
  [[gnu::always_inline]] static Channels mix(const Channels& a, const Channels& b, Halves f) {
    return {mix(a.high, b.high, f), mix(a.low, b.low, f)};
  }

  const TextureSetup& t_;
  std::uint32_t opaque_;
  bool narrow_, turns_s_, turns_t_;
};

}  // namespace
}  // namespace usuzumi::gfx::soft::USUZUMI_KERNEL
