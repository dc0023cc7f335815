// Some edges in order of collapse cost, in a fixed piece of memory.
//
// A batch is sorted once and read from the front; an edge that comes back with a new cost goes to a small heap that
// grows into the room the reader has left.
#pragma once

#include <cstddef>
#include <span>

#include "firmware/simplify/edge_key.h"

namespace usuzumi::firmware {

class EdgeQueue {
 public:
  explicit EdgeQueue(std::span<EdgeKey> slots) : slots_(slots), run_begin_(slots.size()) {}

  /// Where a batch is put, in any order, before start(): all the slots. The queue is empty.
  std::span<EdgeKey> slots() { return slots_; }
  /// Takes the first `count` slots as the batch.
  void start(std::size_t count);

  bool empty() const { return run_begin_ == slots_.size() && heap_size_ == 0; }
  EdgeKey top() const;
  EdgeKey pop();
  /// False, and nothing kept, where there is no room.
  bool push(EdgeKey key);

  /// Keys of the batch still to come, and the i-th of them.
  std::size_t run_left() const { return slots_.size() - run_begin_; }
  EdgeKey in_run(std::size_t i) const { return slots_[run_begin_ + i]; }

 private:
  void sift_down(std::size_t hole, EdgeKey key);

  std::span<EdgeKey> slots_;
  std::size_t run_begin_ = 0;  // the sorted batch is [run_begin_, slots_.size())
  std::size_t heap_size_ = 0;  // the heap is [0, heap_size_)
};

}  // namespace usuzumi::firmware
