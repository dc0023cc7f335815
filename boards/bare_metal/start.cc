#include "boards/bare_metal/start.h"

#include <cstdint>

#include "boards/bare_metal/semihosting.h"

extern "C" {
extern const std::uint32_t __data_load[];
extern std::uint32_t __data_start[], __data_end[], __bss_start[], __bss_end[];
extern void (*const __init_array_start[])();
extern void (*const __init_array_end[])();
}

int program_main() asm("main");  // by its symbol: ISO C++ lets nobody call main()

namespace usuzumi::boards {

void start_program() {
  const std::uint32_t* source = __data_load;
  if (source != __data_start)
    for (std::uint32_t* word = __data_start; word != __data_end; ++word) *word = *source++;
  for (std::uint32_t* word = __bss_start; word != __bss_end; ++word) *word = 0;
  for (auto constructor = __init_array_start; constructor != __init_array_end; ++constructor) (*constructor)();
  semihosting::exit(program_main());
}

}  // namespace usuzumi::boards
