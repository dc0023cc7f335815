// The order of edges, against a sorted list.
#include "firmware/simplify/qem/edge_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "tests/firmware/simplify/qem/edge_keys.h"

namespace usuzumi::testing {
namespace {

using firmware::edge_key;
using firmware::EdgeKey;
using firmware::EdgeQueue;

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

TEST(EdgeQueue, ABatchComesBackSorted) {
  for (const std::size_t count : {1u, 17u, 511u, 512u, 5000u, 40000u}) {
    std::vector<EdgeKey> memory(count + 1), keys = random_keys(count, 5);
    EdgeQueue queue(memory);
    std::copy(keys.begin(), keys.end(), queue.slots().begin());
    queue.start(count);
    std::sort(keys.begin(), keys.end());
    for (const EdgeKey key : keys) {
      ASSERT_FALSE(queue.empty());
      EXPECT_EQ(queue.top(), key);
      ASSERT_EQ(queue.pop(), key);
    }
    EXPECT_TRUE(queue.empty());
  }
}

TEST(EdgeQueue, PushedKeysComeInTheirPlace) {
  std::vector<EdgeKey> memory(3000), keys = random_keys(3000, 7);
  EdgeQueue queue(memory);
  std::copy_n(keys.begin(), 2000, queue.slots().begin());
  queue.start(2000);
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
  std::vector<EdgeKey> memory(16);
  EdgeQueue queue(memory);
  for (std::uint32_t i = 0; i < memory.size(); ++i) EXPECT_TRUE(queue.push(edge_key(1, i)));
  EXPECT_FALSE(queue.push(edge_key(0, 99)));
  EXPECT_EQ(queue.pop(), edge_key(1, 0));
  EXPECT_TRUE(queue.push(edge_key(0, 99)));
  EXPECT_EQ(queue.pop(), edge_key(0, 99));
}

}  // namespace
}  // namespace usuzumi::testing
