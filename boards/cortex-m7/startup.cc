// From reset to start_program(): stack, floating point, vectors, protection.
#include <cstdint>

#include "boards/bare_metal/start.h"
#include "boards/cortex-m7/core_registers.h"
#include "boards/cortex-m7/faults.h"
#include "boards/cortex-m7/high_water.h"
#include "boards/cortex-m7/memory_map.h"
#include "boards/cortex-m7/protection.h"
#include "boards/cortex-m7/system_timer.h"

extern "C" [[noreturn]] void reset_handler();

namespace usuzumi::boards::cortex_m7 {
namespace {

using Handler = void (*)();

/// ARMv7-M's table: the first stack pointer, then exceptions 1 to 15. No interrupt of the part is used.
struct VectorTable {
  std::byte* stack_top;
  Handler exception[15];
};

extern const VectorTable kVectors;
[[gnu::section(".vectors"), gnu::used]] const VectorTable kVectors{
    __stack_top,
    {reset_handler, fault_handler, fault_handler, fault_handler, fault_handler, fault_handler, fault_handler,
     fault_handler, fault_handler, fault_handler, fault_handler, fault_handler, fault_handler, fault_handler,
     system_timer_interrupt}};

}  // namespace
}  // namespace usuzumi::boards::cortex_m7

void reset_handler() {
  using namespace usuzumi::boards::cortex_m7;
  core_register(kVtor) = reinterpret_cast<std::uint32_t>(&kVectors);
  core_register(kCpacr) = core_register(kCpacr) | 0xFu << 20;  // full access, before the first float
  core_register(kShcsr) = core_register(kShcsr) | 7u << 16;    // faults of their own, not all as hard faults
  core_register(kCcr) = core_register(kCcr) | 1u << 4;
  synchronize();
  protect_memory();
  paint_unused_stack();
  paint(engine_memory());
  paint(firmware_memory());
  usuzumi::boards::start_program();
}
