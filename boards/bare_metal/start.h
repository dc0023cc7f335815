// From reset to main(), as far as it is the same on every board: memory as C++ expects it. What must come before, a
// stack and the floating-point unit, is the board's.
#pragma once

namespace usuzumi::boards {

/// Copies .data from where it is stored, zeroes .bss, runs the constructors of static objects, calls main() and exits
/// with what it returns. The linker script names the areas, each a multiple of 4 bytes at a multiple of 4:
///
///   __data_load                  where .data is stored; at __data_start itself where a loader has put it there
///   __data_start __data_end      where it belongs
///   __bss_start __bss_end
///   __init_array_start __init_array_end
///
/// Nothing of the stack in use may lie in .bss.
[[noreturn]] void start_program();

}  // namespace usuzumi::boards
