#include "boards/cortex-a9/gic.h"

#include <array>

#include "boards/cortex-a9/memory_map.h"
#include "boards/cortex-a9/registers.h"

namespace usuzumi::boards::cortex_a9 {
namespace {

// IHI 0048, chapter 4: the distributor, shared, and the interface of this processor.
constexpr Registers kDistributor(kGicDistributor), kInterface(kGicInterface);
constexpr std::uint32_t kGicdCtlr = 0x000, kGicdIsEnabler = 0x100, kGicdIPriority = 0x400, kGicdITargets = 0x800;
constexpr std::uint32_t kGiccCtlr = 0x00, kGiccPmr = 0x04, kGiccIar = 0x0C, kGiccEoir = 0x10;
constexpr std::uint32_t kIdMask = 0x3FF;
constexpr std::uint32_t kThisProcessor = 1, kMiddlePriority = 0x80, kLowestPriority = 0xFF;

constexpr std::uint32_t kIds = 64;  // the board's devices are below
std::array<InterruptHandler, kIds> handlers;

/// One byte of a register that holds four interrupts.
void write_byte(std::uint32_t registers, std::uint32_t id, std::uint32_t value) {
  const std::uint32_t offset = registers + id / 4 * 4, shift = id % 4 * 8;
  kDistributor.write(offset, (kDistributor.read(offset) & ~(0xFFu << shift)) | value << shift);
}

}  // namespace

void start_interrupts() {
  kInterface.write(kGiccPmr, kLowestPriority);
  kInterface.write(kGiccCtlr, 1);
  kDistributor.write(kGicdCtlr, 1);
}

void connect_interrupt(std::uint32_t id, InterruptHandler handler) {
  handlers[id] = handler;
  write_byte(kGicdIPriority, id, kMiddlePriority);
  write_byte(kGicdITargets, id, kThisProcessor);
  kDistributor.write(kGicdIsEnabler + id / 32 * 4, 1u << id % 32);
}

}  // namespace usuzumi::boards::cortex_a9

/// From the vectors, in IRQ mode, with all that the compiler may change saved.
extern "C" void usuzumi_interrupt() {
  using namespace usuzumi::boards::cortex_a9;
  const std::uint32_t acknowledged = kInterface.read(kGiccIar);
  const std::uint32_t id = acknowledged & kIdMask;
  if (id >= kIds) return;  // 1023: it was taken back before it was served
  if (handlers[id].function != nullptr) handlers[id].function(handlers[id].context);
  kInterface.write(kGiccEoir, acknowledged);
}
