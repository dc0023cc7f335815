// The two inner loops of scan-out that are worth a variant per instruction set. Every variant gives the same bytes: all
// is whole-number arithmetic on channels of 8 bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace usuzumi::gfx {

struct PixelKernels {
  const char* name;
  bool (*supported)();
  /// Lays `count` pixels 0xAARRGGBB (any alignment) over `line`: each channel is
  /// divide_by_255(source * alpha + below * (255 - alpha)); bits 31-24 of the line become 0 where the pixel is not
  /// transparent.
  void (*blend_row)(const std::byte* argb, std::size_t count, std::uint32_t* line);
  /// Writes the bytes R, G, B of `count` pixels; nothing beyond 3 * count bytes.
  void (*pack_rgb)(const std::uint32_t* pixels, std::size_t count, std::byte* bytes);
};

/// From the slowest to the fastest; the first runs everywhere.
std::span<const PixelKernels* const> all_pixel_kernels();
/// The fastest that this processor runs.
const PixelKernels& best_pixel_kernels();

}  // namespace usuzumi::gfx
