// Time from SysTick, extended to 64 bits.
#pragma once

#include <cstdint>

namespace usuzumi::boards::cortex_m7 {

/// Of SysTick on this board. Under QEMU's -icount shift=0 an instruction takes one nanosecond.
inline constexpr std::uint32_t kTickHz = 25'000'000;
inline constexpr std::uint32_t kTickNs = 1'000'000'000 / kTickHz;

/// Counts from zero, with an interrupt each millisecond.
void start_system_timer();

/// Ticks since then; never falls. For the main program only, not for interrupt handlers.
std::uint64_t system_ticks();

/// Sleeps until the next interrupt: a millisecond at most.
void sleep_until_interrupt();

/// For the vector table.
void system_timer_interrupt();

}  // namespace usuzumi::boards::cortex_m7
