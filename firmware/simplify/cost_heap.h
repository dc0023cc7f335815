// A priority queue of numbered things, each in it once at most, whose costs change while they wait.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/simplify/edge_key.h"

namespace usuzumi::firmware {

/// A heap of keys (cost, number), least first; equal costs go by the number. Numbers are below place_of.size().
class CostHeap {
 public:
  CostHeap() = default;
  /// Both spans are as long as there are numbers. Empty.
  CostHeap(std::span<EdgeKey> slots, std::span<std::uint32_t> place_of);

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  bool contains(std::uint32_t number) const { return place_of_[number] != kAbsent; }
  EdgeKey top() const { return slots_[0]; }
  EdgeKey pop();
  /// Takes `number` in, or moves it to where its new cost belongs. `cost` >= 0.
  void set(std::uint32_t number, float cost);
  /// Nothing where it is not in the heap.
  void remove(std::uint32_t number);

 private:
  static constexpr std::uint32_t kAbsent = 0xFFFFFFFFu;

  void put(std::size_t place, EdgeKey key) {
    slots_[place] = key;
    place_of_[edge_of(key)] = static_cast<std::uint32_t>(place);
  }
  void sift_up(std::size_t hole, EdgeKey key);
  void sift_down(std::size_t hole, EdgeKey key);

  std::span<EdgeKey> slots_;
  std::span<std::uint32_t> place_of_;
  std::size_t size_ = 0;
};

}  // namespace usuzumi::firmware
