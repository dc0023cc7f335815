#include "boards/cortex-a9/pl111.h"

namespace usuzumi::boards::cortex_a9 {
namespace {

// DDI 0293, section 3.2. (The PL110 has control and interrupt mask the other way round.)
constexpr std::uint32_t kTiming0 = 0x000, kTiming1 = 0x004, kTiming2 = 0x008, kUpBase = 0x010, kControl = 0x018,
                        kImsc = 0x01C, kRis = 0x020, kIcr = 0x028;

// LCDControl.
constexpr std::uint32_t kEn = 1u << 0, kTft = 1u << 5, kPwr = 1u << 11;
constexpr std::uint32_t kBpp24 = 5u << 1, kBpp565 = 6u << 1;
constexpr std::uint32_t kBgr = 1u << 8;              // red in the upper bits, as the engine writes it
constexpr std::uint32_t kVCompBackPorch = 1u << 12;  // after the start of vertical sync, where the base is taken over
constexpr std::uint32_t kWatermark8 = 1u << 16;      // fetches as soon as eight words are free

// LCDRIS, LCDIMSC, LCDICR.
constexpr std::uint32_t kFifoUnderflow = 1u << 1, kBaseTaken = 1u << 2, kVCompare = 1u << 3, kBusError = 1u << 4;

// Porches and syncs of common 800x480 panels, in pixels and lines: with them 928x525 clocks make a frame.
constexpr std::uint32_t kHsw = 48, kHfp = 40, kHbp = 40, kVsw = 3, kVfp = 13, kVbp = 29;

}  // namespace

Status Pl111::check_mode(const Scanout& scanout) {
  constexpr StatusCode kRefused = StatusCode::kInvalidArgument;
  if (scanout.width == 0 || scanout.width > kMaxSize || scanout.width % kWidthUnit != 0)
    return {kRefused, "display: the PL111 sends widths of 16 to 1024 pixels in steps of 16, not of", scanout.width};
  if (scanout.height == 0 || scanout.height > kMaxSize)
    return {kRefused, "display: the PL111 sends heights of 1 to 1024 lines, not of", scanout.height};
  if (scanout.stride_bytes != scanout.width * command::bytes_per_pixel(scanout.format))
    return {kRefused, "display: the PL111 sends rows without gaps, not bytes", scanout.stride_bytes};
  return ok_status();
}

void Pl111::start(const Scanout& scanout) {
  registers_.write(kControl, 0);
  registers_.write(kTiming0,
                   (scanout.width / kWidthUnit - 1) << 2 | (kHsw - 1) << 8 | (kHfp - 1) << 16 | (kHbp - 1) << 24);
  registers_.write(kTiming1, (scanout.height - 1) | (kVsw - 1) << 10 | kVfp << 16 | kVbp << 24);
  registers_.write(kTiming2, (scanout.width - 1) << 16 | 1u << 26);  // CPL; BCD: the panel clock is CLCDCLK undivided
  registers_.write(kUpBase, scanout.picture[0]);
  registers_.write(kIcr, kFifoUnderflow | kBaseTaken | kVCompare | kBusError);
  registers_.write(kImsc, kVCompare);
  const bool rgb565 = scanout.format == command::PixelFormat::kRgb565;
  registers_.write(kControl, kEn | kTft | kBgr | kVCompBackPorch | kWatermark8 | (rgb565 ? kBpp565 : kBpp24));
}

void Pl111::send(BusAddress base) {
  registers_.write(kUpBase, base);
  // Only then, lest a take-over of the old base be mistaken for this one's.
  registers_.write(kIcr, kBaseTaken | kVCompare);
  sent_ = false;
  registers_.write(kControl, registers_.read(kControl) | kPwr);
}

void Pl111::darken() { registers_.write(kControl, registers_.read(kControl) & ~kPwr); }

void Pl111::on_interrupt() {
  const std::uint32_t raw = registers_.read(kRis) & (kVCompare | kBaseTaken);
  if ((raw & kVCompare) == 0) return;
  registers_.write(kIcr, raw);
  vertical_compares_ = vertical_compares_ + 1;
  if ((raw & kBaseTaken) != 0) sent_ = true;
}

Status Pl111::take_fault() {
  const std::uint32_t raw = registers_.read(kRis) & (kFifoUnderflow | kBusError);
  if (raw == 0) return ok_status();
  registers_.write(kIcr, raw);
  if ((raw & kBusError) != 0)
    return {StatusCode::kUnavailable, "display: the bus refused a fetch of the picture; LCDRIS", raw};
  return {StatusCode::kUnavailable, "display: the FIFO ran empty, the bus is too slow for this picture; LCDRIS", raw};
}

}  // namespace usuzumi::boards::cortex_a9
