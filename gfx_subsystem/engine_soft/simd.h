// Vectors of the compiler's own (GCC and Clang vector extensions), in the width of the kernel variant being compiled.
// Included only by the kernel sources, inside the target attributes they set; see kernels.inc.h.
//
// Every operation is exact integer arithmetic or one IEEE operation per lane, so the width never changes a result. The
// few intrinsics below replace what the vector extensions cannot say; each has a plain fallback with the same result.
#pragma once

#include <cstdint>
#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace usuzumi::gfx::soft::USUZUMI_KERNEL {
namespace {

inline constexpr int kLanes = USUZUMI_KERNEL_LANES;  // 4, 8 or 16
/// Triangles are rasterized and fragments worked out pixel by pixel: where vectors are but pretended, that costs less.
#if defined(USUZUMI_KERNEL_PIXELWISE)
inline constexpr bool kPixelwise = true;
#else
inline constexpr bool kPixelwise = false;
#endif

using I32 = std::int32_t __attribute__((vector_size(4 * kLanes)));
using U32 = std::uint32_t __attribute__((vector_size(4 * kLanes)));
using F32 = float __attribute__((vector_size(4 * kLanes)));
using I16 = std::int16_t __attribute__((vector_size(4 * kLanes)));   // two per lane
using U16 = std::uint16_t __attribute__((vector_size(4 * kLanes)));
using F32x4 = float __attribute__((vector_size(16)));
using I32x4 = std::int32_t __attribute__((vector_size(16)));
using I16x8 = std::int16_t __attribute__((vector_size(16)));
using F64x4 = double __attribute__((vector_size(32)));
using U64x4 = std::uint64_t __attribute__((vector_size(32)));

template <class To, class From>
[[gnu::always_inline]] inline To bits_as(From v) {
  static_assert(sizeof(To) == sizeof(From));
  return __builtin_bit_cast(To, v);
}

[[gnu::always_inline]] inline I32x4 least(I32x4 a, I32x4 b) { return a < b ? a : b; }
[[gnu::always_inline]] inline I32x4 most(I32x4 a, I32x4 b) { return a > b ? a : b; }
[[gnu::always_inline]] inline I32 splat(std::int32_t v) { return I32{} + v; }
[[gnu::always_inline]] inline U32 splat_u(std::uint32_t v) { return U32{} + v; }
[[gnu::always_inline]] inline F32 splat_f(float v) { return F32{} + v; }

/// One bit per lane, set where the lane is negative.
[[gnu::always_inline]] inline std::uint32_t sign_bits(I32 v) {
#if USUZUMI_KERNEL_LANES == 16
  return _mm512_movepi32_mask(bits_as<__m512i>(v));
#elif USUZUMI_KERNEL_LANES == 8
  return static_cast<std::uint32_t>(_mm256_movemask_ps(bits_as<__m256>(v)));
#elif defined(__x86_64__)
  return static_cast<std::uint32_t>(_mm_movemask_ps(bits_as<__m128>(v)));
#else
  std::uint32_t bits = 0;
  for (int l = 0; l < kLanes; ++l) bits |= (static_cast<std::uint32_t>(v[l]) >> 31) << l;
  return bits;
#endif
}

/// v where the mask's lane is all ones, `otherwise` where it is zero.
[[gnu::always_inline]] inline U32 select(I32 mask, U32 v, U32 otherwise) {
#if USUZUMI_KERNEL_LANES == 8
  return bits_as<U32>(_mm256_blendv_epi8(bits_as<__m256i>(otherwise), bits_as<__m256i>(v), bits_as<__m256i>(mask)));
#else
  const U32 m = bits_as<U32>(mask);
  return (v & m) | (otherwise & ~m);
#endif
}

/// Per lane a.low * b.low + a.high * b.high of the lanes' 16-bit halves, in 32 bits.
[[gnu::always_inline]] inline I32 dot_pairs(I16 a, I16 b) {
#if USUZUMI_KERNEL_LANES == 16
  return bits_as<I32>(_mm512_madd_epi16(bits_as<__m512i>(a), bits_as<__m512i>(b)));
#elif USUZUMI_KERNEL_LANES == 8
  return bits_as<I32>(_mm256_madd_epi16(bits_as<__m256i>(a), bits_as<__m256i>(b)));
#elif defined(__x86_64__)
  return bits_as<I32>(_mm_madd_epi16(bits_as<__m128i>(a), bits_as<__m128i>(b)));
#else
  const I32 wa = bits_as<I32>(a), wb = bits_as<I32>(b);
  return ((wa << 16) >> 16) * ((wb << 16) >> 16) + (wa >> 16) * (wb >> 16);
#endif
}

/// Words at `offset` bytes from base; every lane's lies in memory.
[[gnu::always_inline]] inline U32 gather_words(const std::byte* base, I32 offset) {
#if USUZUMI_KERNEL_LANES == 16
  // Masked, with all lanes: the plain one is built on a vector that gcc 12 warns is not initialized. Without
  // optimization it is a macro, whose own conversions gcc 12 warns of.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsign-conversion"
  return bits_as<U32>(_mm512_mask_i32gather_epi32(_mm512_setzero_si512(), 0xFFFF, bits_as<__m512i>(offset), base, 1));
#pragma GCC diagnostic pop
#elif USUZUMI_KERNEL_LANES == 8
  return bits_as<U32>(_mm256_i32gather_epi32(reinterpret_cast<const int*>(base), bits_as<__m256i>(offset), 1));
#else
  U32 words{};
  for (int l = 0; l < kLanes; ++l) {
    std::uint32_t word;
    std::memcpy(&word, base + offset[l], sizeof word);
    words[l] = word;
  }
  return words;
#endif
}

/// Two 16-bit values in one word, as the lanes of I16 hold them.
[[gnu::always_inline]] inline std::uint32_t pair(std::int32_t low, std::int32_t high) {
  return (static_cast<std::uint32_t>(low) & 0xFFFFu) | static_cast<std::uint32_t>(high) << 16;
}

template <class V>
[[gnu::always_inline]] inline V load(const void* p) {
  V v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
template <class V>
[[gnu::always_inline]] inline void store(void* p, V v) {
  std::memcpy(p, &v, sizeof v);
}

}  // namespace
}  // namespace usuzumi::gfx::soft::USUZUMI_KERNEL
