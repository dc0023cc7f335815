// Registers of the interrupt controller: one bit per line, bit n for the line `Interrupt` n of hal/clock.h.
//
// A line that rises is latched in PENDING whether it is enabled or not. It leaves PENDING when acknowledged, or by
// itself when the device withdraws it. An acknowledged line that stays high is pending again only after it has fallen
// and risen: a driver that forgets to clear its device's flag waits in vain instead of spinning.
#pragma once

#include <cstdint>

#include "hal/clock.h"
#include "hal/registers/field.h"

namespace usuzumi::registers::interrupt {

inline constexpr std::uint32_t kBlockBytes = 0x1000;

/// 0x00 read-only. Which device this is: "UZIC" in ASCII, first letter in bits 31-24.
inline constexpr std::uint32_t kId = 0x00;
inline constexpr std::uint32_t kIdValue = 0x555A4943;

/// The lines' bits, in LINES, PENDING, ENABLE and ACKNOWLEDGE alike.
inline constexpr std::uint32_t kLineCount = static_cast<std::uint32_t>(Interrupt::kCount);
constexpr RegisterField line(Interrupt interrupt) { return {static_cast<unsigned>(interrupt), 1}; }
inline constexpr RegisterField kAllLines{0, kLineCount};

/// 0x04 read-only. Lines that are high now.
inline constexpr std::uint32_t kLines = 0x04;

/// 0x08 read-only. Lines that rose and were neither acknowledged nor withdrawn.
inline constexpr std::uint32_t kPending = 0x08;

/// 0x0C read-write. Lines that interrupt the CPU: those in both PENDING and ENABLE.
inline constexpr std::uint32_t kEnable = 0x0C;

/// 0x10 write-only. Ones take lines out of PENDING.
inline constexpr std::uint32_t kAcknowledge = 0x10;

}  // namespace usuzumi::registers::interrupt
