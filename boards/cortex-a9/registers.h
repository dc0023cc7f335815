// A peripheral's registers: the one place where the board's drivers touch hardware.
#pragma once

#include <cstdint>

namespace usuzumi::boards::cortex_a9 {

/// Aligned 32-bit words at `base` plus the data sheet's offsets. A test gives an array's address.
class Registers {
 public:
  explicit constexpr Registers(std::uintptr_t base) : base_(base) {}

  std::uint32_t read(std::uint32_t offset) const { return at(offset); }
  void write(std::uint32_t offset, std::uint32_t value) const { at(offset) = value; }
  constexpr Registers part(std::uint32_t offset) const { return Registers(base_ + offset); }

 private:
  volatile std::uint32_t& at(std::uint32_t offset) const {
    return *reinterpret_cast<volatile std::uint32_t*>(base_ + offset);
  }

  std::uintptr_t base_;
};

}  // namespace usuzumi::boards::cortex_a9
