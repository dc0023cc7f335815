// The end of a run that the processor has stopped.
#pragma once

#include <cstdint>

namespace usuzumi::boards::cortex_a9 {

/// Numbers that startup.cc passes.
enum class FaultKind : std::uint32_t { kUndefinedInstruction, kPrefetchAbort, kDataAbort, kFiq };

}  // namespace usuzumi::boards::cortex_a9

/// From the vectors, on a stack of its own: backlight off, one line on the console, such as
/// "fault: data abort at 0x00000010, status 0x00000005, pc 0x00101234", exit with kExitTrap.
extern "C" [[noreturn]] void usuzumi_fault(usuzumi::boards::cortex_a9::FaultKind kind, std::uint32_t pc);

/// From the vectors, for a semihosting call that no debugger has served: its text goes to the console, what it asks for
/// is refused, and at a trap's exit the light goes off and the processor stands.
extern "C" std::uint32_t usuzumi_no_debugger(std::uint32_t operation, const void* argument);
