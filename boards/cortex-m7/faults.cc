#include "boards/cortex-m7/faults.h"

#include <cstdint>

#include "boards/bare_metal/semihosting.h"
#include "boards/bare_metal/trap.h"
#include "boards/common/text_line.h"
#include "boards/cortex-m7/core_registers.h"
#include "boards/cortex-m7/memory_map.h"

extern "C" {
/// The handler's own stack: the other one may be what has failed.
alignas(8) std::uint32_t usuzumi_fault_stack[256];
[[noreturn]] void usuzumi_report_fault(std::uint32_t stack_pointer, std::uint32_t exception);
}

namespace usuzumi::boards::cortex_m7 {
namespace {

constexpr std::uint32_t kStackingFailed = 1u << 4 | 1u << 12;  // CFSR.MSTKERR, CFSR.STKERR
constexpr std::uint32_t kMmarValid = 1u << 7, kBfarValid = 1u << 15;
constexpr std::uint32_t kFrameBytes = 32;  // r0-r3, r12, lr, pc, xPSR

void print_registers(TextLine& line, std::uint32_t cfsr) {
  line.text(" cfsr=0x").hex(cfsr).text(" hfsr=0x").hex(core_register(kHfsr));
  if (cfsr & kMmarValid) line.text(" address=0x").hex(core_register(kMmfar));
  else if (cfsr & kBfarValid) line.text(" address=0x").hex(core_register(kBfar));
}

}  // namespace

/// Leaves the stack it finds, which cannot be trusted. What was pushed on it tells where the fault was.
[[gnu::naked]] void fault_handler() {
  asm volatile(
      "mrs r0, msp\n\t"
      "mrs r1, ipsr\n\t"
      "ldr r2, =usuzumi_fault_stack + 1024\n\t"
      "msr msp, r2\n\t"
      "b usuzumi_report_fault\n\t"
      ".ltorg");
}

}  // namespace usuzumi::boards::cortex_m7

void usuzumi_report_fault(std::uint32_t stack_pointer, std::uint32_t exception) {
  using namespace usuzumi::boards;
  using namespace usuzumi::boards::cortex_m7;
  const std::uint32_t cfsr = core_register(kCfsr);
  const auto bottom = reinterpret_cast<std::uint32_t>(__stack_bottom);
  const auto top = reinterpret_cast<std::uint32_t>(__stack_top);
  TextLine line;
  line.text("fault: exception ").number(exception);
  if ((cfsr & kStackingFailed) != 0 || stack_pointer < bottom || stack_pointer > top - kFrameBytes) {
    line.text(", stack overflow: sp=0x").hex(stack_pointer);
  } else {
    const auto* frame = reinterpret_cast<const std::uint32_t*>(stack_pointer);
    line.text(" at pc=0x").hex(frame[6]).text(" lr=0x").hex(frame[5]);
  }
  print_registers(line, cfsr);
  semihosting::print(line.finish());
  semihosting::exit(kExitTrap);
}
