#include "boards/cortex-a9/faults.h"

#include <cstring>

#include "boards/bare_metal/semihosting.h"
#include "boards/bare_metal/trap.h"
#include "boards/common/text_line.h"
#include "boards/cortex-a9/memory_map.h"
#include "boards/cortex-a9/pl011.h"
#include "boards/cortex-a9/pl061.h"

namespace usuzumi::boards::cortex_a9 {
namespace {

// The drivers' objects may be what is broken; these are new.
Pl011 console() { return Pl011(Registers(kUart0)); }
void darken() { Pl061(Registers(kGpio0)).write(kBacklightLine, false); }

const char* name_of(FaultKind kind) {
  switch (kind) {
    case FaultKind::kUndefinedInstruction: return "undefined instruction";
    case FaultKind::kPrefetchAbort: return "prefetch abort";
    case FaultKind::kDataAbort: return "data abort";
    case FaultKind::kFiq: return "fast interrupt, which nothing here raises";
  }
  return "kind out of range";
}

}  // namespace
}  // namespace usuzumi::boards::cortex_a9

using namespace usuzumi::boards;
using namespace usuzumi::boards::cortex_a9;

void usuzumi_fault(FaultKind kind, std::uint32_t pc) {
  static volatile bool again = false;
  while (again) asm volatile("wfi");  // without a debugger an exit faults too where the program's stack is the trouble
  again = true;
  darken();
  TextLine line;
  line.text("fault: ").text(name_of(kind));
  if (kind == FaultKind::kDataAbort || kind == FaultKind::kPrefetchAbort) {
    std::uint32_t status, address;
    if (kind == FaultKind::kDataAbort) {
      asm volatile("mrc p15, 0, %0, c5, c0, 0" : "=r"(status));   // DFSR
      asm volatile("mrc p15, 0, %0, c6, c0, 0" : "=r"(address));  // DFAR
    } else {
      asm volatile("mrc p15, 0, %0, c5, c0, 1" : "=r"(status));   // IFSR
      asm volatile("mrc p15, 0, %0, c6, c0, 2" : "=r"(address));  // IFAR
    }
    line.text(" at 0x").hex(address).text(", status 0x").hex(status);
  }
  console().print(line.text(", pc 0x").hex(pc).finish());
  semihosting::exit(kExitTrap);
}

std::uint32_t usuzumi_no_debugger(std::uint32_t operation, const void* argument) {
  constexpr std::uint32_t kWrite0 = 0x04, kExitExtended = 0x20, kRefused = 0xFFFFFFFFu;  // IHI 0065
  if (operation == kWrite0) console().print(static_cast<const char*>(argument));
  if (operation == kExitExtended) {
    std::uint32_t block[2];
    std::memcpy(block, argument, sizeof block);
    if (block[1] == static_cast<std::uint32_t>(kExitTrap)) {
      darken();
      for (;;) asm volatile("wfi");  // interrupts are masked: nothing lights the panel again
    }
  }
  return kRefused;
}
