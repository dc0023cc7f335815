#include "boards/cortex-a9/pl011.h"

namespace usuzumi::boards::cortex_a9 {
namespace {

// DDI 0183, section 3.2.
constexpr std::uint32_t kDr = 0x000, kFr = 0x018, kIbrd = 0x024, kFbrd = 0x028, kLcrH = 0x02C, kCr = 0x030;
constexpr std::uint32_t kFrRxfe = 1u << 4, kFrTxff = 1u << 5;      // receive FIFO empty, transmit FIFO full
constexpr std::uint32_t kLcrHFen = 1u << 4, kLcrHWlen8 = 3u << 5;  // FIFOs, eight bits
constexpr std::uint32_t kCrUarten = 1u << 0, kCrTxe = 1u << 8, kCrRxe = 1u << 9;
// UARTCLK 24 MHz / (16 * 115200) = 13 + 1/64, nearly.
constexpr std::uint32_t kDivisorWhole = 13, kDivisor64ths = 1;
// Reads of the flags until the line counts as stuck: many times the 87 us that a byte takes, even at 10 ns a read.
constexpr std::uint32_t kPatience = 1'000'000;

}  // namespace

void Pl011::start() {
  registers_.write(kCr, 0);
  registers_.write(kIbrd, kDivisorWhole);
  registers_.write(kFbrd, kDivisor64ths);
  registers_.write(kLcrH, kLcrHFen | kLcrHWlen8);  // takes the divisors over, so it comes after them
  registers_.write(kCr, kCrUarten | kCrTxe | kCrRxe);
}

void Pl011::print(std::string_view text) {
  for (const char c : text)
    if (!put(c)) return;
}

bool Pl011::put(char c) {
  const std::uint32_t patience = stuck_ ? 1 : kPatience;
  for (std::uint32_t i = 0; i < patience; ++i) {
    if ((registers_.read(kFr) & kFrTxff) != 0) continue;
    registers_.write(kDr, static_cast<unsigned char>(c));
    stuck_ = false;
    return true;
  }
  stuck_ = true;
  return false;
}

char Pl011::receive() {
  if ((registers_.read(kFr) & kFrRxfe) != 0) return '\0';
  return static_cast<char>(registers_.read(kDr) & 0xFFu);
}

}  // namespace usuzumi::boards::cortex_a9
