// Registers of the Cortex-M7 itself that the board uses (Arm DDI 0403, ARMv7-M Architecture Reference Manual, B3.2 to
// B3.5).
#pragma once

#include <cstdint>

namespace usuzumi::boards::cortex_m7 {

inline volatile std::uint32_t& core_register(std::uint32_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

// System timer
constexpr std::uint32_t kSystCsr = 0xE000E010;  // ENABLE(0), TICKINT(1), CLKSOURCE(2): the processor's clock
constexpr std::uint32_t kSystRvr = 0xE000E014;  // from which it counts down
constexpr std::uint32_t kSystCvr = 0xE000E018;  // where it is

// System control
constexpr std::uint32_t kIcsr = 0xE000ED04;     // PENDSTSET(26): the timer's interrupt waits
constexpr std::uint32_t kVtor = 0xE000ED08;     // where the vector table lies
constexpr std::uint32_t kCcr = 0xE000ED14;      // DIV_0_TRP(4): an integer division by zero faults
constexpr std::uint32_t kShcsr = 0xE000ED24;    // MEMFAULTENA(16), BUSFAULTENA(17), USGFAULTENA(18)
constexpr std::uint32_t kCfsr = 0xE000ED28;     // why a fault came: memory management, bus and usage
constexpr std::uint32_t kHfsr = 0xE000ED2C;     // why a hard fault came
constexpr std::uint32_t kMmfar = 0xE000ED34;    // the address, where CFSR.MMARVALID(7) is set
constexpr std::uint32_t kBfar = 0xE000ED38;     // the address, where CFSR.BFARVALID(15) is set
constexpr std::uint32_t kCpacr = 0xE000ED88;    // CP10, CP11: access to the floating-point unit

// Memory protection unit
constexpr std::uint32_t kMpuCtrl = 0xE000ED94;  // ENABLE(0), PRIVDEFENA(2): elsewhere the default map holds
constexpr std::uint32_t kMpuRbar = 0xE000ED9C;  // base | VALID(4) | region number
constexpr std::uint32_t kMpuRasr = 0xE000EDA0;  // ENABLE(0), SIZE(1), B(16), C(17), S(18), TEX(19), AP(24), XN(28)

inline void synchronize() { asm volatile("dsb\n\tisb" ::: "memory"); }

}  // namespace usuzumi::boards::cortex_m7
