// The cheapest edges of the mesh, in the order of their faces, from which batches for the queue are taken.
//
// Edges far apart do not know of each other: collapsing all that cost less than some limit gives nearly the same
// surface in whatever order regions come. So the edges below a limit are taken a batch of neighbours at a time, whose
// part of the mesh stays in the near caches, and only within a batch by cost. What is left of a pass returns to its
// place.
#pragma once

#include <cstddef>
#include <span>

#include "firmware/simplify/edge_key.h"

namespace usuzumi::firmware {

class EdgeCandidates {
 public:
  /// At least two slots.
  explicit EdgeCandidates(std::span<EdgeKey> slots) : slots_(slots) {}

  /// Filling: begin, then offer every edge in the order of faces. Only the cheapest that fit are kept.
  void begin_fill();
  void offer(EdgeKey key) {
    slots_[count_] = key;  // stored in any case, counted where it is cheap: as good as random, so no branch
    count_ += key < horizon_ ? 1u : 0u;
    if (count_ == slots_.size()) halve();
  }
  /// Every edge not kept by the fill has a key of at least this.
  EdgeKey horizon() const { return horizon_; }

  std::size_t size() const { return count_; }
  /// The key at place `rank` (from 0) of the sorted candidates; the horizon where there are no more than that.
  EdgeKey key_of_rank(std::size_t rank) const;

  /// A pass: begin, then take batches until one is empty.
  void begin_pass() { read_ = write_ = 0; }
  /// Moves the next keys below `limit` to `batch`, which holds at least one, as many as fit; how many.
  std::size_t take(EdgeKey limit, std::span<EdgeKey> batch);
  /// Between two batches of a pass: keeps a key for the next pass, where it is below the horizon and there is room.
  /// False where there is none.
  bool keep(EdgeKey key) {
    if (key >= horizon_) return true;
    if (write_ == read_) return false;
    slots_[write_++] = key;
    return true;
  }

 private:
  void halve();

  std::span<EdgeKey> slots_;
  EdgeKey horizon_ = kEdgeKeyMax;
  std::size_t count_ = 0;
  std::size_t read_ = 0;   // of a pass: [write_, read_) is free
  std::size_t write_ = 0;
};

}  // namespace usuzumi::firmware
