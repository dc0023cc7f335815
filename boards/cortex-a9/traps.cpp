// Does on demand what a program must not do, so that a test can see it caught: the command line names the deed. One
// deed must not be caught: floats are computed while interrupts spoil their registers.
#include <cstdint>
#include <new>
#include <string_view>

#include "boards/bare_metal/deeds.h"
#include "boards/bare_metal/semihosting.h"
#include "boards/cortex-a9/cortex_a9_board.h"
#include "boards/cortex-a9/gic.h"
#include "boards/cortex-a9/memory_map.h"
#include "boards/cortex-a9/sp804.h"

namespace {

using namespace usuzumi::boards;
using namespace usuzumi::boards::cortex_a9;
using namespace usuzumi::boards::deeds;

/// What interrupts while floats are computed, and leaves none of the registers that a function may change as it was.
void clobber_floats(void* timers) {
  static_cast<Sp804*>(timers)->on_interrupt();
  static_cast<Sp804*>(timers)->set_alarm(50);
  asm volatile(
      "vmov.i32 q0, #7\n\tvmov q1, q0\n\tvmov q2, q0\n\tvmov q3, q0\n\tvmov q8, q0\n\tvmov q9, q0\n\tvmov q10, q0\n\t"
      "vmov q11, q0\n\tvmov q12, q0\n\tvmov q13, q0\n\tvmov q14, q0\n\tvmov q15, q0" ::
          : "q0", "q1", "q2", "q3", "q8", "q9", "q10", "q11", "q12", "q13", "q14", "q15");
}

/// Singles live in d0 to d7 here, doubles in d16 to d31.
[[gnu::noinline]] double many_floats() {
  float a = 1.0f + static_cast<float>(g_zero), b = a + 0.5f, c = a + 0.25f, d = a + 0.125f;
  double e = a, f = b, g = c, h = d;
  for (std::uint32_t i = 0; i < 200'000; ++i) {
    a = a * 0.75f + b, b = b * 0.5f + c, c = c * 0.25f + d, d = d * 0.125f + 1.0f;
    e = e * 0.75 + f, f = f * 0.5 + g, g = g * 0.25 + h, h = h * 0.125 + 1.0;
  }
  return static_cast<double>(a + b + c + d) + e + f + g + h;
}

bool interrupts_keep_floats() {
  const double undisturbed = many_floats();
  static Sp804 timers{Registers(kTimers01)};
  connect_interrupt(kTimers01Interrupt, {clobber_floats, &timers});
  timers.set_alarm(50);
  return many_floats() == undisturbed;
}

bool commit(std::string_view deed) {
  if (deed == "read-null") g_result = *pointer_to(0);
  else if (deed == "write-rom") *pointer_to(reinterpret_cast<std::uintptr_t>(__rom_start)) = 1;
  else if (deed == "leave-memory") *pointer_to(0x50000000) = 1;
  else if (deed == "misalign") g_result = *pointer_to(reinterpret_cast<std::uintptr_t>(__ram_start) + 2);
  else if (deed == "run-data") reinterpret_cast<void (*)()>(reinterpret_cast<std::uintptr_t>(__ram_start) + g_zero)();
  else if (deed == "undefined") asm volatile("udf #0");
  else if (deed == "overflow-stack") g_result = endless(g_zero);
  else if (deed == "new") g_pointer = ::operator new(g_zero + 4);
  else return false;
  return true;
}

}  // namespace

int main() {
  static CortexA9Board board;
  board.start();
  board.set_backlight(true);
  char buffer[256];
  std::string_view deed = semihosting::command_line(buffer);
  deed.remove_prefix(deed.rfind(' ') + 1);
  if (deed.empty()) deed = "new";  // without a debugger there is no command line
  if (deed == "keep-floats") board.print(interrupts_keep_floats() ? "floats are kept\n" : "floats are spoilt\n");
  else board.print(commit(deed) ? "nothing has stopped it\n" : "no such deed\n");
  return 0;
}
