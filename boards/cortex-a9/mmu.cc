#include "boards/cortex-a9/mmu.h"

#include <cstdint>

#include "boards/cortex-a9/memory_map.h"

extern "C" {
extern std::byte __program_start[], __program_end[];
extern std::uint32_t __translation_table[];  // 4096 words at a multiple of 16 KiB
}

namespace usuzumi::boards::cortex_a9 {
namespace {

constexpr std::uint32_t kSectionBits = 20, kSections = 4096;

// Arm DDI 0406, section B3.5: short-descriptor sections, in domain 0, whose accesses are checked. TEX is bits 14:12,
// C bit 3, B bit 2; AP[2] is bit 15, AP[1:0] bits 11:10.
constexpr std::uint32_t kSection = 2, kNeverExecute = 1u << 4;
constexpr std::uint32_t kReadWrite = 3u << 10, kReadOnly = 1u << 15 | 3u << 10;
constexpr std::uint32_t kWriteBack = 1u << 12 | 1u << 3 | 1u << 2;  // and allocated by reads and writes
constexpr std::uint32_t kNotCached = 1u << 12;
constexpr std::uint32_t kDevice = 1u << 2;

constexpr std::uint32_t kProgram = kSection | kReadWrite | kWriteBack;  // code and data share sections
constexpr std::uint32_t kData = kProgram | kNeverExecute;
constexpr std::uint32_t kVideo = kSection | kReadWrite | kNotCached | kNeverExecute;
constexpr std::uint32_t kFlash = kSection | kReadOnly | kWriteBack | kNeverExecute;
constexpr std::uint32_t kPeripheral = kSection | kReadWrite | kDevice | kNeverExecute;

/// `end` is one past the last byte.
void map(std::uintptr_t start, std::uintptr_t end, std::uint32_t attributes) {
  for (std::uint32_t section = start >> kSectionBits; section <= (end - 1) >> kSectionBits; ++section)
    __translation_table[section] = section << kSectionBits | attributes;
}

void map(const std::byte* start, const std::byte* end, std::uint32_t attributes) {
  map(reinterpret_cast<std::uintptr_t>(start), reinterpret_cast<std::uintptr_t>(end), attributes);
}

/// The level-1 data cache holds anything after reset; all its lines are made invalid, set by set (DDI 0406, B2.2.7).
void invalidate_data_cache() {
  std::uint32_t geometry;
  asm volatile("mcr p15, 2, %0, c0, c0, 0\n\tisb" ::"r"(0));   // CSSELR: level 1, data
  asm volatile("mrc p15, 1, %0, c0, c0, 0" : "=r"(geometry));  // CCSIDR
  const std::uint32_t line_bits = (geometry & 7) + 4, ways = (geometry >> 3 & 0x3FF) + 1;
  const std::uint32_t sets = (geometry >> 13 & 0x7FFF) + 1;
  const auto way_shift = ways > 1 ? static_cast<std::uint32_t>(__builtin_clz(ways - 1)) : 0;
  for (std::uint32_t way = 0; way < ways; ++way)
    for (std::uint32_t set = 0; set < sets; ++set)
      asm volatile("mcr p15, 0, %0, c7, c6, 2" ::"r"(way << way_shift | set << line_bits));  // DCISW
}

}  // namespace

void enable_memory() {
  for (std::uint32_t section = 0; section < kSections; ++section) __translation_table[section] = 0;
  map(__program_start, __program_end, kProgram);
  map(__ram_start, __ram_end, kData);
  map(__vram_start, __vram_end, kVideo);
  map(__rom_start, __rom_end, kFlash);
  map(kUart0, kLcd + 1, kPeripheral);
  map(kGicInterface, kGicDistributor + 1, kPeripheral);

  invalidate_data_cache();
  const std::uint32_t zero = 0;
  asm volatile("mcr p15, 0, %0, c7, c5, 0" ::"r"(zero));                 // ICIALLU: instruction cache
  asm volatile("mcr p15, 0, %0, c7, c5, 6" ::"r"(zero));                 // BPIALL: branch predictor
  asm volatile("mcr p15, 0, %0, c8, c7, 0" ::"r"(zero));                 // TLBIALL
  asm volatile("mcr p15, 0, %0, c2, c0, 2" ::"r"(zero));                 // TTBCR: one table
  asm volatile("mcr p15, 0, %0, c2, c0, 0" ::"r"(__translation_table));  // TTBR0
  asm volatile("mcr p15, 0, %0, c3, c0, 0" ::"r"(1));                    // DACR: domain 0 is checked
  asm volatile("dsb\n\tisb" ::: "memory");
  std::uint32_t control;  // SCTLR
  asm volatile("mrc p15, 0, %0, c1, c0, 0" : "=r"(control));
  // MMU, alignment check, data cache, branch prediction, instruction cache.
  control |= 1u << 0 | 1u << 1 | 1u << 2 | 1u << 11 | 1u << 12;
  asm volatile("mcr p15, 0, %0, c1, c0, 0\n\tisb" ::"r"(control) : "memory");
}

}  // namespace usuzumi::boards::cortex_a9
