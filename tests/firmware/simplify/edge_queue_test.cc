// The order of edges, against a sorted list.
#include "firmware/simplify/edge_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <random>
#include <set>
#include <vector>

namespace usuzumi::testing {
namespace {

using firmware::edge_key;
using firmware::EdgeKey;
using firmware::EdgeQueue;

std::vector<EdgeKey> random_keys(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<EdgeKey> keys;
  for (std::size_t i = 0; i < count; ++i) {
    // Costs over many magnitudes, with many ties.
    const float cost = static_cast<float>(random() % 64) * std::bit_cast<float>(static_cast<std::uint32_t>((127u - random() % 40u) << 23));
    keys.push_back(edge_key(cost, static_cast<std::uint32_t>(i)));
  }
  std::shuffle(keys.begin(), keys.end(), random);
  return keys;
}

TEST(EdgeQueue, BeginsEmptyWhateverItsMemoryHolds) {
  std::vector<EdgeKey> memory(64, 0);
  EdgeQueue queue(memory);
  EXPECT_TRUE(queue.empty());
}

TEST(EdgeQueue, KeysOrderByCostThenByEdge) {
  EXPECT_LT(edge_key(0.0f, 9), edge_key(1e-30f, 0));
  EXPECT_LT(edge_key(1.5f, 9), edge_key(1.75f, 0));
  EXPECT_LT(edge_key(1.5f, 3), edge_key(1.5f, 4));
  EXPECT_EQ(firmware::edge_of(edge_key(1.5f, 77)), 77u);
  EXPECT_EQ(firmware::cost_of(edge_key(1.5f, 77)), 1.5f);
}

TEST(EdgeQueue, AFillThatFitsComesBackSorted) {
  for (const std::size_t count : {1u, 17u, 511u, 512u, 5000u, 40000u}) {
    std::vector<EdgeKey> memory(count + 1), keys = random_keys(count, 5);
    EdgeQueue queue(memory);
    queue.begin_fill();
    for (const EdgeKey key : keys) queue.offer(key);
    queue.end_fill();
    EXPECT_EQ(queue.horizon(), firmware::kEdgeKeyMax);
    std::sort(keys.begin(), keys.end());
    for (const EdgeKey key : keys) {
      ASSERT_FALSE(queue.empty());
      EXPECT_EQ(queue.top(), key);
      ASSERT_EQ(queue.pop(), key);
    }
    EXPECT_TRUE(queue.empty());
  }
}

TEST(EdgeQueue, AFillThatDoesNotFitKeepsTheCheapestAndSaysHowFar) {
  std::vector<EdgeKey> memory(1000), keys = random_keys(20000, 6);
  EdgeQueue queue(memory);
  queue.begin_fill();
  for (const EdgeKey key : keys) queue.offer(key);
  queue.end_fill();
  std::sort(keys.begin(), keys.end());
  std::size_t kept = 0;
  while (!queue.empty()) ASSERT_EQ(queue.pop(), keys[kept++]);
  EXPECT_GE(kept, 500u);
  EXPECT_GE(keys[kept], queue.horizon());
  EXPECT_LT(keys[kept - 1], queue.horizon());
}

TEST(EdgeQueue, PushedKeysComeInTheirPlace) {
  std::vector<EdgeKey> memory(3000), keys = random_keys(3000, 7);
  EdgeQueue queue(memory);
  queue.begin_fill();
  for (std::size_t i = 0; i < 2000; ++i) queue.offer(keys[i]);
  queue.end_fill();
  std::set<EdgeKey> expected(keys.begin(), keys.begin() + 2000);
  std::mt19937 random(8);
  std::size_t next = 2000;
  while (!queue.empty()) {
    if (next < keys.size() && random() % 2 == 0) {
      if (queue.push(keys[next])) expected.insert(keys[next]);
      ++next;
    }
    ASSERT_EQ(queue.pop(), *expected.begin());
    expected.erase(expected.begin());
  }
  EXPECT_TRUE(expected.empty());
  EXPECT_EQ(next, keys.size());
}

TEST(EdgeQueue, TakesNoMoreThanItsMemory) {
  std::vector<EdgeKey> memory(EdgeQueue::kLeastSlots);
  EdgeQueue queue(memory);
  for (std::uint32_t i = 0; i < memory.size(); ++i) EXPECT_TRUE(queue.push(edge_key(1, i)));
  EXPECT_FALSE(queue.push(edge_key(0, 99)));
  EXPECT_EQ(queue.pop(), edge_key(1, 0));
  EXPECT_TRUE(queue.push(edge_key(0, 99)));
  EXPECT_EQ(queue.pop(), edge_key(0, 99));
}

}  // namespace
}  // namespace usuzumi::testing
