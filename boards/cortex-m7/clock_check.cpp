// Watches the clock through fifty periods of SysTick: it never falls, loses no period, and goes on in its sleep. Under
// QEMU's -icount alone, else the host's pauses are jumps.
#include <cstdint>
#include <string_view>

#include "boards/bare_metal/semihosting.h"
#include "boards/common/text_line.h"
#include "boards/cortex-m7/system_timer.h"

namespace {

using namespace usuzumi::boards;
using namespace usuzumi::boards::cortex_m7;

constexpr std::uint64_t kPeriod = kTickHz / 1000;

int fail(std::string_view what, std::uint64_t before, std::uint64_t after) {
  semihosting::print(
      TextLine().text("clock ").text(what).text(": ").number(before).text(" then ").number(after).finish());
  return 1;
}

}  // namespace

int main() {
  start_system_timer();
  std::uint64_t before = system_ticks();
  if (before > kPeriod) return fail("does not begin at zero", 0, before);
  while (before < 50 * kPeriod) {
    const std::uint64_t now = system_ticks();
    if (now < before) return fail("falls", before, now);
    if (now - before > kPeriod / 10) return fail("jumps", before, now);  // a look takes some two ticks
    before = now;
  }
  for (std::uint64_t slept = 0; slept < 20; ++slept) {
    sleep_until_interrupt();
    const std::uint64_t now = system_ticks();
    if (now <= before || now - before > kPeriod + kPeriod / 10) return fail("sleeps too long", before, now);
    before = now;
  }
  semihosting::print(TextLine().text("clock ok, ticks=").number(before).finish());
  return 0;
}
