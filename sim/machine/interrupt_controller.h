// The interrupt controller behind its registers (hal/registers/interrupt.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "gfx_subsystem/register_file.h"
#include "hal/clock.h"
#include "hal/registers/interrupt.h"

namespace usuzumi::sim {

class InterruptController {
 public:
  /// `log` may be null; it outlives the controller.
  explicit InterruptController(gfx::RegisterLog* log = nullptr);

  std::uint32_t read(std::uint32_t offset) { return registers_.read(*this, offset); }
  void write(std::uint32_t offset, std::uint32_t value) { registers_.write(*this, offset, value); }

  /// The level of a device's line. A rise is latched, a fall withdraws it.
  void set_line(Interrupt interrupt, bool high);
  /// In both PEND and EN.
  bool interrupts_cpu(Interrupt interrupt) const;

  static constexpr std::size_t kRegisterCount = 5;
  const gfx::RegisterFile<InterruptController, kRegisterCount>& registers() const { return registers_; }

 private:
  static const gfx::RegisterFile<InterruptController, kRegisterCount>::Table kTable;

  void on_acknowledge(std::uint32_t written, std::uint32_t before);

  gfx::RegisterFile<InterruptController, kRegisterCount> registers_;
};

}  // namespace usuzumi::sim
