#include "gfx_subsystem/display/compose_line.h"

#include <algorithm>
#include <cstring>

#include "gfx_subsystem/display/pixel_kernels.h"

namespace usuzumi::gfx {
namespace {

using display_registers::LayerFormat;

constexpr std::uint32_t kRgbMask = 0x00FFFFFF, kOpaque = 0xFF000000;

// Rows are widened piece by piece, so that what is between widening and blending stays in the first-level cache, in
// loops of constant length, which every compiler turns into SIMD code.
constexpr std::size_t kPiece = 64;
using Piece = std::uint32_t[kPiece];

const PixelKernels& kKernels = best_pixel_kernels();

/// `count` <= kPiece pixels as 0xAARRGGBB with their own alpha, 255 where the layer has none. What lies behind them in
/// `piece` is of no account.
void widen(const LayerRow& row, const std::byte* pixels, std::size_t count, Piece& piece) {
  if (row.format == LayerFormat::kRgb565) {
    std::uint16_t raw[kPiece] = {};
    std::memcpy(raw, pixels, 2 * count);
    for (std::size_t i = 0; i < kPiece; ++i) piece[i] = widen_rgb565(raw[i]) | kOpaque;
    return;
  }
  std::memcpy(piece, pixels, 4 * count);
  if (row.format == LayerFormat::kArgb8888 && row.per_pixel_alpha) return;
  for (std::size_t i = 0; i < kPiece; ++i) piece[i] |= kOpaque;
}

void apply_key(std::uint32_t key_rgb, Piece& piece) {
  for (std::size_t i = 0; i < kPiece; ++i) piece[i] = (piece[i] & kRgbMask) == key_rgb ? 0u : piece[i];
}

void apply_global_alpha(std::uint32_t alpha, Piece& piece) {
  for (std::size_t i = 0; i < kPiece; ++i)
    piece[i] = (piece[i] & kRgbMask) | divide_by_255((piece[i] >> 24) * alpha) << 24;
}

/// Shows each pixel as it is: nothing below can be seen through this layer.
bool is_opaque(const LayerRow& row) {
  return !row.key_enabled && row.global_alpha == 255 && !(row.per_pixel_alpha && row.format == LayerFormat::kArgb8888);
}

void lay_over(const LayerRow& row, std::uint32_t* line) {
  const std::size_t bytes = display_registers::bytes_per_pixel(row.format), total = row.x_end - row.x_begin;
  std::uint32_t* const first = line + row.x_begin;
  if (row.format == LayerFormat::kArgb8888 && row.per_pixel_alpha && !row.key_enabled && row.global_alpha == 255) {
    kKernels.blend_row(row.pixels, total, first);
    return;
  }
  const bool opaque = is_opaque(row);
  if (opaque && bytes == 4) {
    std::memcpy(first, row.pixels, 4 * total);
    for (std::size_t i = 0; i < total; ++i) first[i] &= kRgbMask;
    return;
  }
  Piece piece{};
  for (std::size_t done = 0; done < total; done += kPiece) {
    const std::size_t count = std::min(kPiece, total - done);
    widen(row, row.pixels + done * bytes, count, piece);
    if (opaque) {
      for (std::size_t i = 0; i < kPiece; ++i) piece[i] &= kRgbMask;
      std::memcpy(first + done, piece, 4 * count);
      continue;
    }
    if (row.key_enabled) apply_key(row.key_rgb, piece);
    if (row.global_alpha != 255) apply_global_alpha(row.global_alpha, piece);
    kKernels.blend_row(reinterpret_cast<const std::byte*>(piece), count, first + done);
  }
}

}  // namespace

void compose_line(std::uint32_t background_rgb, std::span<const LayerRow> rows, std::span<std::uint32_t> line) {
  // What the last layer that hides everything hides need not be drawn.
  std::size_t bottom = rows.size();
  while (bottom > 0 &&
         !(is_opaque(rows[bottom - 1]) && rows[bottom - 1].x_begin == 0 && rows[bottom - 1].x_end == line.size()))
    --bottom;
  if (bottom == 0)
    std::fill(line.begin(), line.end(), background_rgb & kRgbMask);
  else
    --bottom;
  for (const LayerRow& row : rows.subspan(bottom)) lay_over(row, line.data());
}

void pack_rgb(std::span<const std::uint32_t> pixels, std::byte* bytes) {
  kKernels.pack_rgb(pixels.data(), pixels.size(), bytes);
}

}  // namespace usuzumi::gfx
