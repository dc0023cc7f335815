#include "boards/cortex-m7/high_water.h"

#include <cstdint>

#include "boards/cortex-m7/memory_map.h"

namespace usuzumi::boards::cortex_m7 {
namespace {

constexpr std::uint32_t kPaint = 0xC5C5C5C5;

/// Painted at reset and looked at for good, behind the compiler's back.
volatile std::uint32_t* word_at(const std::byte* p) {
  return reinterpret_cast<volatile std::uint32_t*>(reinterpret_cast<std::uintptr_t>(p));
}

}  // namespace

void paint(std::span<std::byte> memory) {
  for (std::size_t i = 0; i + 4 <= memory.size(); i += 4) *word_at(memory.data() + i) = kPaint;
}

void paint_unused_stack() {
  constexpr std::size_t kInUse = 256;  // below the caller's frame: this function's own, and its callees'
  const auto now = static_cast<std::byte*>(__builtin_frame_address(0));
  paint({__stack_bottom, now - kInUse});
}

std::size_t touched_bytes(std::span<const std::byte> memory) {
  std::size_t touched = 0;
  for (std::size_t i = 0; i + 4 <= memory.size(); i += 4)
    if (*word_at(memory.data() + i) != kPaint) touched += 4;
  return touched;
}

std::size_t deepest_stack_bytes() {
  const std::span<std::byte> stack = stack_memory();
  std::size_t unused = 0;
  while (unused < stack.size() && *word_at(stack.data() + unused) == kPaint) unused += 4;
  return stack.size() - unused;
}

}  // namespace usuzumi::boards::cortex_m7
