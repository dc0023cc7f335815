// What a fragment's arithmetic is done in: the lanes of a part or, where the processor has no vectors, one pixel. The
// sampler and FragmentShader are written once, in the operations below; each gives a pixel what it gives a lane.
#pragma once

#include <type_traits>

#include "gfx_subsystem/engine_soft/shader.h"
#include "gfx_subsystem/engine_soft/simd.h"

namespace usuzumi::gfx::soft::USUZUMI_KERNEL {
namespace {

using Ints = std::conditional_t<kPixelwise, std::int32_t, I32>;    // also a mask: -1 or 0
using Words = std::conditional_t<kPixelwise, std::uint32_t, U32>;
using Floats = std::conditional_t<kPixelwise, float, F32>;
/// Two values of 16 bits per pixel, the upper one in the upper half.
using Halves = std::conditional_t<kPixelwise, std::uint32_t, U16>;

/// Column and row within what is worked out at once.
template <class V>
[[gnu::always_inline]] inline V lane_column() {
  if constexpr (std::is_same_v<V, I32>) return lane_pattern().x; else return 0;
}
template <class V>
[[gnu::always_inline]] inline V lane_row() {
  if constexpr (std::is_same_v<V, I32>) return lane_pattern().y; else return 0;
}

/// The same value in every lane.
template <class V, class T>
[[gnu::always_inline]] inline V every(T v) {
  if constexpr (std::is_same_v<V, T>) return v; else return V{} + v;
}

[[gnu::always_inline]] inline F32 to_floats(I32 v) { return __builtin_convertvector(v, F32); }
[[gnu::always_inline]] inline float to_floats(std::int32_t v) { return static_cast<float>(v); }
[[gnu::always_inline]] inline I32 to_ints(F32 v) { return __builtin_convertvector(v, I32); }
[[gnu::always_inline]] inline std::int32_t to_ints(float v) { return static_cast<std::int32_t>(v); }

/// Of a comparison.
[[gnu::always_inline]] inline I32 mask_of(I32 holds) { return holds; }
[[gnu::always_inline]] inline std::int32_t mask_of(bool holds) { return holds ? -1 : 0; }

// What simd.h has for lanes.
[[gnu::always_inline]] inline std::uint32_t sign_bits(std::int32_t v) { return static_cast<std::uint32_t>(v) >> 31; }
[[gnu::always_inline]] inline std::uint32_t select(std::int32_t mask, std::uint32_t v, std::uint32_t otherwise) {
  const auto m = static_cast<std::uint32_t>(mask);
  return (v & m) | (otherwise & ~m);
}
[[gnu::always_inline]] inline std::uint32_t gather_words(const std::byte* base, std::int32_t offset) {
  return load<std::uint32_t>(base + offset);
}
[[gnu::always_inline]] inline std::int32_t lane_of(I32 v, int lane) { return v[lane]; }
[[gnu::always_inline]] inline std::int32_t lane_of(std::int32_t v, int) { return v; }

/// A constant in both halves.
template <class V>
[[gnu::always_inline]] inline V in_halves(std::uint16_t v) {
  if constexpr (std::is_same_v<V, U16>) return U16{} + v; else return v * 0x10001u;
}

/// What `*` multiplies both halves by. Of a pixel the plain number: no product may exceed its half.
[[gnu::always_inline]] inline U16 factor(I32 v) { return bits_as<U16>(v | v << 16); }
[[gnu::always_inline]] inline std::uint32_t factor(std::int32_t v) { return static_cast<std::uint32_t>(v); }

/// Half by half.
[[gnu::always_inline]] inline U16 shifted(U16 v, int by) { return v >> by; }
[[gnu::always_inline]] inline std::uint32_t shifted(std::uint32_t v, int by) {
  return v >> by & (0xFFFFu >> by) * 0x10001u;
}
[[gnu::always_inline]] inline U16 product(U16 a, U16 b) { return a * b; }
[[gnu::always_inline]] inline std::uint32_t product(std::uint32_t a, std::uint32_t b) {  // each below 2^16
  return (a & 0xFFFF) * (b & 0xFFFF) | (a >> 16) * (b >> 16) << 16;
}

/// 256 a + (b - a) f, of channels: below 2^16.
[[gnu::always_inline]] inline U16 weighted(U16 a, U16 b, U16 f) { return (a << 8) + (b - a) * f; }
[[gnu::always_inline]] inline std::uint32_t weighted(std::uint32_t a, std::uint32_t b, std::uint32_t f) {
  return a * (256 - f) + b * f;
}

/// A word of Planes at the part's or the pixel's (x, y), each half modulo 2^16.
template <class V>
[[gnu::always_inline]] inline V affine(std::uint32_t base, std::uint32_t dx, std::uint32_t dy, std::int32_t x,
                                       std::int32_t y) {
  if constexpr (std::is_same_v<V, U16>) {
    const U16 xs = factor(lane_column<I32>()) + static_cast<std::uint16_t>(x);
    const U16 ys = factor(lane_row<I32>()) + static_cast<std::uint16_t>(y);
    return bits_as<U16>(splat_u(base)) + bits_as<U16>(splat_u(dx)) * xs + bits_as<U16>(splat_u(dy)) * ys;
  } else {
    const auto ux = static_cast<std::uint32_t>(x), uy = static_cast<std::uint32_t>(y);
    const std::uint32_t low = base + ux * dx + uy * dy;
    const std::uint32_t high = (base >> 16) + ux * (dx >> 16) + uy * (dy >> 16);
    return (low & 0xFFFF) | high << 16;
  }
}

}  // namespace
}  // namespace usuzumi::gfx::soft::USUZUMI_KERNEL
