// Edges in order of collapse cost, in a fixed piece of memory.
//
// A fill is sorted once and read from the front; an edge that comes back with a new cost goes to a small heap that grows
// into the room the reader has left. What lies beyond the fill's horizon, or does not fit, is not kept at all: the next
// fill finds it again. One 64-bit key per edge, so ties are broken by the edge's number.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace usuzumi::firmware {

/// Cost in bits 63-32 (a non-negative single's bits order as the number does), edge number in bits 31-0.
using EdgeKey = std::uint64_t;
inline EdgeKey edge_key(float cost, std::uint32_t edge) {
  return static_cast<EdgeKey>(std::bit_cast<std::uint32_t>(cost)) << 32 | edge;
}
constexpr std::uint32_t edge_of(EdgeKey key) { return static_cast<std::uint32_t>(key); }
inline float cost_of(EdgeKey key) { return std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32)); }

inline constexpr EdgeKey kEdgeKeyMax = ~EdgeKey{0};

class EdgeQueue {
 public:
  /// At least kLeastSlots slots.
  explicit EdgeQueue(std::span<EdgeKey> slots) : slots_(slots), run_begin_(slots.size()) {}
  static constexpr std::size_t kLeastSlots = 16;

  /// Filling: begin, offer every edge, end. Only the cheapest that fit are kept.
  void begin_fill();
  void offer(EdgeKey key) {
    if (key < horizon_) {
      slots_[filled_++] = key;
      if (filled_ == slots_.size()) halve_fill();
    }
  }
  void end_fill();

  /// Every edge not kept by the fill has a key of at least this.
  EdgeKey horizon() const { return horizon_; }
  bool empty() const { return run_begin_ == slots_.size() && heap_size_ == 0; }
  EdgeKey top() const;
  EdgeKey pop();
  /// Keys of the sorted run still to come, and the i-th of them.
  std::size_t run_left() const { return slots_.size() - run_begin_; }
  EdgeKey in_run(std::size_t i) const { return slots_[run_begin_ + i]; }
  /// False, and nothing kept, where the key is beyond the horizon or there is no room.
  bool push(EdgeKey key);

 private:
  void halve_fill();
  void sift_down(std::size_t hole, EdgeKey key);

  std::span<EdgeKey> slots_;
  EdgeKey horizon_ = kEdgeKeyMax;
  std::size_t filled_ = 0;
  std::size_t run_begin_ = 0;  // the sorted run is [run_begin_, slots_.size())
  std::size_t heap_size_ = 0;  // the heap is [0, heap_size_)
};

}  // namespace usuzumi::firmware
