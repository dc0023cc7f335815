#include "firmware/simplify/cost_heap.h"

namespace usuzumi::firmware {
namespace {

constexpr std::size_t kArity = 4;  // four keys share half a cache line, and halve the depth of a binary heap

}  // namespace

CostHeap::CostHeap(std::span<EdgeKey> slots, std::span<std::uint32_t> place_of) : slots_(slots), place_of_(place_of) {
  for (std::uint32_t& place : place_of_) place = kAbsent;
}

EdgeKey CostHeap::pop() {
  const EdgeKey top = slots_[0];
  remove(edge_of(top));
  return top;
}

void CostHeap::set(std::uint32_t number, float cost) {
  const EdgeKey key = edge_key(cost, number);
  const std::uint32_t place = place_of_[number];
  if (place == kAbsent) sift_up(size_++, key);
  else if (key < slots_[place]) sift_up(place, key);
  else sift_down(place, key);
}

void CostHeap::remove(std::uint32_t number) {
  const std::uint32_t place = place_of_[number];
  if (place == kAbsent) return;
  place_of_[number] = kAbsent;
  const EdgeKey last = slots_[--size_];
  if (place == size_) return;
  if (place > 0 && last < slots_[(place - 1) / kArity]) sift_up(place, last);
  else sift_down(place, last);
}

void CostHeap::sift_up(std::size_t hole, EdgeKey key) {
  while (hole > 0) {
    const std::size_t parent = (hole - 1) / kArity;
    if (slots_[parent] <= key) break;
    put(hole, slots_[parent]);
    hole = parent;
  }
  put(hole, key);
}

void CostHeap::sift_down(std::size_t hole, EdgeKey key) {
  for (;;) {
    const std::size_t first = hole * kArity + 1;
    if (first >= size_) break;
    const std::size_t last = first + kArity < size_ ? first + kArity : size_;
    std::size_t least = first;
    for (std::size_t child = first + 1; child < last; ++child) least = slots_[child] < slots_[least] ? child : least;
    if (slots_[least] >= key) break;
    put(hole, slots_[least]);
    hole = least;
  }
  put(hole, key);
}

}  // namespace usuzumi::firmware
