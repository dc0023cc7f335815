#include "sim/machine/machine.h"

#include <algorithm>

#include "hal/registers/interrupt.h"
#include "sim/machine/cost_model.h"

namespace usuzumi::sim {
namespace {

std::uint64_t display_bus(const BoardDescription& board, const Faults& faults) {
  const double bus = static_cast<double>(board.bus_bytes_per_second) / std::max(1.0, faults.bus_slowdown);
  return static_cast<std::uint64_t>(bus);
}

gfx::DisplayConfig display_config(const BoardDescription& board, const Faults& faults) {
  return {.reference_hz = kMasterHz,
          .bus_bytes_per_second = display_bus(board, faults),
          .fifo_bytes = board.display_fifo_bytes};
}

}  // namespace

Machine::Machine(const BoardDescription& board, std::span<const std::byte> rom, gfx::Engine& engine,
                 gfx::VideoSink& video, const Faults& faults)
    : MemoryMap(rom, board.ram_bytes, board.vram_bytes),
      board_(board),
      engine_(engine, *this, {.time_hz = kMasterHz, .engine_hz = board.engine_hz, .hangs = faults.engine_hangs},
              &engine_log_),
      display_(*this, video, display_config(board, faults), &display_log_),
      interrupts_(&interrupt_log_) {
  poll_devices();
}

void Machine::inject(const Faults& faults) {
  engine_.inject_hang(faults.engine_hangs);
  display_.set_bus(display_bus(board_, faults));
}

void Machine::poll_devices() {
  interrupts_.set_line(Interrupt::kEngineDone, engine_.interrupt_asserted());
  interrupts_.set_line(Interrupt::kVerticalBlank, display_.vertical_blank_asserted());
  interrupts_.set_line(Interrupt::kDisplayFault, display_.fault_asserted());
  next_event_ = std::min(engine_.next_event(), display_.next_event());
}

void Machine::advance_to(std::uint64_t now) {
  now_ = now;
  if (now_ < next_event_) return;
  engine_.advance_to(now_);
  display_.advance_to(now_);
  poll_devices();
}

void Machine::spend_cpu_clocks(std::uint64_t clocks) {
  // Whole seconds apart, so that the product stays below 2^64 for CPU clocks up to 40 GHz.
  const std::uint64_t seconds = clocks / board_.cpu_hz;
  const std::uint64_t scaled = clocks % board_.cpu_hz * kMasterHz + cpu_remainder_;
  cpu_remainder_ = scaled % board_.cpu_hz;
  advance_to(now_ + seconds * kMasterHz + scaled / board_.cpu_hz);
}

std::uint64_t Machine::do_now_ns() {
  spend_cpu_clocks(kRegisterAccessClocks);
  return ns_from_cycles(now_);
}

void Machine::do_charge(CpuWork work, std::uint64_t count) { spend_cpu_clocks(cpu_clocks(work) * count); }

std::uint32_t Machine::do_read32(BusAddress address) {
  spend_cpu_clocks(kRegisterAccessClocks);
  const BusAddress offset = address % kRegisterBlockBytes;
  switch (address - offset) {
    case kEngineBase: return engine_.read(offset);
    case kDisplayBase: return display_.read(offset);
    case kInterruptBase: return interrupts_.read(offset);
    default: break;
  }
  guest_log_.unmapped(address, false, 0);
  return 0;
}

void Machine::do_write32(BusAddress address, std::uint32_t value) {
  spend_cpu_clocks(kRegisterAccessClocks);
  // The devices stand at their last event; a write takes effect now.
  engine_.advance_to(now_);
  display_.advance_to(now_);
  const BusAddress offset = address % kRegisterBlockBytes;
  switch (address - offset) {
    case kEngineBase: engine_.write(offset, value); break;
    case kDisplayBase: display_.write(offset, value); break;
    case kInterruptBase: interrupts_.write(offset, value); break;
    default: guest_log_.unmapped(address, true, value); break;
  }
  poll_devices();
}

Status Machine::do_wait(Interrupt interrupt, std::uint32_t timeout_us) {
  const std::uint32_t line = interrupt_registers::line_bit(interrupt);
  const std::uint64_t deadline = now_ + cycles_from_us(timeout_us);
  interrupts_.write(interrupt_registers::En::kOffset, interrupts_.read(interrupt_registers::En::kOffset) | line);
  // The CPU sleeps; time goes from event to event. An event at the deadline is still in time.
  while (!interrupts_.interrupts_cpu(interrupt)) {
    if (now_ >= deadline)
      return {StatusCode::kDeadlineExceeded, "no interrupt within this many microseconds", timeout_us};
    advance_to(std::min(deadline, std::max(next_event_, now_ + 1)));
  }
  interrupts_.write(interrupt_registers::Ack::kOffset, line);
  return ok_status();
}

}  // namespace usuzumi::sim
