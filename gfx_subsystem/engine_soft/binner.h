// Binning: one job's records, and for every tile the list of those that touch it, in submission order.
#pragma once

#include "gfx_subsystem/engine_soft/memory_pool.h"

namespace usuzumi::gfx::soft {

/// Tiles of a target.
struct TileGrid {
  std::int32_t columns = 0, rows = 0;
  std::uint32_t count() const { return static_cast<std::uint32_t>(columns * rows); }
};

/// Tiles from first to last, inclusive.
struct TileRange {
  std::int32_t x0, y0, x1, y1;
  std::uint32_t count() const { return static_cast<std::uint32_t>((x1 - x0 + 1) * (y1 - y0 + 1)); }
};

class Binner {
 public:
  Binner(SlotPool& pool, TileGrid grid, TileList* lists) : pool_(pool), grid_(grid), lists_(lists) {}

  /// Makes sure that a record of `record_slots` can be added to all tiles of `range`: each may need a new block.
  /// Nothing has changed when the pool refuses.
  bool reserve(std::uint32_t record_slots, const TileRange& range) {
    const std::uint32_t need = record_slots + range.count();
    return need <= end_ - cursor_ || refill(need);
  }

  /// After reserve(): the record's slot.
  std::uint32_t take_record(std::uint32_t slots) {
    const std::uint32_t at = cursor_;
    cursor_ += slots;
    return at;
  }

  /// After reserve().
  void append(const TileRange& range, std::uint32_t entry) {
    if (range.x0 == range.x1 && range.y0 == range.y1) [[likely]]
      return append(lists_[range.y0 * grid_.columns + range.x0], entry);
    for (std::int32_t y = range.y0; y <= range.y1; ++y)
      for (std::int32_t x = range.x0; x <= range.x1; ++x) append(lists_[y * grid_.columns + x], entry);
  }

  template <class Record>
  Record& record(std::uint32_t slot) { return pool_.at<Record>(slot); }

 private:
  void append(TileList& list, std::uint32_t entry) {
    const std::uint32_t place = list.count % EntryBlock::kEntries;
    if (place == 0) {
      const std::uint32_t block = cursor_++;
      if (list.count == 0) list.first = block; else pool_.at<EntryBlock>(list.last).next = block;
      list.last = block;
    }
    pool_.at<EntryBlock>(list.last).entry[place] = entry;
    ++list.count;
  }

  /// Slots are taken a page at a time so that threads seldom meet; small pools have small pages.
  bool refill(std::uint32_t need) {
    const std::uint32_t page =
        pool_.capacity() / 256 < 16 ? 16 : (pool_.capacity() / 256 > 256 ? 256 : pool_.capacity() / 256);
    const std::uint32_t counts[] = {need > page ? need : page, need};
    for (const std::uint32_t count : counts) {
      const std::uint32_t at = pool_.take(count);
      if (at == SlotPool::kNone) continue;
      cursor_ = at;
      end_ = at + count;
      return true;
    }
    return false;
  }

  SlotPool& pool_;
  TileGrid grid_;
  TileList* lists_;
  std::uint32_t cursor_ = 0, end_ = 0;
};

}  // namespace usuzumi::gfx::soft
