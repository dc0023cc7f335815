// What a board's traps.cpp does that a program must not, with numbers that the compiler does not know.
#pragma once

#include <cstdint>

namespace usuzumi::boards::deeds {

inline volatile std::uint32_t g_zero = 0;    // unknown to the compiler
inline volatile std::uint32_t g_result = 0;  // used, for all it knows
inline void* volatile g_pointer = nullptr;

inline volatile std::uint32_t* pointer_to(std::uintptr_t address) {
  return reinterpret_cast<volatile std::uint32_t*>(address + g_zero);
}

/// Begun with g_zero it needs more stack than there is.
[[gnu::noinline]] inline std::uint32_t endless(std::uint32_t depth) {
  if (depth == g_zero - 1) return depth;  // four thousand million calls from here
  volatile std::uint32_t frame[64] = {};
  frame[depth % 64] = depth;
  return endless(depth + 1) + frame[(depth + 1) % 64];
}

}  // namespace usuzumi::boards::deeds
