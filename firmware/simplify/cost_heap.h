// A priority queue of numbered things, each in it once at most, whose costs change while they wait.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/simplify/edge_key.h"

namespace usuzumi::firmware {

/// A heap of keys, least first. A key has a total order and tells its number: `edge_of(key)`. Numbers are below
/// place_of.size(); at most slots.size() of them wait at a time.
template <class Key>
class KeyHeap {
 public:
  KeyHeap() = default;
  /// Empty, whatever the memory held.
  KeyHeap(std::span<Key> slots, std::span<std::uint32_t> place_of) : slots_(slots), place_of_(place_of) {
    for (std::uint32_t& place : place_of_) place = kAbsent;
  }

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  bool contains(std::uint32_t number) const { return place_of_[number] != kAbsent; }
  Key top() const { return slots_[0]; }
  Key pop() {
    const Key top = slots_[0];
    remove(edge_of(top));
    return top;
  }
  /// Takes the key's number in, or moves it to where its new key belongs.
  void set(Key key) {
    const std::uint32_t place = place_of_[edge_of(key)];
    if (place == kAbsent) sift_up(size_++, key);
    else if (key < slots_[place]) sift_up(place, key);
    else sift_down(place, key);
  }
  /// Nothing where it is not in the heap.
  void remove(std::uint32_t number) {
    const std::uint32_t place = place_of_[number];
    if (place == kAbsent) return;
    place_of_[number] = kAbsent;
    const Key last = slots_[--size_];
    if (place == size_) return;
    if (place > 0 && last < slots_[(place - 1) / kArity]) sift_up(place, last);
    else sift_down(place, last);
  }

 private:
  static constexpr std::uint32_t kAbsent = 0xFFFFFFFFu;
  static constexpr std::size_t kArity = 4;  // four keys lie side by side, and halve the depth of a binary heap

  void put(std::size_t place, Key key) {
    slots_[place] = key;
    place_of_[edge_of(key)] = static_cast<std::uint32_t>(place);
  }
  void sift_up(std::size_t hole, Key key) {
    while (hole > 0) {
      const std::size_t parent = (hole - 1) / kArity;
      if (!(key < slots_[parent])) break;
      put(hole, slots_[parent]);
      hole = parent;
    }
    put(hole, key);
  }
  void sift_down(std::size_t hole, Key key) {
    for (;;) {
      const std::size_t first = hole * kArity + 1;
      if (first >= size_) break;
      const std::size_t last = first + kArity < size_ ? first + kArity : size_;
      std::size_t least = first;
      for (std::size_t child = first + 1; child < last; ++child) least = slots_[child] < slots_[least] ? child : least;
      if (!(slots_[least] < key)) break;
      put(hole, slots_[least]);
      hole = least;
    }
    put(hole, key);
  }

  std::span<Key> slots_;
  std::span<std::uint32_t> place_of_;
  std::size_t size_ = 0;
};

/// By cost, equal costs by the number. Both spans are as long as there are numbers.
class CostHeap : public KeyHeap<EdgeKey> {
 public:
  using KeyHeap::KeyHeap;
  /// Takes `number` in, or moves it to where its new cost belongs. `cost` >= 0.
  void set(std::uint32_t number, float cost) { KeyHeap::set(edge_key(cost, number)); }
};

/// An edge, what its removal costs and how long it is: of edges that cost the same the shorter goes first, then the one
/// of the lower number.
struct EdgeLengthKey {
  float cost = 0;    // no NaN
  float length = 0;  // no NaN
  std::uint32_t edge = 0;

  friend bool operator==(const EdgeLengthKey&, const EdgeLengthKey&) = default;
  friend bool operator<(const EdgeLengthKey& a, const EdgeLengthKey& b) {
    if (a.cost != b.cost) return a.cost < b.cost;
    if (a.length != b.length) return a.length < b.length;
    return a.edge < b.edge;
  }
};
constexpr std::uint32_t edge_of(const EdgeLengthKey& key) { return key.edge; }

}  // namespace usuzumi::firmware
