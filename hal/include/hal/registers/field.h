// Bits of a 32-bit device register, shared by the driver that writes them and the model that reads them.
#pragma once

#include <cstdint>

namespace usuzumi {

/// Bits lsb .. lsb + width - 1; width 1..32.
struct RegisterField {
  unsigned lsb = 0;
  unsigned width = 32;

  /// Largest value the field holds.
  constexpr std::uint32_t max() const { return width >= 32 ? 0xFFFFFFFFu : (1u << width) - 1; }
  /// The field's bits in the register.
  constexpr std::uint32_t mask() const { return max() << lsb; }
  constexpr std::uint32_t get(std::uint32_t word) const { return (word >> lsb) & max(); }
  /// The field read as two's complement.
  constexpr std::int32_t get_signed(std::uint32_t word) const {
    return static_cast<std::int32_t>(word << (32 - lsb - width)) >> (32 - width);
  }
  /// `value` in the field's place, other bits zero; bits that do not fit are cut off.
  constexpr std::uint32_t put(std::uint32_t value) const { return (value & max()) << lsb; }
  constexpr std::uint32_t put_signed(std::int32_t value) const { return put(static_cast<std::uint32_t>(value)); }
  /// `word` with the field replaced.
  constexpr std::uint32_t replace(std::uint32_t word, std::uint32_t value) const {
    return (word & ~mask()) | put(value);
  }
};

}  // namespace usuzumi
