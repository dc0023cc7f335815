// Does on demand what a program must not do, so that a test can see it caught: the command line names the deed.
#include <cstdint>
#include <new>
#include <string_view>

#include "boards/bare_metal/semihosting.h"
#include "boards/cortex-a9/cortex_a9_board.h"
#include "boards/cortex-a9/memory_map.h"

namespace {

using namespace usuzumi::boards;
using namespace usuzumi::boards::cortex_a9;

volatile std::uint32_t g_zero = 0;  // unknown to the compiler
volatile std::uint32_t g_result = 0;
void* volatile g_pointer = nullptr;

volatile std::uint32_t* pointer_to(std::uintptr_t address) {
  return reinterpret_cast<volatile std::uint32_t*>(address + g_zero);
}

[[gnu::noinline]] std::uint32_t endless(std::uint32_t depth) {
  if (depth == g_zero - 1) return depth;  // four thousand million calls from here
  volatile std::uint32_t frame[64] = {};
  frame[depth % 64] = depth;
  return endless(depth + 1) + frame[(depth + 1) % 64];
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
  board.print(commit(deed) ? "nothing has stopped it\n" : "no such deed\n");
  return 0;
}
