// Eight pins: Arm PrimeCell GPIO PL061 (DDI 0190).
#pragma once

#include <cstdint>

#include "boards/cortex-a9/registers.h"

namespace usuzumi::boards::cortex_a9 {

/// A set of lines is a mask: bit n is line n.
class Pl061 {
 public:
  explicit constexpr Pl061(Registers registers) : registers_(registers) {}

  /// `outputs` are driven low, the other lines are inputs; both edges of `watched` interrupt and are kept.
  void start(std::uint32_t outputs, std::uint32_t watched);

  std::uint32_t read(std::uint32_t lines) const;
  void write(std::uint32_t lines, bool high);

  /// The interrupt's handler: keeps the edges and takes the request back.
  void on_interrupt();
  /// Lines with an edge since the last take_edges(), seen by the interrupt or not. Interrupts are masked meanwhile.
  std::uint32_t take_edges();
  /// The same lines, left for take_edges().
  std::uint32_t edges() const;

 private:
  Registers registers_;
  std::uint32_t edges_ = 0;
};

}  // namespace usuzumi::boards::cortex_a9
