#include "boards/common/engine_registers.h"

namespace usuzumi::boards {

void EngineRegisters::do_write32(BusAddress address, std::uint32_t value) {
  device_.write(address - kBase, value);
  if (device_.busy()) device_.advance_to(device_.next_event());
}

Status EngineRegisters::do_wait(Interrupt interrupt, std::uint32_t timeout_us) {
  if (interrupt == Interrupt::kEngineDone && device_.interrupt_asserted()) return ok_status();
  return {StatusCode::kDeadlineExceeded, "no list is being drawn; waited, in microseconds", timeout_us};
}

}  // namespace usuzumi::boards
