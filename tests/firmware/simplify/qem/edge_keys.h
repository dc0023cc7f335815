// Keys to sort and to choose among.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <random>
#include <vector>

#include "firmware/simplify/edge_key.h"

namespace usuzumi::testing {

/// Costs over many magnitudes, with many ties, shuffled.
inline std::vector<firmware::EdgeKey> random_keys(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<firmware::EdgeKey> keys;
  for (std::size_t i = 0; i < count; ++i) {
    const float cost = static_cast<float>(random() % 64) *
                       std::bit_cast<float>(static_cast<std::uint32_t>((127u - random() % 40u) << 23));
    keys.push_back(firmware::edge_key(cost, static_cast<std::uint32_t>(i)));
  }
  std::shuffle(keys.begin(), keys.end(), random);
  return keys;
}

}  // namespace usuzumi::testing
