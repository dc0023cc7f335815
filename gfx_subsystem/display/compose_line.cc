#include "gfx_subsystem/display/compose_line.h"

#include <algorithm>
#include <cstring>

namespace usuzumi::gfx {
namespace {

using display_registers::LayerFormat;

constexpr std::uint32_t kRgbMask = 0x00FFFFFF, kOpaque = 0xFF000000;

// Rows are widened piece by piece, so that what is between widening and blending stays in the first-level cache, and in
// loops of constant length, so that they become SIMD code at any optimisation level.
constexpr std::size_t kPiece = 64;
using Piece = std::uint32_t[kPiece];

// Four pixels at a time in the compiler's portable vector types: the same whole numbers on every processor.
typedef std::uint32_t U32x4 [[gnu::vector_size(16)]];
typedef std::uint16_t U16x8 [[gnu::vector_size(16)]];

/// divide_by_255(source * alpha + below * (255 - alpha)) in eight 16-bit lanes; no lane passes 65535: 255 * 255 + 128 + 254.
U16x8 blend_lanes(U16x8 source, U16x8 below, U16x8 alpha) {
  const U16x8 t = source * alpha + below * (255 - alpha) + 128;
  return (t + (t >> 8)) >> 8;
}

/// Red and blue share one vector of 16-bit lanes, green and the unused byte another.
U32x4 blend4(U32x4 source, U32x4 below) {
  const U32x4 mask = {0x00FF00FF, 0x00FF00FF, 0x00FF00FF, 0x00FF00FF};
  const U32x4 alpha = source >> 24;
  const U16x8 lanes = reinterpret_cast<U16x8>(alpha | alpha << 16);
  const U16x8 red_blue = blend_lanes(reinterpret_cast<U16x8>(source & mask), reinterpret_cast<U16x8>(below & mask), lanes);
  const U16x8 green = blend_lanes(reinterpret_cast<U16x8>(source >> 8 & mask), reinterpret_cast<U16x8>(below >> 8 & mask), lanes);
  return reinterpret_cast<U32x4>(red_blue) | (reinterpret_cast<U32x4>(green) << 8 & 0x0000FF00u);
}

std::uint32_t blend1(std::uint32_t source, std::uint32_t below) {
  const std::uint32_t alpha = source >> 24;
  std::uint32_t shown = 0;
  for (unsigned shift = 0; shift < 24; shift += 8)
    shown |= divide_by_255((source >> shift & 0xFF) * alpha + (below >> shift & 0xFF) * (255 - alpha)) << shift;
  return shown;
}

/// Lays `count` pixels 0xAARRGGBB over `line`. Four transparent or four opaque neighbours, the usual case in overlays, are
/// told apart first; the result is the same.
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
      source &= kRgbMask;
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
    line[i] = blend1(source, line[i]);
  }
}

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
    blend_row(row.pixels, total, first);
    return;
  }
  const bool opaque = is_opaque(row);
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
    blend_row(reinterpret_cast<const std::byte*>(piece), count, first + done);
  }
}

}  // namespace

void compose_line(std::uint32_t background_rgb, std::span<const LayerRow> rows, std::span<std::uint32_t> line) {
  // What the last layer that hides everything hides need not be drawn.
  std::size_t bottom = rows.size();
  while (bottom > 0 && !(is_opaque(rows[bottom - 1]) && rows[bottom - 1].x_begin == 0 && rows[bottom - 1].x_end == line.size()))
    --bottom;
  if (bottom == 0)
    std::fill(line.begin(), line.end(), background_rgb & kRgbMask);
  else
    --bottom;
  for (const LayerRow& row : rows.subspan(bottom)) lay_over(row, line.data());
}

void pack_rgb(std::span<const std::uint32_t> pixels, std::byte* bytes) {
  // 0x00RRGGBB to the little-endian word 0x00BBGGRR, then four of those into three words.
  const auto swap = [](std::uint32_t p) { return __builtin_bswap32(p) >> 8; };
  std::size_t i = 0;
  for (; i + 4 <= pixels.size(); i += 4, bytes += 12) {
    const std::uint32_t a = swap(pixels[i]), b = swap(pixels[i + 1]), c = swap(pixels[i + 2]), d = swap(pixels[i + 3]);
    const std::uint32_t words[3] = {a | b << 24, b >> 8 | c << 16, c >> 16 | d << 8};
    std::memcpy(bytes, words, sizeof words);
  }
  for (; i < pixels.size(); ++i, bytes += 3) {
    bytes[0] = std::byte(pixels[i] >> 16 & 0xFF);
    bytes[1] = std::byte(pixels[i] >> 8 & 0xFF);
    bytes[2] = std::byte(pixels[i] & 0xFF);
  }
}

}  // namespace usuzumi::gfx
