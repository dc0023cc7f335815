// Between VRAM and a tile's buffers: load, store and clear. Formats differ only here and where a pixel is packed: a
// buffer holds one pixel, or one depth, per 32-bit word.
#pragma once

#include "gfx_subsystem/engine_soft/raster_small.h"
#include "gfx_subsystem/engine_soft/round.h"

namespace usuzumi::gfx::soft::USUZUMI_KERNEL {
namespace {

using Four = std::uint32_t __attribute__((vector_size(16)));
using FourHalves = std::uint16_t __attribute__((vector_size(8)));

/// Pixels of a tile that are on the target.
struct TileExtent {
  TileOrigin origin;
  std::int32_t width, height;
};

inline TileExtent tile_extent(const Round& r, std::uint32_t tile) {
  const auto column = static_cast<std::int32_t>(tile) % r.grid.columns,
             row = static_cast<std::int32_t>(tile) / r.grid.columns;
  const TileOrigin o{column * kTileSize, row * kTileSize};
  return {o, std::min(kTileSize, r.target.width - o.x), std::min(kTileSize, r.target.height - o.y)};
}

/// A plane in VRAM with 2 or 4 bytes per pixel.
struct Plane {
  std::byte* memory;
  std::size_t stride;
  bool narrow;         // 2 bytes
  std::uint32_t mask;  // bits of a word that count
  bool streaming;      // stores go past the caches; see RoundTarget::streaming
  std::size_t pixel_bytes() const { return narrow ? 2 : 4; }
  std::byte* at(const TileOrigin& o, std::int32_t row) const {
    return memory + stride * static_cast<std::size_t>(o.y + row) + pixel_bytes() * static_cast<std::size_t>(o.x);
  }
};
inline Plane colour_plane(const Round& r) {
  return {r.target.colour, r.target.colour_stride, r.target.rgb565, ~0u, r.target.streaming};
}
inline Plane depth_plane(const Round& r) {
  return {r.target.depth, r.target.depth_stride, r.target.depth16, 0xFFFFFFu, r.target.streaming && !r.target.depth16};
}

/// Stores four words; `streaming` needs an address that is a multiple of 16.
[[gnu::always_inline]] inline void store_four(std::byte* p, Four v, bool streaming) {
#if defined(__x86_64__)
  if (streaming) return _mm_stream_si128(reinterpret_cast<__m128i*>(p), bits_as<__m128i>(v));
#endif
  static_cast<void>(streaming);
  store(p, v);
}

/// Streamed stores are in memory before anything that this thread stores later.
inline void finish_streaming() {
#if defined(__x86_64__)
  _mm_sfence();
#endif
}

/// First of the four words that hold pixels 4 * column .. of a row.
inline std::uint32_t* block_row(std::uint32_t* buffer, std::int32_t row, std::int32_t column) {
  return buffer + block_offset(column, row / kBlockSize) + (row % kBlockSize) * kBlockSize;
}

inline void load_plane(const Plane& plane, const TileExtent& tile, std::uint32_t* buffer) {
  for (std::int32_t y = 0; y < tile.height; ++y) {
    const std::byte* from = plane.at(tile.origin, y);
    const std::int32_t whole = tile.width / kBlockSize;
    for (std::int32_t c = 0; c < whole; ++c) {
      const std::byte* p = from + plane.pixel_bytes() * kBlockSize * static_cast<std::size_t>(c);
      if (plane.narrow) store(block_row(buffer, y, c), __builtin_convertvector(load<FourHalves>(p), Four));
      else store(block_row(buffer, y, c), load<Four>(p) & plane.mask);
    }
    for (std::int32_t x = whole * kBlockSize; x < tile.width; ++x) {
      const std::byte* p = from + plane.pixel_bytes() * static_cast<std::size_t>(x);
      block_row(buffer, y, whole)[x % kBlockSize] =
          plane.narrow ? load<std::uint16_t>(p) : load<std::uint32_t>(p) & plane.mask;
    }
  }
}

inline void store_plane(const Plane& plane, const TileExtent& tile, std::uint32_t* buffer) {
  for (std::int32_t y = 0; y < tile.height; ++y) {
    std::byte* to = plane.at(tile.origin, y);
    const std::int32_t whole = tile.width / kBlockSize;
    for (std::int32_t c = 0; c < whole; ++c) {
      std::byte* p = to + plane.pixel_bytes() * kBlockSize * static_cast<std::size_t>(c);
      const Four v = load<Four>(block_row(buffer, y, c));
      if (plane.narrow) store(p, __builtin_convertvector(v, FourHalves)); else store_four(p, v, plane.streaming);
    }
    for (std::int32_t x = whole * kBlockSize; x < tile.width; ++x) {
      std::byte* p = to + plane.pixel_bytes() * static_cast<std::size_t>(x);
      const std::uint32_t v = block_row(buffer, y, whole)[x % kBlockSize];
      if (plane.narrow) store(p, static_cast<std::uint16_t>(v)); else store(p, v);
    }
  }
}

/// Fills a rectangle of a plane in VRAM.
inline void fill_plane(const Plane& plane, const PixelRect& rect, std::uint32_t value) {
  const auto pixels = static_cast<std::size_t>(rect.x1 - rect.x0);
  const U32 wide = splat_u(plane.narrow ? value | value << 16 : value);
  const Four four = Four{} + (plane.narrow ? value | value << 16 : value);
  for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
    std::byte* p = plane.at({rect.x0, y}, 0);
    std::size_t left = pixels * plane.pixel_bytes();
    if (plane.streaming && reinterpret_cast<std::uintptr_t>(p) % sizeof four == 0)
      for (; left >= sizeof four; left -= sizeof four, p += sizeof four) store_four(p, four, true);
    for (; left >= sizeof wide; left -= sizeof wide, p += sizeof wide) store(p, wide);
    for (; left >= sizeof four; left -= sizeof four, p += sizeof four) store(p, four);
    std::memcpy(p, &four, left);
  }
}

/// The part of a clear within a tile, counted from the tile's first pixel.
inline PixelRect within_tile(const PixelRect& r, const TileExtent& tile) {
  return {std::max<std::int32_t>(r.x0 - tile.origin.x, 0), std::max<std::int32_t>(r.y0 - tile.origin.y, 0),
          std::min<std::int32_t>(r.x1 - tile.origin.x, tile.width),
          std::min<std::int32_t>(r.y1 - tile.origin.y, tile.height)};
}
inline bool fills_tile(const PixelRect& in_tile, const TileExtent& tile) {
  return in_tile.x0 == 0 && in_tile.y0 == 0 && in_tile.x1 == tile.width && in_tile.y1 == tile.height;
}

/// Fills the part of a buffer.
inline void fill_buffer(std::uint32_t* buffer, const PixelRect& in_tile, bool whole, std::uint32_t value) {
  if (whole) {
    const U32 v = splat_u(value);
    for (std::int32_t i = 0; i < kTilePixels; i += kLanes) store(buffer + i, v);
    return;
  }
  for (std::int32_t y = in_tile.y0; y < in_tile.y1; ++y)
    for (std::int32_t x = in_tile.x0; x < in_tile.x1; ++x) block_row(buffer, y, x / kBlockSize)[x % kBlockSize] = value;
}

}  // namespace
}  // namespace usuzumi::gfx::soft::USUZUMI_KERNEL
