// A method's arrays, one behind another in one piece of an arena. One function per method lists them: the same list is
// counted and carved, so that the two cannot differ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/arena.h"

namespace usuzumi::firmware {

class ScratchLayout {
 public:
  /// Arrays begin at multiples of `alignment`, a power of two, as `memory` does. Null: they are only counted.
  explicit ScratchLayout(std::size_t alignment, std::byte* memory = nullptr) : alignment_(alignment), memory_(memory) {}

  /// `count` entries behind what there is.
  template <class T>
  void array(std::span<T>& out, std::uint64_t count) {
    place(out, count);
    end_ = (end_ + count * sizeof(T) + alignment_ - 1) & ~(alignment_ - 1);
  }

  /// The same, but whatever comes after lies in the same place: it is used only when this is done with.
  template <class T>
  void array_under_the_rest(std::span<T>& out, std::uint64_t count) {
    place(out, count);
    const std::uint64_t end = end_ + count * sizeof(T);
    least_ = end > least_ ? end : least_;
  }

  /// Counts from ROM may ask for more than a 32-bit device can address: sizes are 64 bits wide until they are compared.
  std::uint64_t bytes() const { return end_ > least_ ? end_ : least_; }

 private:
  template <class T>
  void place(std::span<T>& out, std::uint64_t count) {
    if (memory_ == nullptr) return;
    void* first = memory_ + static_cast<std::size_t>(end_);
    out = {static_cast<T*>(first), static_cast<std::size_t>(count)};
  }

  std::uint64_t alignment_;
  std::byte* memory_;
  std::uint64_t end_ = 0;
  std::uint64_t least_ = 0;  // that arrays under others reach to
};

/// Bytes that carve_layout() takes wherever its arena stands: the first `alignment` are room for that.
template <class LayOut>
std::uint64_t layout_bytes(std::size_t alignment, LayOut lay_out) {
  ScratchLayout layout(alignment);
  lay_out(layout);
  return alignment + layout.bytes();
}

/// Takes what `lay_out(ScratchLayout&)` lists from `arena`. False, and nothing taken, where it does not fit.
template <class LayOut>
bool carve_layout(Arena& arena, std::size_t alignment, LayOut lay_out) {
  const std::uint64_t bytes = layout_bytes(alignment, lay_out) - alignment;
  if (bytes > arena.available()) return false;
  const std::span<std::byte> memory = arena.allocate<std::byte>(static_cast<std::size_t>(bytes), alignment);
  if (memory.data() == nullptr) return false;
  ScratchLayout layout(alignment, memory.data());
  lay_out(layout);
  return true;
}

}  // namespace usuzumi::firmware
