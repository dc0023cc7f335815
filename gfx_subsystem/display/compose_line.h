// One line of the picture out of background, layers and cursor: the pure function at the heart of the display
// controller.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/registers/display.h"

namespace usuzumi::gfx {

/// The part of one layer's row that lies inside the picture, cut to it.
struct LayerRow {
  const std::byte* pixels = nullptr;  // of x_begin; 2-byte aligned at least
  std::uint32_t x_begin = 0, x_end = 0;
  display_registers::LayerFormat format = display_registers::LayerFormat::kXrgb8888;
  bool per_pixel_alpha = false;       // counts with kArgb8888 only
  bool key_enabled = false;
  std::uint32_t key_rgb = 0;          // 0x00RRGGBB
  std::uint32_t global_alpha = 255;
};

/// round(v / 255), halves up, for v <= 65025: with t = v + 128, (t + t / 256) / 256 in whole numbers.
constexpr std::uint32_t divide_by_255(std::uint32_t v) {
  const std::uint32_t t = v + 128;
  return (t + (t >> 8)) >> 8;
}

/// Five and six bits widened to eight by repeating the high ones: 0 stays 0, all ones become 255.
constexpr std::uint32_t widen_rgb565(std::uint32_t p) {
  const std::uint32_t r = p >> 11 & 0x1F, g = p >> 5 & 0x3F, b = p & 0x1F;
  return (r << 3 | r >> 2) << 16 | (g << 2 | g >> 4) << 8 | (b << 3 | b >> 2);
}

/// Fills `line` (0x00RRGGBB each) with `background_rgb` and lays `rows` over it, back to front. Per layer and pixel:
/// colour widened to 8 bits a channel; not shown when it equals an enabled key; alpha = own alpha (or 255) times global
/// alpha / 255; channel = divide_by_255(source * alpha + below * (255 - alpha)).
void compose_line(std::uint32_t background_rgb, std::span<const LayerRow> rows, std::span<std::uint32_t> line);

/// The bytes R, G, B of each pixel; `bytes` holds 3 * pixels.size().
void pack_rgb(std::span<const std::uint32_t> pixels, std::byte* bytes);

}  // namespace usuzumi::gfx
