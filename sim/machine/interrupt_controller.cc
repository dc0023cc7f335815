#include "sim/machine/interrupt_controller.h"

namespace usuzumi::sim {

namespace reg = interrupt_registers;

constexpr gfx::RegisterFile<InterruptController, InterruptController::kRegisterCount>::Table
    InterruptController::kTable{{
        {.name = "ID", .offset = reg::Id::kOffset, .reset = reg::Id::kReset, .read_only = 0xFFFFFFFFu},
        {.name = "LINE", .offset = reg::Line::kOffset, .read_only = reg::kAllLines},
        {.name = "PEND", .offset = reg::Pend::kOffset, .read_only = reg::kAllLines},
        {.name = "EN", .offset = reg::En::kOffset, .writable = reg::kAllLines},
        {.name = "ACK",
         .offset = reg::Ack::kOffset,
         .strobe = reg::kAllLines,
         .on_write = &InterruptController::on_acknowledge},
    }};

InterruptController::InterruptController(gfx::RegisterLog* log) : registers_(kTable, log) {
  static_assert(gfx::is_well_formed(kTable));
}

void InterruptController::set_line(Interrupt interrupt, bool high) {
  const std::uint32_t bit = reg::line_bit(interrupt);
  const std::uint32_t lines = registers_.value(reg::Line::kOffset);
  const std::uint32_t pending = registers_.value(reg::Pend::kOffset);
  const bool was_high = (lines & bit) != 0;
  if (high == was_high) return;
  registers_.set_value(reg::Line::kOffset, high ? lines | bit : lines & ~bit);
  registers_.set_value(reg::Pend::kOffset, high ? pending | bit : pending & ~bit);
}

bool InterruptController::interrupts_cpu(Interrupt interrupt) const {
  return (registers_.value(reg::Pend::kOffset) & registers_.value(reg::En::kOffset) & reg::line_bit(interrupt)) != 0;
}

void InterruptController::on_acknowledge(std::uint32_t written, std::uint32_t) {
  registers_.set_value(reg::Pend::kOffset, registers_.value(reg::Pend::kOffset) & ~written);
}

}  // namespace usuzumi::sim
