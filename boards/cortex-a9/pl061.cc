#include "boards/cortex-a9/pl061.h"

namespace usuzumi::boards::cortex_a9 {
namespace {

// DDI 0190, section 3.2. GPIODATA is 256 words: bits 9:2 of the address choose the lines that an access is about.
constexpr std::uint32_t kDir = 0x400, kIs = 0x404, kIbe = 0x408, kIe = 0x410, kMis = 0x418, kIc = 0x41C, kAfsel = 0x420;
constexpr std::uint32_t data_of(std::uint32_t lines) { return lines << 2; }
constexpr std::uint32_t kAllLines = 0xFF;

}  // namespace

void Pl061::start(std::uint32_t outputs, std::uint32_t watched) {
  registers_.write(kIe, 0);
  registers_.write(kAfsel, 0);            // software drives the lines, no other peripheral
  registers_.write(data_of(outputs), 0);  // low before they are outputs: no flash of light
  registers_.write(kDir, outputs);
  registers_.write(data_of(outputs), 0);  // and after, for a line that was an input takes no data
  registers_.write(kIs, 0);               // edges
  registers_.write(kIbe, watched);        // both
  registers_.write(kIc, kAllLines);
  registers_.write(kIe, watched);
}

std::uint32_t Pl061::read(std::uint32_t lines) const { return registers_.read(data_of(lines)); }

void Pl061::write(std::uint32_t lines, bool high) { registers_.write(data_of(lines), high ? kAllLines : 0); }

void Pl061::on_interrupt() {
  const std::uint32_t seen = registers_.read(kMis);
  registers_.write(kIc, seen);  // no other edges than those just read
  edges_ |= seen;
}

std::uint32_t Pl061::take_edges() {
  on_interrupt();
  const std::uint32_t edges = edges_;
  edges_ = 0;
  return edges;
}

std::uint32_t Pl061::edges() const { return edges_ | registers_.read(kMis); }

}  // namespace usuzumi::boards::cortex_a9
