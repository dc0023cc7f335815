// Memory as the processor may use it: a flat translation table of 1 MiB sections, and the caches.
#pragma once

namespace usuzumi::boards::cortex_a9 {

/// Before anything but the stacks is used; once. Needs no .data and no .bss.
///
///   what                  attributes                        why
///   0 to 1 MiB            no access                         null pointers and a stack that overflows fault
///   program, RAM          normal, write-back                the processor draws: without a cache it crawls
///   VRAM                  normal, not cached                the display fetches past the caches; stores are gathered
///   ROM                   normal, write-back, read-only     flash
///   devices               device, never executed            each access once and in order
///   all else              no access
///
/// The level-2 cache stays off: its controller is another on every part.
void enable_memory();

}  // namespace usuzumi::boards::cortex_a9
