// Method: V. Gopal et al., "Fast CRC Computation for Generic Polynomials Using PCLMULQDQ Instruction", Intel 2009, in
// its bit-reflected form; only the folding. The last 16 bytes are left to the table-driven division, which spares the
// Barrett reduction.
//
// A register of 128 bits R = (lo, hi) holds a part of the message; reflected, lo is of higher degree. To move it D bits
// further up, lo is multiplied by x^(D + 32) and hi by x^(D - 32), each modulo P, and both products are added (XOR) to
// what stands there. The factor x^32 in the exponents and the shift by one in fold_constant() make up for reflected
// products standing one bit low in 64 x 64 -> 127 bits.
#include "hal/crc32_fold.h"

#include <immintrin.h>

namespace usuzumi {
namespace {

/// x^n modulo P = x^32 + 0x04C11DB7, reflected to 32 bits and shifted left by one.
constexpr std::uint64_t fold_constant(unsigned n) {
  std::uint32_t r = 1;
  for (; n > 0; --n) r = (r << 1) ^ ((r >> 31) != 0 ? 0x04C11DB7u : 0u);
  std::uint64_t reflected = 0;
  for (unsigned bit = 0; bit < 32; ++bit) reflected |= std::uint64_t{(r >> bit) & 1} << (31 - bit);
  return reflected << 1;
}
// As the paper prints them for this polynomial.
static_assert(fold_constant(4 * 128 + 32) == 0x154442BD4 && fold_constant(4 * 128 - 32) == 0x1C6E41596);
static_assert(fold_constant(128 + 32) == 0x1751997D0 && fold_constant(128 - 32) == 0x0CCAA009E);

#define USUZUMI_CLMUL [[gnu::target("pclmul,sse4.1")]]
#define USUZUMI_CLMUL_INLINE [[gnu::target("pclmul,sse4.1"), gnu::always_inline]] inline

USUZUMI_CLMUL_INLINE __m128i load(const std::byte* from) {
  return _mm_loadu_si128(static_cast<const __m128i*>(static_cast<const void*>(from)));
}

/// `r` moved up by the constants' distance, added to `next`.
USUZUMI_CLMUL_INLINE __m128i fold(__m128i r, __m128i constants, __m128i next) {
  return _mm_xor_si128(
      next, _mm_xor_si128(_mm_clmulepi64_si128(r, constants, 0x00), _mm_clmulepi64_si128(r, constants, 0x11)));
}

}  // namespace

bool crc32_fold_supported() { return __builtin_cpu_supports("pclmul") != 0 && __builtin_cpu_supports("sse4.1") != 0; }

USUZUMI_CLMUL void crc32_fold(std::uint32_t state, const std::byte* bytes, std::size_t size, std::byte (&folded)[16]) {
  const __m128i by_64_bytes = _mm_set_epi64x(static_cast<long long>(fold_constant(4 * 128 - 32)),
                                             static_cast<long long>(fold_constant(4 * 128 + 32)));
  const __m128i by_16_bytes = _mm_set_epi64x(static_cast<long long>(fold_constant(128 - 32)),
                                             static_cast<long long>(fold_constant(128 + 32)));
  // The register's state is added to the message's first four bytes.
  __m128i r0 = _mm_xor_si128(load(bytes), _mm_cvtsi32_si128(static_cast<int>(state)));
  __m128i r1 = load(bytes + 16), r2 = load(bytes + 32), r3 = load(bytes + 48);
  for (std::size_t at = 64; at < size; at += 64) {
    r0 = fold(r0, by_64_bytes, load(bytes + at));
    r1 = fold(r1, by_64_bytes, load(bytes + at + 16));
    r2 = fold(r2, by_64_bytes, load(bytes + at + 32));
    r3 = fold(r3, by_64_bytes, load(bytes + at + 48));
  }
  const __m128i all = fold(fold(fold(r0, by_16_bytes, r1), by_16_bytes, r2), by_16_bytes, r3);
  _mm_storeu_si128(static_cast<__m128i*>(static_cast<void*>(folded)), all);
}

#undef USUZUMI_CLMUL
#undef USUZUMI_CLMUL_INLINE

}  // namespace usuzumi
