// An edge and what its collapse costs, in one number that orders edges totally.
#pragma once

#include <bit>
#include <cstdint>

namespace usuzumi::firmware {

/// Cost in bits 63-32 (a non-negative single's bits order as the number does), edge number in bits 31-0: ties are
/// broken by the edge's number.
using EdgeKey = std::uint64_t;
inline EdgeKey edge_key(float cost, std::uint32_t edge) {
  return static_cast<EdgeKey>(std::bit_cast<std::uint32_t>(cost)) << 32 | edge;
}
constexpr std::uint32_t edge_of(EdgeKey key) { return static_cast<std::uint32_t>(key); }
inline float cost_of(EdgeKey key) { return std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32)); }

inline constexpr EdgeKey kEdgeKeyMax = ~EdgeKey{0};

}  // namespace usuzumi::firmware
