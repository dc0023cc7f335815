// The table of cheapest edges, against sorted lists.
#include "firmware/simplify/qem/edge_candidates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "tests/firmware/simplify/qem/edge_keys.h"

namespace usuzumi::testing {
namespace {

using firmware::edge_key;
using firmware::EdgeCandidates;
using firmware::EdgeKey;
using firmware::kEdgeKeyMax;

void fill(EdgeCandidates& candidates, const std::vector<EdgeKey>& keys) {
  candidates.begin_fill();
  for (const EdgeKey key : keys) candidates.offer(key);
}

// Everything below `limit`, in batches of `size`, in the order it comes.
std::vector<EdgeKey> take_all(EdgeCandidates& candidates, EdgeKey limit, std::size_t size) {
  std::vector<EdgeKey> all, batch(size);
  candidates.begin_pass();
  while (const std::size_t count = candidates.take(limit, batch))
    all.insert(all.end(), batch.begin(), batch.begin() + static_cast<std::ptrdiff_t>(count));
  return all;
}

TEST(EdgeCandidates, WhatFitsIsKeptInTheOrderItCame) {
  const std::vector<EdgeKey> keys = random_keys(999, 1);
  std::vector<EdgeKey> memory(1000);
  EdgeCandidates candidates(memory);
  fill(candidates, keys);
  EXPECT_EQ(candidates.horizon(), kEdgeKeyMax);
  EXPECT_EQ(candidates.size(), 999u);
  EXPECT_EQ(take_all(candidates, kEdgeKeyMax, 64), keys);
  EXPECT_EQ(candidates.size(), 0u);
}

TEST(EdgeCandidates, OfMoreThanFitTheCheapestStayInOrder) {
  for (const std::size_t slots : {100u, 1000u, 6000u}) {  // few and many keys are counted by digits of different size
    const std::vector<EdgeKey> keys = random_keys(20000, 2);
    std::vector<EdgeKey> memory(slots);
    EdgeCandidates candidates(memory);
    fill(candidates, keys);
    EXPECT_GE(candidates.size(), slots / 2);
    EXPECT_LT(candidates.size(), slots);
    std::vector<EdgeKey> cheapest;  // all that are below the horizon, no other
    for (const EdgeKey key : keys)
      if (key < candidates.horizon()) cheapest.push_back(key);
    EXPECT_EQ(take_all(candidates, kEdgeKeyMax, 64), cheapest) << slots;
  }
}

TEST(EdgeCandidates, RankIsThePlaceInASortedList) {
  for (const std::size_t count : {1u, 2u, 300u, 4095u, 4096u, 30000u}) {
    std::vector<EdgeKey> keys = random_keys(count, 3), memory(count + 1);
    EdgeCandidates candidates(memory);
    fill(candidates, keys);
    std::sort(keys.begin(), keys.end());
    for (const std::size_t rank : {std::size_t{0}, count / 3, count / 2, count - 1})
      EXPECT_EQ(candidates.key_of_rank(rank), keys[rank]) << rank << " of " << count;
    EXPECT_EQ(candidates.key_of_rank(count), kEdgeKeyMax);
  }
}

TEST(EdgeCandidates, RankSeesTheLastBitOfAKey) {
  std::vector<EdgeKey> memory(5000);
  EdgeCandidates candidates(memory);
  candidates.begin_fill();
  for (std::uint32_t edge = 4500; edge-- > 0;) candidates.offer(edge_key(0, edge));  // a flat sheet: all cost nothing
  EXPECT_EQ(candidates.key_of_rank(2251), edge_key(0, 2251));
  candidates.begin_fill();
  candidates.offer(edge_key(std::numeric_limits<float>::infinity(), 0xFFFFFFFFu));
  candidates.offer(edge_key(std::numeric_limits<float>::max(), 0xFFFFFFFFu));
  EXPECT_EQ(candidates.key_of_rank(1), edge_key(std::numeric_limits<float>::infinity(), 0xFFFFFFFFu));
}

TEST(EdgeCandidates, APassLeavesWhatCostsMoreAndWhatIsKept) {
  std::vector<EdgeKey> memory(100), batch(2);
  EdgeCandidates candidates(memory);
  fill(candidates, {edge_key(5, 1), edge_key(1, 2), edge_key(2, 3), edge_key(6, 4), edge_key(3, 5)});
  const EdgeKey limit = edge_key(4, 0);
  candidates.begin_pass();
  ASSERT_EQ(candidates.take(limit, batch), 2u);
  EXPECT_EQ(batch, (std::vector{edge_key(1, 2), edge_key(2, 3)}));
  candidates.keep(edge_key(4.5f, 2));  // grown dearer; returns to where it was taken from
  ASSERT_EQ(candidates.take(limit, batch), 1u);
  EXPECT_EQ(batch[0], edge_key(3, 5));
  EXPECT_EQ(candidates.take(limit, batch), 0u);
  EXPECT_EQ(take_all(candidates, kEdgeKeyMax, 10), (std::vector{edge_key(5, 1), edge_key(4.5f, 2), edge_key(6, 4)}));
}

TEST(EdgeCandidates, KeepsNothingBeyondTheHorizonOrItsRoom) {
  std::vector<EdgeKey> memory(4), batch(4);
  EdgeCandidates candidates(memory);
  fill(candidates, {edge_key(1, 1), edge_key(2, 2), edge_key(3, 3), edge_key(4, 4)});  // full: halved at once
  ASSERT_EQ(candidates.horizon(), edge_key(3, 3));
  candidates.begin_pass();
  ASSERT_EQ(candidates.take(kEdgeKeyMax, batch), 2u);
  candidates.keep(edge_key(3, 3));
  candidates.keep(edge_key(1.25f, 7));
  candidates.keep(edge_key(1.5f, 8));
  candidates.keep(edge_key(1.75f, 9));  // two were taken: there is no third place
  EXPECT_EQ(candidates.take(kEdgeKeyMax, batch), 0u);
  EXPECT_EQ(take_all(candidates, kEdgeKeyMax, 4), (std::vector{edge_key(1.25f, 7), edge_key(1.5f, 8)}));
}

}  // namespace
}  // namespace usuzumi::testing
