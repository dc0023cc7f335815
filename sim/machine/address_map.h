// Where everything lies on the machine's bus, and how fast its master clock runs. README.md shows it as a table.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/bus.h"

namespace usuzumi::sim {

inline constexpr BusAddress kRomBase = 0x10000000;
inline constexpr BusAddress kRamBase = 0x50000000;
inline constexpr BusAddress kVramBase = 0x80000000;
inline constexpr BusAddress kEngineBase = 0xF0000000;
inline constexpr BusAddress kDisplayBase = 0xF0001000;
inline constexpr BusAddress kInterruptBase = 0xF0002000;
inline constexpr BusAddress kRegisterBlockBytes = 0x1000;

inline constexpr std::size_t kRomBytesMax = kRamBase - kRomBase;       // 1 GiB
inline constexpr std::size_t kRamBytesMax = kVramBase - kRamBase;      // 768 MiB
inline constexpr std::size_t kVramBytesMax = kEngineBase - kVramBase;  // 1792 MiB

/// The unit of virtual time is one cycle of this clock: 2.5 ns.
inline constexpr std::uint64_t kMasterHz = 400'000'000;

/// Rounded down; no overflow before 2^64 ns (584 years).
constexpr std::uint64_t ns_from_cycles(std::uint64_t cycles) { return cycles / 2 * 5 + cycles % 2 * 5 / 2; }
constexpr std::uint64_t cycles_from_us(std::uint64_t us) { return us * (kMasterHz / 1'000'000); }

}  // namespace usuzumi::sim
