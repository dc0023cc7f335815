// CPU clocks that the firmware's work takes on the simulated machine.
//
// Plausible for an in-order Cortex-A/R class core with caches and drawing data in serial flash; of no product, measured
// on none. Each number is an operation count with one cache line (32 bytes, 40 clocks from flash, 20 from RAM) per 32
// bytes touched in order, and one RAM miss per datum reached by a pointer. Together with the counts the firmware
// charges they make times that depend on the work alone, so that drawing-time control can be tested.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/clock.h"

namespace usuzumi::sim {

struct CpuCost {
  CpuWork work = CpuWork::kCount;
  std::uint32_t clocks = 0;
};

inline constexpr std::array<CpuCost, static_cast<std::size_t>(CpuWork::kCount)> kCpuCosts{{
    {CpuWork::kVertexCopied, 30},        // 20 bytes (position, normal, colour) out of flash, checked, into RAM
    {CpuWork::kIndexCopied, 8},          // 4 bytes likewise, compared with the vertex count
    {CpuWork::kFaceMeasured, 180},       // three corners of 16 multiply-adds and a divide; outcodes, cross product,
                                         // sum; clipped faces average in
    {CpuWork::kConnectivityBuilt, 100},  // three corners counted and placed: five scattered accesses
    {CpuWork::kEdgeCosted, 200},         // two quadrics added, 3x3 solved, error evaluated: about 90 operations,
                                         // 4 misses; the comparison with the horizon with it
    {CpuWork::kQueueOperation, 90},      // its share of sorting a batch, or about four levels of a heap, one miss each
    {CpuWork::kEdgeCollapsed, 500},      // flip and link test around two one-rings of six faces, then relinked
    {CpuWork::kCornerReplayed, 40},      // 12 bytes in order out of flash, one index written at random
    {CpuWork::kVertexMoved, 320},        // two places, two normals from flash at random; mixed, made unit length,
                                         // written at random
    {CpuWork::kCommandWritten, 2},
}};

/// A device register read or written by the CPU, the timer included: uncached, over a slower bus. Software that polls
/// therefore makes time pass.
inline constexpr std::uint32_t kRegisterAccessClocks = 40;

constexpr std::uint32_t cpu_clocks(CpuWork work) { return kCpuCosts[static_cast<std::size_t>(work)].clocks; }

constexpr bool cpu_costs_in_order() {
  for (std::size_t i = 0; i < kCpuCosts.size(); ++i)
    if (static_cast<std::size_t>(kCpuCosts[i].work) != i || kCpuCosts[i].clocks == 0) return false;
  return true;
}
static_assert(cpu_costs_in_order(), "one row per CpuWork, in its order");

}  // namespace usuzumi::sim
