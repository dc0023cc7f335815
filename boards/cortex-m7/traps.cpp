// Does on demand what a program must not do, so that a test can see it caught: the command line names the deed.
#include <array>
#include <cassert>
#include <cstdint>
#include <new>
#include <string_view>

#include "boards/bare_metal/deeds.h"
#include "boards/bare_metal/semihosting.h"
#include "boards/cortex-m7/memory_map.h"

// Not hidden in this file: the compiler would see that no class but Derived is there to call.
namespace usuzumi::boards::deeds {

/// Calls what no class has written yet.
struct Base {
  Base() { call(*this); }
  [[gnu::noipa]] static void call(Base& base) { base.pure(); }
  virtual void pure() = 0;

 protected:
  ~Base() = default;
};
struct Derived final : Base {
  void pure() override {}
};

}  // namespace usuzumi::boards::deeds

namespace {

using namespace usuzumi::boards;
using namespace usuzumi::boards::deeds;

bool commit(std::string_view deed) {
  if (deed == "read-null") g_result = *pointer_to(0);
  else if (deed == "write-code") *pointer_to(0x400) = 1;
  else if (deed == "write-rom") *pointer_to(reinterpret_cast<std::uintptr_t>(__rom_start)) = 1;
  else if (deed == "leave-memory") *pointer_to(0x50000000) = 1;
  else if (deed == "divide-by-zero") g_result = (g_zero + 100) / g_zero;
  else if (deed == "overflow-stack") g_result = endless(g_zero);
  else if (deed == "new") g_pointer = ::operator new(g_zero + 4);
  else if (deed == "assert") assert(g_zero == 1);
  else if (deed == "index") g_result = std::array{1u, 2u, 3u}.at(g_zero + 3);
  else if (deed == "pure-virtual") Derived{};
  else return false;
  return true;
}

}  // namespace

int main() {
  char buffer[256];
  std::string_view deed = semihosting::command_line(buffer);
  deed.remove_prefix(deed.rfind(' ') + 1);
  semihosting::print(commit(deed) ? "nothing has stopped it\n" : "no such deed\n");
  return 0;
}
