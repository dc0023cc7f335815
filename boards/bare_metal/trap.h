// The end of a program that has found a mistake of its own.
#pragma once

#include <cstdint>

namespace usuzumi::boards {

/// The exit code of a trap and of a processor fault. Not one of those that run() returns.
inline constexpr int kExitTrap = 70;

/// "trap: WHAT, called from 0xADDRESS" on the console, then exit with kExitTrap. addr2line -e PROGRAM ADDRESS tells
/// the place in the source.
[[noreturn]] void trap(const char* what, const void* caller);
[[noreturn]] void trap(const char* what, std::uintptr_t caller);

}  // namespace usuzumi::boards
