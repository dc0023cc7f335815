// The variant for x86-64 processors with AVX2: eight pixels at a time. Functions carry the target themselves, so that
// no shared inline function is ever compiled for it.
#include <immintrin.h>

#include "gfx_subsystem/display/pixel_kernels.h"

namespace usuzumi::gfx {
namespace {

#define USUZUMI_AVX2 [[gnu::target("avx2")]]
#define USUZUMI_AVX2_INLINE [[gnu::target("avx2"), gnu::always_inline]] inline

USUZUMI_AVX2_INLINE __m256i load(const void* from) { return _mm256_loadu_si256(static_cast<const __m256i*>(from)); }
USUZUMI_AVX2_INLINE void store(void* to, __m256i v) { _mm256_storeu_si256(static_cast<__m256i*>(to), v); }

/// divide_by_255(source * alpha + below * (255 - alpha)) in sixteen 16-bit lanes; no lane passes 65535. The division is
/// (t * 257) / 65536 with t = v + 128, which equals (t + t / 256) / 256 for every t below 65536.
USUZUMI_AVX2_INLINE __m256i blend_lanes(__m256i source, __m256i below, __m256i alpha) {
  const __m256i rest = _mm256_xor_si256(alpha, _mm256_set1_epi16(255));
  const __m256i sum = _mm256_add_epi16(_mm256_mullo_epi16(source, alpha), _mm256_mullo_epi16(below, rest));
  return _mm256_mulhi_epu16(_mm256_add_epi16(sum, _mm256_set1_epi16(128)), _mm256_set1_epi16(257));
}

/// Red and blue share one vector of 16-bit lanes, green and the unused byte another.
USUZUMI_AVX2_INLINE __m256i blend8(__m256i source, __m256i below) {
  const __m256i mask = _mm256_set1_epi32(0x00FF00FF);
  const __m256i spread = _mm256_set_epi8(-1, 15, -1, 15, -1, 11, -1, 11, -1, 7, -1, 7, -1, 3, -1, 3,  //
                                         -1, 15, -1, 15, -1, 11, -1, 11, -1, 7, -1, 7, -1, 3, -1, 3);
  const __m256i alpha = _mm256_shuffle_epi8(source, spread);  // each pixel's alpha in both of its lanes
  const __m256i red_blue = blend_lanes(_mm256_and_si256(source, mask), _mm256_and_si256(below, mask), alpha);
  const __m256i green = blend_lanes(_mm256_and_si256(_mm256_srli_epi32(source, 8), mask),
                                    _mm256_and_si256(_mm256_srli_epi32(below, 8), mask), alpha);
  return _mm256_or_si256(red_blue, _mm256_and_si256(_mm256_slli_epi32(green, 8), _mm256_set1_epi32(0x0000FF00)));
}

USUZUMI_AVX2 void blend_row(const std::byte* argb, std::size_t count, std::uint32_t* line) {
  const __m256i alphas = _mm256_set1_epi32(static_cast<int>(0xFF000000u));
  const __m256i colours = _mm256_set1_epi32(0x00FFFFFF);
  std::size_t i = 0;
  for (; i + 8 <= count; i += 8) {
    const __m256i source = load(argb + 4 * i);
    if (_mm256_testz_si256(source, alphas) != 0) continue;  // all transparent
    if (_mm256_testc_si256(source, alphas) != 0)            // all opaque
      store(line + i, _mm256_and_si256(source, colours));
    else
      // A transparent pixel among others keeps what is below, whose upper byte is 0 already.
      store(line + i, blend8(source, load(line + i)));
  }
  all_pixel_kernels().front()->blend_row(argb + 4 * i, count - i, line + i);
}

USUZUMI_AVX2 void pack_rgb(const std::uint32_t* pixels, std::size_t count, std::byte* bytes) {
  // In each half four pixels B G R 0 become R G B four times and four bytes of nothing, then the halves close up.
  const __m256i order = _mm256_set_epi8(-1, -1, -1, -1, 12, 13, 14, 8, 9, 10, 4, 5, 6, 0, 1, 2,  //
                                        -1, -1, -1, -1, 12, 13, 14, 8, 9, 10, 4, 5, 6, 0, 1, 2);
  const __m256i close = _mm256_set_epi32(7, 3, 6, 5, 4, 2, 1, 0);
  std::size_t i = 0;
  for (; i + 8 <= count; i += 8, bytes += 24) {
    const __m256i packed = _mm256_permutevar8x32_epi32(_mm256_shuffle_epi8(load(pixels + i), order), close);
    _mm_storeu_si128(static_cast<__m128i*>(static_cast<void*>(bytes)), _mm256_castsi256_si128(packed));
    _mm_storel_epi64(static_cast<__m128i*>(static_cast<void*>(bytes + 16)), _mm256_extracti128_si256(packed, 1));
  }
  all_pixel_kernels().front()->pack_rgb(pixels + i, count - i, bytes);
}

#undef USUZUMI_AVX2
#undef USUZUMI_AVX2_INLINE

}  // namespace

extern const PixelKernels kAvx2PixelKernels;
const PixelKernels kAvx2PixelKernels{"avx2", [] { return __builtin_cpu_supports("avx2") != 0; }, blend_row, pack_rgb};

}  // namespace usuzumi::gfx
