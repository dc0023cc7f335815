// The memories of link.ld, in C++, and where the board's devices are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

// Addresses, no objects: what the linker script says.
extern "C" {
extern std::byte __engine_start[], __engine_end[];
extern std::byte __ram_start[], __ram_end[];
extern std::byte __vram_start[], __vram_end[];
extern std::byte __rom_start[], __rom_end[];
}

namespace usuzumi::boards::cortex_a9 {

inline std::span<std::byte> engine_memory() { return {__engine_start, __engine_end}; }
inline std::span<std::byte> ram() { return {__ram_start, __ram_end}; }
inline std::span<std::byte> vram() { return {__vram_start, __vram_end}; }
/// Flash: the memory management unit lets nobody write it (mmu.h).
inline std::span<std::byte> rom() { return {__rom_start, __rom_end}; }

// RealView Platform Baseboard for Cortex-A9 (Arm DUI 0440), chapter 4: devices and their interrupts. Shared peripheral
// interrupt n has the identifier 32 + n.
constexpr std::uintptr_t kUart0 = 0x10009000, kTimers01 = 0x10011000, kGpio0 = 0x10013000, kLcd = 0x10020000;
constexpr std::uintptr_t kGicInterface = 0x1F000100, kGicDistributor = 0x1F001000;
constexpr std::uint32_t kTimers01Interrupt = 32 + 4, kGpio0Interrupt = 32 + 6, kLcdInterrupt = 32 + 23;

// Lines of GPIO 0.
constexpr std::uint32_t kIgnitionLine = 1u << 0;   // in, low = on: terminal 15 through an optocoupler that pulls down
constexpr std::uint32_t kModeLine = 1u << 1;       // in, high = pressed
constexpr std::uint32_t kBacklightLine = 1u << 4;  // out, high = lit

}  // namespace usuzumi::boards::cortex_a9
