// Processor faults: a line on the console, then exit code 70.
#pragma once

namespace usuzumi::boards::cortex_m7 {

/// Handler of every exception that nobody expects:
///
///   fault: exception 4 at pc=0x00001234 lr=0x00001235 cfsr=0x00000082 hfsr=0x00000000 address=0x00000000
///
/// addr2line -e PROGRAM PC tells the place in the source. A stack that has overflowed is called so.
void fault_handler();

}  // namespace usuzumi::boards::cortex_m7
