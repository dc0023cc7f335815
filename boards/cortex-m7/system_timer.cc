#include "boards/cortex-m7/system_timer.h"

#include "boards/cortex-m7/core_registers.h"

namespace usuzumi::boards::cortex_m7 {
namespace {

constexpr std::uint32_t kPeriod = kTickHz / 1000;  // ticks
constexpr std::uint32_t kPending = 1u << 26;       // ICSR.PENDSTSET

volatile std::uint64_t g_periods = 0;  // read with interrupts off

/// The counter stands at 0 as a period begins, then counts from kPeriod - 1 down; at 0 again its interrupt comes. It
/// reads 0 as well before its first tick.
std::uint32_t ticks_into_period() {
  const std::uint32_t left = core_register(kSystCvr);
  return left == 0 ? 0 : kPeriod - left;
}

}  // namespace

void start_system_timer() {
  core_register(kSystRvr) = kPeriod - 1;
  core_register(kSystCvr) = 0;  // any write clears it
  core_register(kSystCsr) = 7;
}

std::uint64_t system_ticks() {
  asm volatile("cpsid i" ::: "memory");
  std::uint32_t ticks = ticks_into_period();
  std::uint64_t periods = g_periods;
  if ((core_register(kIcsr) & kPending) != 0) {
    // A period has ended that the interrupt has not counted, perhaps after the counter was read.
    ticks = ticks_into_period();
    ++periods;
  }
  asm volatile("cpsie i" ::: "memory");
  return periods * kPeriod + ticks;
}

void sleep_until_interrupt() { asm volatile("wfi" ::: "memory"); }

void system_timer_interrupt() { g_periods = g_periods + 1; }

}  // namespace usuzumi::boards::cortex_m7
