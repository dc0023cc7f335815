// How much of a memory was ever used: it is painted at reset, and what still has the paint was not.
#pragma once

#include <cstddef>
#include <span>

namespace usuzumi::boards::cortex_m7 {

void paint(std::span<std::byte> memory);
/// From the bottom of the stack to a little below where it is now.
void paint_unused_stack();

/// Bytes that have lost their paint, in whole words. A word that was written with the paint's own value counts as not
/// used.
std::size_t touched_bytes(std::span<const std::byte> memory);
/// Most bytes of the stack ever in use: it grows down, so the lowest word without paint tells.
std::size_t deepest_stack_bytes();

}  // namespace usuzumi::boards::cortex_m7
