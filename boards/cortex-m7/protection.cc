#include "boards/cortex-m7/protection.h"

#include <cstdint>

#include "boards/cortex-m7/core_registers.h"
#include "boards/cortex-m7/memory_map.h"

namespace usuzumi::boards::cortex_m7 {
namespace {

enum class Access : std::uint32_t { kNone = 0, kReadOnly = 6 };  // RASR.AP

/// 2^size_log2 bytes at a multiple of so many. Where regions overlap the higher number rules.
void set_region(std::uint32_t number, std::uint32_t base, std::uint32_t size_log2, Access access, bool execute) {
  constexpr std::uint32_t kWriteThrough = 1u << 17;  // C: as the default map has code memory
  core_register(kMpuRbar) = base | 1u << 4 | number;
  core_register(kMpuRasr) = (execute ? 0u : 1u << 28) | static_cast<std::uint32_t>(access) << 24 | kWriteThrough |
                            (size_log2 - 1) << 1 | 1u;
}

std::uint32_t address_of(const std::byte* p) { return reinterpret_cast<std::uint32_t>(p); }

}  // namespace

void protect_memory() {
  set_region(0, 0, 22, Access::kReadOnly, true);  // code
  set_region(1, 0, 8, Access::kNone, false);
  set_region(2, address_of(ram().data()) - (1u << 16), 16, Access::kNone, false);
  // The flash is 12 MiB at an odd multiple of 4 MiB: a piece of 4 MiB and one of 8.
  set_region(3, address_of(rom().data()), 22, Access::kReadOnly, false);
  set_region(4, address_of(rom().data()) + (1u << 22), 23, Access::kReadOnly, false);
  core_register(kMpuCtrl) = 1u << 2 | 1u;
  synchronize();
}

}  // namespace usuzumi::boards::cortex_m7
