// Arm semihosting: console, exit code and command line of a program without an operating system, served by QEMU or by a
// debugger (Arm IHI 0065, "Semihosting for AArch32 and AArch64"). Without either of them a call is a fault.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace usuzumi::boards::semihosting {

/// The text to the host's console. Needs no memory but the stack's, so that a fault handler may call it.
void print(std::string_view text);

/// Ends the program; the host's process exits with `code`.
[[noreturn]] void exit(int code);

/// What the host was given for the program, the program's own name first; kept in `buffer`. Empty where the host has
/// nothing, or more than fits.
std::string_view command_line(std::span<char> buffer);

}  // namespace usuzumi::boards::semihosting
