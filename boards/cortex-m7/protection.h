// What the memory protection unit forbids, so that a stray pointer faults where it strays.
#pragma once

namespace usuzumi::boards::cortex_m7 {

/// No access to the first 256 bytes (null pointers), nor to the 64 KiB below RAM, into which the stack would overflow;
/// no writing to code, nor to the flash of the drawing data.
void protect_memory();

}  // namespace usuzumi::boards::cortex_m7
