// Registers of the interrupt controller: bit n of each is the line of `Interrupt` n in hal/clock.h.
//
// A line that rises is latched in PEND whether enabled or not. It leaves PEND when acknowledged, or by itself when the
// device withdraws it. An acknowledged line that stays high is pending again only after it has fallen and risen: a
// driver that forgets to clear its device's flag waits in vain instead of spinning.
//
//   offset  name   access reset       what
//   0x000   ID     RO     0x43495A55  "UZIC": tells a driver that an interrupt controller is there
//   0x004   LINE   RO     0           lines that are high now
//   0x008   PEND   RO     0           lines that rose and were neither acknowledged nor withdrawn
//   0x00C   EN     RW     0           lines that interrupt the CPU: those in both PEND and EN
//   0x010   ACK    WO     0           ones take lines out of PEND; reads zero
#pragma once

#include <cstdint>

#include "hal/clock.h"
#include "hal/registers/field.h"

namespace usuzumi::interrupt_registers {

inline constexpr std::uint32_t kBlockSize = 0x014;  // bytes of address space

constexpr std::uint32_t line_bit(Interrupt interrupt) { return 1u << static_cast<unsigned>(interrupt); }
inline constexpr std::uint32_t kAllLines = (1u << static_cast<unsigned>(Interrupt::kCount)) - 1;

struct Id {
  static constexpr std::uint32_t kOffset = 0x000, kReset = 0x43495A55;
};
struct Line {
  static constexpr std::uint32_t kOffset = 0x004;
};
struct Pend {
  static constexpr std::uint32_t kOffset = 0x008;
};
struct En {
  static constexpr std::uint32_t kOffset = 0x00C;
};
struct Ack {
  static constexpr std::uint32_t kOffset = 0x010;
};

}  // namespace usuzumi::interrupt_registers
