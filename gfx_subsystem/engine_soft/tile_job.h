// One tile of a round: load what the lists do not clear first, rasterize the lists in order, store.
#pragma once

#include "gfx_subsystem/engine_soft/raster_big.h"
#include "gfx_subsystem/engine_soft/tile_memory.h"

namespace usuzumi::gfx::soft::USUZUMI_KERNEL {
namespace {

/// Calls visit(entry) for every entry of the tile's lists, in submission order, until it returns false.
template <class Visit>
[[gnu::always_inline]] inline void for_each_entry(const Round& r, std::uint32_t tile, std::uint32_t jobs, Visit visit) {
  for (std::uint32_t j = 0; j < jobs; ++j) {
    const TileList& list = r.jobs[j].lists[tile];
    std::uint32_t block = list.first;
    for (std::uint32_t done = 0; done < list.count;) {
      const EntryBlock& entries = r.pool->at<EntryBlock>(block);
      const std::uint32_t in_block = std::min(list.count - done, EntryBlock::kEntries);
      for (std::uint32_t i = 0; i < in_block; ++i)
        if (!visit(entries.entry[i])) return;
      done += in_block;
      if (done < list.count) block = entries.next;
    }
  }
}

inline std::uint32_t entry_kind(std::uint32_t entry) { return entry >> kEntryKindShift; }
inline const ClearOperation* as_clear(const Round& r, std::uint32_t entry) {
  return entry_kind(entry) == static_cast<std::uint32_t>(EntryKind::kClear) ? &r.clears[entry & kEntrySlotMask]
                                                                            : nullptr;
}

/// What the entries at the head of a tile's lists make needless: clears that fill the tile before anything is drawn.
struct TilePrologue {
  bool any = false;          // the lists hold something
  bool only_clears = true;
  bool colour_filled = false, depth_filled = false;
};

inline TilePrologue look_ahead(const Round& r, const TileExtent& extent, std::uint32_t tile, std::uint32_t jobs) {
  TilePrologue p;
  for_each_entry(r, tile, jobs, [&](std::uint32_t entry) {
    p.any = true;
    const ClearOperation* clear = as_clear(r, entry);
    p.only_clears = clear != nullptr;
    if (clear == nullptr) return false;
    if (fills_tile(within_tile(clear->rect, extent), extent)) {
      p.colour_filled |= clear->colour;
      p.depth_filled |= clear->depth;
    }
    return true;
  });
  return p;
}

/// A tile that is only cleared never passes through the buffers.
inline void clear_in_place(const Round& r, const TileExtent& extent, std::uint32_t tile, std::uint32_t jobs) {
  for_each_entry(r, tile, jobs, [&](std::uint32_t entry) {
    const ClearOperation& c = *as_clear(r, entry);
    PixelRect rect = within_tile(c.rect, extent);
    rect = {rect.x0 + extent.origin.x, rect.y0 + extent.origin.y, rect.x1 + extent.origin.x, rect.y1 + extent.origin.y};
    if (c.colour) fill_plane(colour_plane(r), rect, c.pixel);
    if (c.depth) fill_plane(depth_plane(r), rect, c.depth_value);
    return true;
  });
}

/// Counts what a draw of fragments costs besides.
inline std::uint64_t count_fragments(const DrawSetup& d, std::uint64_t covered, Worker& worker) {
  worker.texels_fetched += covered * d.texels_per_pixel;
  worker.pixels_blended += d.blend ? covered : 0;
  return covered;
}

template <bool kRgb565>
std::uint64_t raster_entries(const Round& r, const TileExtent& extent, const TileBuffers& buffers, std::uint32_t tile,
                             std::uint32_t jobs, Worker& worker) {
  std::uint64_t covered = 0;
  for_each_entry(r, tile, jobs, [&](std::uint32_t entry) {
    const std::uint32_t slot = entry & kEntrySlotMask;
    const auto small = [&](auto shading) {
      constexpr Shading kShading = decltype(shading)::value;
      const auto& t = r.pool->at<SmallTriangle>(slot);
      const DrawSetup& d = r.draws[t.draw & ~kClippedBox];
      covered += d.depth_test ? raster_small<kShading, true, kRgb565>(d, t, extent.origin, buffers)
                              : raster_small<kShading, false, kRgb565>(d, t, extent.origin, buffers);
    };
    switch (entry_kind(entry)) {
      case 0: small(std::integral_constant<Shading, Shading::kConstant>{}); break;
      case 1: small(std::integral_constant<Shading, Shading::kAffine>{}); break;
      case 2: small(std::integral_constant<Shading, Shading::kPerspective>{}); break;
      case static_cast<std::uint32_t>(EntryKind::kBig): {
        const auto& t = r.pool->at<BigTriangle>(slot);
        covered += count_fragments(r.draws[t.draw],
                                   raster_big<kRgb565>(r.draws[t.draw], t, extent.origin, buffers), worker);
        break;
      }
      case static_cast<std::uint32_t>(EntryKind::kFragment): {
        const auto& t = r.pool->at<SmallTriangle>(slot);
        const DrawSetup& d = r.draws[t.draw & ~kClippedBox];
        const std::uint32_t drawn = with_fetch(d, [&](auto fetch) {
          return raster_small_fragments<decltype(fetch)::value>(d, t, extent.origin, buffers);
        });
        covered += count_fragments(d, drawn, worker);
        break;
      }
      default: {
        const ClearOperation& c = r.clears[slot];
        const PixelRect rect = within_tile(c.rect, extent);
        const bool whole = fills_tile(rect, extent);
        if (c.colour) fill_buffer(buffers.colour, rect, whole, c.pixel);
        if (c.depth) fill_buffer(buffers.depth, rect, whole, c.depth_value);
        break;
      }
    }
    return true;
  });
  return covered;
}

void run_tile(const Round& r, Worker& worker, std::uint32_t tile, std::uint32_t jobs) {
  const TileExtent extent = tile_extent(r, tile);
  const TilePrologue prologue = look_ahead(r, extent, tile, jobs);
  if (!prologue.any) return;
  if (prologue.only_clears) {
    clear_in_place(r, extent, tile, jobs);
    return finish_streaming();
  }
  const TileBuffers buffers{worker.colour, worker.depth};
  if (!prologue.colour_filled) load_plane(colour_plane(r), extent, buffers.colour);
  if (r.uses_depth && !prologue.depth_filled) load_plane(depth_plane(r), extent, buffers.depth);
  worker.pixels_tested += r.target.rgb565 ? raster_entries<true>(r, extent, buffers, tile, jobs, worker)
                                          : raster_entries<false>(r, extent, buffers, tile, jobs, worker);
  store_plane(colour_plane(r), extent, buffers.colour);
  if (r.uses_depth) store_plane(depth_plane(r), extent, buffers.depth);
  finish_streaming();
}

/// A band of tile rows of a round that only clears: whole rows at a time, which memory likes better than tiles.
void run_clears(const Round& r, std::uint32_t band) {
  const std::int32_t y0 = static_cast<std::int32_t>(band) * kTileSize;
  for (std::uint32_t i = 0; i < r.clear_count; ++i) {
    const ClearOperation& c = r.clears[i];
    const PixelRect rect{c.rect.x0, std::max(c.rect.y0, y0), c.rect.x1, std::min(c.rect.y1, y0 + kTileSize)};
    if (c.colour) fill_plane(colour_plane(r), rect, c.pixel);
    if (c.depth) fill_plane(depth_plane(r), rect, c.depth_value);
  }
  finish_streaming();
}

}  // namespace
}  // namespace usuzumi::gfx::soft::USUZUMI_KERNEL
