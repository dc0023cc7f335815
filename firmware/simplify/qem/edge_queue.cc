#include "firmware/simplify/qem/edge_queue.h"

#include <algorithm>

namespace usuzumi::firmware {
namespace {

// Four children share a cache line and halve the depth of a binary heap.
constexpr std::size_t kArity = 4;

// Sorting: one pass into buckets of equal key range, in place (American flag sort, McIlroy, Bostic & McIlroy 1993),
// then each small bucket by comparison. Costs' bits grow with their logarithm, so the buckets fill about evenly.
constexpr std::size_t kBuckets = 512;

void sort_keys(std::span<EdgeKey> keys) {
  if (keys.size() < kBuckets) {
    std::sort(keys.begin(), keys.end());
    return;
  }
  EdgeKey least = keys[0], most = keys[0];
  for (const EdgeKey key : keys) {
    least = key < least ? key : least;
    most = key > most ? key : most;
  }
  int shift = 0;
  while ((most - least) >> shift >= kBuckets) ++shift;
  std::uint32_t begin[kBuckets + 1] = {}, next[kBuckets];
  for (const EdgeKey key : keys) ++begin[static_cast<std::size_t>((key - least) >> shift) + 1];
  for (std::size_t i = 0; i < kBuckets; ++i) {
    next[i] = begin[i];
    begin[i + 1] += begin[i];
  }
  for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
    while (next[bucket] < begin[bucket + 1]) {
      EdgeKey key = keys[next[bucket]];
      for (;;) {
        const auto home = static_cast<std::size_t>((key - least) >> shift);
        EdgeKey& slot = keys[next[home]++];
        if (home == bucket) {
          slot = key;
          break;
        }
        const EdgeKey displaced = slot;
        slot = key;
        key = displaced;
      }
    }
  }
  for (std::size_t i = 0; i < kBuckets; ++i) {
    const std::span<EdgeKey> bucket = keys.subspan(begin[i], begin[i + 1] - begin[i]);
    if (bucket.size() > 1) std::sort(bucket.begin(), bucket.end());
  }
}

}  // namespace

void EdgeQueue::start(std::size_t count) {
  // The run is read from its front and has to end where the slots end.
  heap_size_ = 0;
  run_begin_ = slots_.size() - count;
  std::copy_backward(slots_.begin(), slots_.begin() + static_cast<std::ptrdiff_t>(count), slots_.end());
  sort_keys(slots_.subspan(run_begin_));
}

EdgeKey EdgeQueue::top() const {
  const EdgeKey run = run_begin_ < slots_.size() ? slots_[run_begin_] : kEdgeKeyMax;
  const EdgeKey heap = heap_size_ > 0 ? slots_[0] : kEdgeKeyMax;
  return run < heap ? run : heap;
}

EdgeKey EdgeQueue::pop() {
  const EdgeKey run = run_begin_ < slots_.size() ? slots_[run_begin_] : kEdgeKeyMax;
  if (heap_size_ == 0 || run < slots_[0]) {
    ++run_begin_;
    return run;
  }
  const EdgeKey top = slots_[0];
  --heap_size_;
  if (heap_size_ > 0) sift_down(0, slots_[heap_size_]);
  return top;
}

bool EdgeQueue::push(EdgeKey key) {
  if (heap_size_ == run_begin_) return false;
  std::size_t hole = heap_size_++;
  while (hole > 0) {
    const std::size_t parent = (hole - 1) / kArity;
    if (slots_[parent] <= key) break;
    slots_[hole] = slots_[parent];
    hole = parent;
  }
  slots_[hole] = key;
  return true;
}

void EdgeQueue::sift_down(std::size_t hole, EdgeKey key) {
  for (;;) {
    const std::size_t first = hole * kArity + 1;
    if (first >= heap_size_) break;
    const std::size_t last = first + kArity < heap_size_ ? first + kArity : heap_size_;
    std::size_t least = first;
    if (last - first == kArity) {
      // A balanced choice without branches: which child is least is as good as random.
      const std::size_t left = slots_[first + 1] < slots_[first] ? first + 1 : first;
      const std::size_t right = slots_[first + 3] < slots_[first + 2] ? first + 3 : first + 2;
      least = slots_[right] < slots_[left] ? right : left;
    } else {
      for (std::size_t child = first + 1; child < last; ++child)
        if (slots_[child] < slots_[least]) least = child;
    }
    if (slots_[least] >= key) break;
    slots_[hole] = slots_[least];
    hole = least;
  }
  slots_[hole] = key;
}

}  // namespace usuzumi::firmware
