#include "firmware/simplify/cost_heap.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <utility>
#include <vector>

namespace usuzumi::testing {
namespace {

using firmware::CostHeap;
using firmware::EdgeKey;

TEST(CostHeap, EqualCostsGoByTheirNumbers) {
  std::vector<EdgeKey> slots(4);
  std::vector<std::uint32_t> places(4);
  CostHeap heap(slots, places);
  for (const std::uint32_t number : {2u, 0u, 3u, 1u}) heap.set(number, 7.0f);
  for (std::uint32_t number = 0; number < 4; ++number) EXPECT_EQ(firmware::edge_of(heap.pop()), number);
  EXPECT_TRUE(heap.empty());
}

// Against an ordered set, over random insertions, changes, removals and pops.
TEST(CostHeap, FollowsAnOrderedSet) {
  constexpr std::uint32_t kNumbers = 300;
  std::mt19937 random(5);
  std::vector<EdgeKey> slots(kNumbers);
  std::vector<std::uint32_t> places(kNumbers);
  CostHeap heap(slots, places);
  std::set<std::pair<float, std::uint32_t>> reference;
  std::vector<float> cost(kNumbers, -1);
  for (int i = 0; i < 20000; ++i) {
    const auto number = static_cast<std::uint32_t>(random() % kNumbers);
    ASSERT_EQ(heap.contains(number), cost[number] >= 0);
    switch (random() % 4) {
      case 0:
      case 1:
        reference.erase({cost[number], number});
        cost[number] = static_cast<float>(random() % 50);
        reference.insert({cost[number], number});
        heap.set(number, cost[number]);
        break;
      case 2:
        reference.erase({cost[number], number});
        cost[number] = -1;
        heap.remove(number);
        break;
      default:
        if (reference.empty()) break;
        ASSERT_EQ(heap.top(), firmware::edge_key(reference.begin()->first, reference.begin()->second));
        ASSERT_EQ(firmware::edge_of(heap.pop()), reference.begin()->second);
        cost[reference.begin()->second] = -1;
        reference.erase(reference.begin());
    }
    ASSERT_EQ(heap.size(), reference.size());
  }
}

// With a second number to order by, and fewer slots than numbers, as edges have.
TEST(KeyHeap, EqualCostsGoByLengthThenByEdge) {
  std::vector<firmware::EdgeLengthKey> slots(5);
  std::vector<std::uint32_t> places(40, 3);
  firmware::KeyHeap<firmware::EdgeLengthKey> heap(slots, places);
  EXPECT_TRUE(heap.empty());
  const std::vector<firmware::EdgeLengthKey> sorted = {{1, 5, 9}, {2, 1, 8}, {2, 1, 31}, {2, 3, 1}, {4, 0, 0}};
  for (const std::size_t i : {3u, 1u, 4u, 0u, 2u}) heap.set(sorted[i]);
  heap.set({9, 9, 9});  // the first, for a while the last
  heap.set(sorted[0]);
  for (const firmware::EdgeLengthKey& key : sorted) EXPECT_EQ(heap.pop(), key);
  EXPECT_TRUE(heap.empty());
}

}  // namespace
}  // namespace usuzumi::testing
