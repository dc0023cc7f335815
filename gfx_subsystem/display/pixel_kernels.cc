// The variant that runs everywhere (SSE2 on x86-64, NEON on AArch64, plain code elsewhere), and the choice.
#include "gfx_subsystem/display/pixel_kernels.h"

#include <cstring>

#include "gfx_subsystem/display/compose_line.h"

namespace usuzumi::gfx {
namespace {

// Four pixels at a time in the compiler's portable vector types.
typedef std::uint32_t U32x4 [[gnu::vector_size(16)]];
typedef std::uint16_t U16x8 [[gnu::vector_size(16)]];

/// divide_by_255(source * alpha + below * (255 - alpha)) in eight 16-bit lanes; no lane passes 65535: 255 * 255 + 128 +
/// 254.
U16x8 blend_lanes(U16x8 source, U16x8 below, U16x8 alpha) {
  const U16x8 t = source * alpha + below * (255 - alpha) + 128;
  return (t + (t >> 8)) >> 8;
}

/// Red and blue share one vector of 16-bit lanes, green and the unused byte another.
U32x4 blend4(U32x4 source, U32x4 below) {
  const U32x4 mask = {0x00FF00FF, 0x00FF00FF, 0x00FF00FF, 0x00FF00FF};
  const U32x4 alpha = source >> 24;
  const U16x8 lanes = reinterpret_cast<U16x8>(alpha | alpha << 16);
  const U16x8 red_blue =
      blend_lanes(reinterpret_cast<U16x8>(source & mask), reinterpret_cast<U16x8>(below & mask), lanes);
  const U16x8 green =
      blend_lanes(reinterpret_cast<U16x8>(source >> 8 & mask), reinterpret_cast<U16x8>(below >> 8 & mask), lanes);
  return reinterpret_cast<U32x4>(red_blue) | (reinterpret_cast<U32x4>(green) << 8 & 0x0000FF00u);
}

std::uint32_t blend1(std::uint32_t source, std::uint32_t below) {
  const std::uint32_t alpha = source >> 24;
  std::uint32_t shown = 0;
  for (unsigned shift = 0; shift < 24; shift += 8)
    shown |= divide_by_255((source >> shift & 0xFF) * alpha + (below >> shift & 0xFF) * (255 - alpha)) << shift;
  return shown;
}

/// Four transparent or four opaque neighbours, the usual case in overlays, are told apart first; the result is the
/// same.
void blend_row(const std::byte* argb, std::size_t count, std::uint32_t* line) {
  constexpr std::uint64_t kAlphas = 0xFF000000FF000000u;
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) {
    std::uint64_t pairs[2];
    std::memcpy(pairs, argb + 4 * i, sizeof pairs);
    if (((pairs[0] | pairs[1]) & kAlphas) == 0) continue;
    U32x4 source;
    std::memcpy(&source, argb + 4 * i, sizeof source);
    if ((pairs[0] & pairs[1] & kAlphas) == kAlphas) {
      source &= 0x00FFFFFFu;
    } else {
      U32x4 below;
      std::memcpy(&below, line + i, sizeof below);
      source = blend4(source, below);
    }
    std::memcpy(line + i, &source, sizeof source);
  }
  for (; i < count; ++i) {
    std::uint32_t source;
    std::memcpy(&source, argb + 4 * i, sizeof source);
    if (source >> 24 != 0) line[i] = blend1(source, line[i]);
  }
}

void store_word(std::byte* bytes, std::uint32_t word) { std::memcpy(bytes, &word, sizeof word); }

void pack_rgb(const std::uint32_t* pixels, std::size_t count, std::byte* bytes) {
  // 0x00RRGGBB to the little-endian word 0x00BBGGRR, then four of those into three words.
  const auto swap = [](std::uint32_t p) { return __builtin_bswap32(p) >> 8; };
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4, bytes += 12) {
    const std::uint32_t a = swap(pixels[i]), b = swap(pixels[i + 1]), c = swap(pixels[i + 2]), d = swap(pixels[i + 3]);
    store_word(bytes, a | b << 24);
    store_word(bytes + 4, b >> 8 | c << 16);
    store_word(bytes + 8, c >> 16 | d << 8);
  }
  for (; i < count; ++i, bytes += 3) {
    bytes[0] = std::byte(pixels[i] >> 16 & 0xFF);
    bytes[1] = std::byte(pixels[i] >> 8 & 0xFF);
    bytes[2] = std::byte(pixels[i] & 0xFF);
  }
}

constexpr PixelKernels kBaseline{"baseline", [] { return true; }, blend_row, pack_rgb};

}  // namespace

#if defined(__x86_64__)
extern const PixelKernels kAvx2PixelKernels;
#endif

std::span<const PixelKernels* const> all_pixel_kernels() {
#if defined(__x86_64__)
  static constexpr const PixelKernels* kAll[] = {&kBaseline, &kAvx2PixelKernels};
#else
  static constexpr const PixelKernels* kAll[] = {&kBaseline};
#endif
  return kAll;
}

const PixelKernels& best_pixel_kernels() {
  const PixelKernels* best = &kBaseline;
  for (const PixelKernels* kernels : all_pixel_kernels())
    if (kernels->supported()) best = kernels;
  return *best;
}

}  // namespace usuzumi::gfx
