// The board's memories: mapped once at start, in addresses of a bus that only this program has.
#pragma once

#include <cstddef>

#include "hal/bus.h"

namespace usuzumi::linux_arm64 {

constexpr std::size_t kMiB = std::size_t{1} << 20;

// Pointers have 64 bits here, the bus has 32: these bases are names, no physical addresses.
constexpr BusAddress kRamBase = 0x1000'0000;
constexpr BusAddress kVramBase = 0x2000'0000;
constexpr BusAddress kRomBase = 0x4000'0000;

constexpr std::size_t kRamBytes = 32 * kMiB;         // tables, thinned copy, room to thin in
constexpr std::size_t kVramBytes = 32 * kMiB;        // two pictures and depth of 1920x1080 take 24 MiB
constexpr std::size_t kEngineWorkBytes = 16 * kMiB;  // of the software 3D engine: about 250 thousand triangles a round
constexpr std::size_t kMostRomBytes = 1024 * kMiB;

static_assert(kRamBase + kRamBytes <= kVramBase && kVramBase + kVramBytes <= kRomBase);
static_assert(kRomBase + kMostRomBytes <= 0xF000'0000, "the engine's registers lie above");

}  // namespace usuzumi::linux_arm64
