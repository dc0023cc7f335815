// The memories of link.ld, in C++.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

// Addresses, no objects: what the linker script says.
extern "C" {
extern std::byte __stack_bottom[], __stack_top[];
extern std::byte __engine_start[], __engine_end[];
extern std::byte __firmware_start[], __firmware_end[];
extern std::byte __ram_start[], __ram_end[];
extern std::byte __vram_start[], __vram_end[];
extern std::byte __rom_start[], __rom_end[];
}

namespace usuzumi::boards::cortex_m7 {

inline std::span<std::byte> stack_memory() { return {__stack_bottom, __stack_top}; }
inline std::span<std::byte> engine_memory() { return {__engine_start, __engine_end}; }
inline std::span<std::byte> firmware_memory() { return {__firmware_start, __firmware_end}; }
inline std::span<std::byte> ram() { return {__ram_start, __ram_end}; }
inline std::span<std::byte> vram() { return {__vram_start, __vram_end}; }
/// Flash: the memory protection unit lets nobody write it (protection.h).
inline std::span<std::byte> rom() { return {__rom_start, __rom_end}; }

}  // namespace usuzumi::boards::cortex_m7
