// Registers of the display controller: one definition for the driver that writes them and the model that obeys them.
//
// Names, timing rules and the offsets 0x004-0x014 and 0x100 are those of Fujitsu's MB862xx graphics display
// controllers. Where we differ: HDB (the split display) is not implemented; the interrupt registers lie in this block;
// layer strides are in bytes; every layer has two banks; per-pixel alpha and colour key are bits of the layer's mode;
// the signature unit is after that family's successors, reduced to CRC-32 over the picture and one window.
//
// Registers are 32-bit words; reserved bits read zero and must be written zero. RW read and write, RO read only, W1C
// write one to clear. *Shadowed* registers may be written at any time: what they say is taken over (latched) when the
// display is switched on and at every vertical blank, unless LOCK holds it back, and rules the next frame.
//
//   offset  name   access reset       shadowed  what
//   0x000   DID    RO     0x31434455            "UDC1": tells a driver that a display controller is there
//   0x004   HTP    RW     0           yes       31-16 pixels of a line in all - 1
//   0x008   HDP    RW     0           yes       15-0 pixels displayed - 1; 27-16 HDB, not implemented
//   0x00C   HSP    RW     0           yes       15-0 HSP, 23-16 HSW, 31-24 VSW: sync starts and widths - 1
//   0x010   VTR    RW     0           yes       31-16 lines of a frame in all - 1
//   0x014   VDP    RW     0           yes       15-0 VSP, 31-16 VDP: lines displayed - 1
//   0x020   INTST  W1C    0                     interrupt status: 0 VB, 1 FUF, 2 SGM, 3 CFE
//   0x024   INTEN  RW     0                     interrupt enable, same bits
//   0x028   FCNT   RO     0                     vertical blanks since reset, modulo 2^32
//   0x02C   DST    RO     0                     0 RUN, 1 VB (in the vertical blank now)
//   0x030   SCAN   RO     0                     15-0 line being sent
//   0x034   BGC    RW     0           yes       background colour, red 23-16, green 15-8, blue 7-0
//   0x038   LOCK   RW     0                     0: while 1, nothing is latched at vertical blank
//   0x03C   CFGE   W1C    0                     what CFE is about: 0 timing, 1 signature window, 19-16 layers 3-0,
//                                               24 cursor
//   0x100   DCM1   RW     0           yes *     13-8 SC, 19-16 layer 3-0 enable, 24 cursor enable, 31 DEN
//   0x140   L0M    RW     0x00FF0000  yes       1-0 FMT, 4 KEY, 5 PPA, 23-16 GA
//   0x144   L0ST   RW     0           yes       stride in bytes, a multiple of 4
//   0x148   L0DA0  RW     0           yes       address of bank 0, a multiple of 4
//   0x14C   L0DA1  RW     0           yes       address of bank 1, a multiple of 4
//   0x150   L0P    RW     0           yes       12-0 x, 28-16 y of the upper left corner, two's complement
//   0x154   L0S    RW     0           yes       11-0 width - 1, 27-16 height - 1
//   0x158   L0K    RW     0           yes       colour key, red 23-16, green 15-8, blue 7-0
//   0x15C   L0F    RW/RO  0           yes       0 BANK wanted (RW); 30 SHOWN, 31 PEND (RO)
//   0x180, 0x1C0, 0x200                         the same for layers 1, 2, 3
//   0x240   CUA    RW     0           yes       cursor image: 64 x 64 ARGB8888, 256 bytes a row; a multiple of 4
//   0x244   CUP    RW     0           yes       12-0 x, 28-16 y of its upper left corner, two's complement
//   0x280   SGC    RW     0           yes       0 PIC, 1 WIN, 2 CHK
//   0x284   SGP    RW     0           yes       window: 11-0 x, 27-16 y
//   0x288   SGS    RW     0           yes       window: 11-0 width - 1, 27-16 height - 1
//   0x28C   SGR    RW     0           yes       reference for the window's CRC
//   0x290   SGPIC  RO     0                     CRC of the last complete picture
//   0x294   SGWIN  RO     0                     CRC of its window
//   0x298   SGFR   RO     0                     FCNT of the frame that both belong to
//
// * DEN is not shadowed. 0 to 1 while stopped: latches all, and starts with the vertical sync, so that a panel waiting
//   for it loses no picture; with illegal timing it does not start and raises CFE. 1 to 0: the frame being sent is
//   completed.
#pragma once

#include <cstdint>

#include "hal/registers/field.h"

namespace usuzumi::display_registers {

inline constexpr std::uint32_t kLayerCount = 4;
inline constexpr std::uint32_t kBlockSize = 0x400;        // bytes of address space
inline constexpr std::uint32_t kMaxSize = 4096;           // pixels or lines displayed
inline constexpr std::uint32_t kCursorSize = 64;          // pixels each way
inline constexpr std::uint32_t kCursorStrideBytes = 256;
inline constexpr std::uint32_t kReferenceClockHz = 400'000'000;

struct Did {
  static constexpr std::uint32_t kOffset = 0x000, kReset = 0x31434455;
};

// ------------------------------------------------------------------------------------------------------------- timing

struct Htp {
  static constexpr std::uint32_t kOffset = 0x004;
  static constexpr RegisterField kHtp{16, 13};
};
struct Hdp {
  static constexpr std::uint32_t kOffset = 0x008;
  static constexpr RegisterField kHdp{0, 12}, kHdb{16, 12};
};
struct Hsp {
  static constexpr std::uint32_t kOffset = 0x00C;
  static constexpr RegisterField kHsp{0, 13}, kHsw{16, 8}, kVsw{24, 6};
};
struct Vtr {
  static constexpr std::uint32_t kOffset = 0x010;
  static constexpr RegisterField kVtr{16, 13};
};
struct Vdp {
  static constexpr std::uint32_t kOffset = 0x014;
  static constexpr RegisterField kVsp{0, 13}, kVdp{16, 12};
};

/// The timing fields as the registers hold them (each value - 1; SC is in DCM1). A line is HDP + 1 pixels of picture,
/// then front porch; HSYNC starts HSP + 1 pixels after the line's start and lasts HSW + 1; the line ends after HTP + 1.
/// Lines of a frame likewise. Pixel clock = reference / (SC + 1).
struct Timing {
  std::uint32_t htp = 0, hdp = 0, hsp = 0, hsw = 0;
  std::uint32_t vtr = 0, vdp = 0, vsp = 0, vsw = 0;
  std::uint32_t sc = 0;
  friend constexpr bool operator==(const Timing&, const Timing&) = default;
};

/// Why the controller refuses `t`, or nullptr when it is legal: 0 < HDP < HSP < HSP + HSW + 1 < HTP, the same
/// vertically, and each within its field.
constexpr const char* timing_fault(const Timing& t);

// -------------------------------------------------------------------------------------------------- control and status

/// Bits of INTST and INTEN.
inline constexpr std::uint32_t kIntVerticalBlank = 1u << 0;       // VB: the last line of the picture has been sent
inline constexpr std::uint32_t kIntFifoUnderflow = 1u << 1;  // FUF: a pixel was due before the bus had delivered it
inline constexpr std::uint32_t kIntSignatureMismatch = 1u << 2;   // SGM: the window's CRC is not SGR
inline constexpr std::uint32_t kIntConfigurationError = 1u << 3;  // CFE: CFGE says what could not be obeyed
inline constexpr std::uint32_t kIntAll = 0xF;

struct IntSt {
  static constexpr std::uint32_t kOffset = 0x020;
};
struct IntEn {
  static constexpr std::uint32_t kOffset = 0x024;
};
struct Fcnt {
  static constexpr std::uint32_t kOffset = 0x028;
};
struct Dst {
  static constexpr std::uint32_t kOffset = 0x02C;
  static constexpr RegisterField kRun{0, 1}, kVb{1, 1};
};
struct Scan {
  static constexpr std::uint32_t kOffset = 0x030;
  static constexpr RegisterField kLine{0, 16};
};
struct Bgc {
  static constexpr std::uint32_t kOffset = 0x034;
  static constexpr RegisterField kRgb{0, 24};
};
struct Lock {
  static constexpr std::uint32_t kOffset = 0x038;
  static constexpr RegisterField kLock{0, 1};
};
struct CfgE {
  static constexpr std::uint32_t kOffset = 0x03C;
  static constexpr RegisterField kTiming{0, 1}, kSignature{1, 1}, kLayers{16, 4}, kCursor{24, 1};
};
struct Dcm1 {
  static constexpr std::uint32_t kOffset = 0x100;
  static constexpr RegisterField kSc{8, 6}, kLayers{16, 4}, kCursor{24, 1}, kDen{31, 1};
};

// --------------------------------------------------------------------------------------------------- layers and cursor

/// Layers lie in front of each other in order, 0 at the back, the cursor before all. Where the window leaves the
/// picture it is cut off.
enum class LayerFormat : std::uint32_t {
  kRgb565 = 0,    // 2 bytes: red 15-11, green 10-5, blue 4-0; widened by repeating the high bits
  kXrgb8888 = 1,  // 4 bytes: red 23-16, green 15-8, blue 7-0
  kArgb8888 = 2,  // the same, alpha 31-24, colour not premultiplied
};
constexpr std::uint32_t bytes_per_pixel(LayerFormat f) { return f == LayerFormat::kRgb565 ? 2 : 4; }

/// Offset of a register of layer n: layer_register(n, LayerStride::kOffset).
constexpr std::uint32_t layer_register(std::uint32_t layer, std::uint32_t offset) {
  return 0x140 + layer * 0x40 + offset;
}

/// LnM. With PPA set and format ARGB8888 a pixel's own alpha counts; GA multiplies it: alpha = round(A * GA / 255).
/// Each channel shown = round((source * alpha + below * (255 - alpha)) / 255), halves up.
struct LayerMode {
  static constexpr std::uint32_t kOffset = 0x00, kReset = 0x00FF0000;
  static constexpr RegisterField kFmt{0, 2}, kKey{4, 1}, kPpa{5, 1}, kGa{16, 8};
};
struct LayerStride {
  static constexpr std::uint32_t kOffset = 0x04;
  static constexpr RegisterField kBytes{0, 16};
};
struct LayerBank0 {
  static constexpr std::uint32_t kOffset = 0x08;
};
struct LayerBank1 {
  static constexpr std::uint32_t kOffset = 0x0C;
};
/// LnP and CUP.
struct Position {
  static constexpr std::uint32_t kOffset = 0x10;
  static constexpr RegisterField kX{0, 13}, kY{16, 13};
};
/// LnS and SGS.
struct Size {
  static constexpr std::uint32_t kOffset = 0x14;
  static constexpr RegisterField kWidth{0, 12}, kHeight{16, 12};
};
/// LnK. Compared with the pixel's colour after widening to 8 bits a channel; an equal pixel is not shown.
struct LayerKey {
  static constexpr std::uint32_t kOffset = 0x18;
  static constexpr RegisterField kRgb{0, 24};
};
/// LnF. Writing asks for BANK from the next latch on; PEND reads 1 until then, SHOWN is the bank being sent.
struct LayerFlip {
  static constexpr std::uint32_t kOffset = 0x1C;
  static constexpr RegisterField kBank{0, 1}, kShown{30, 1}, kPend{31, 1};
};

struct Cua {
  static constexpr std::uint32_t kOffset = 0x240;
};
struct Cup {
  static constexpr std::uint32_t kOffset = 0x244;
};

// ------------------------------------------------------------------------------------------------------ signature unit

/// CRC-32/ISO-HDLC over the bytes R, G, B of each pixel as sent, left to right and top to bottom. PIC: the whole
/// picture; WIN: the window, which must lie inside the picture; CHK: raise SGM when the window's CRC is not SGR.
/// Results appear at the vertical blank that ends their picture.
struct Sgc {
  static constexpr std::uint32_t kOffset = 0x280;
  static constexpr RegisterField kPic{0, 1}, kWin{1, 1}, kChk{2, 1};
};
struct Sgp {
  static constexpr std::uint32_t kOffset = 0x284;
  static constexpr RegisterField kX{0, 12}, kY{16, 12};
};
struct Sgs {
  static constexpr std::uint32_t kOffset = 0x288;
};
struct Sgr {
  static constexpr std::uint32_t kOffset = 0x28C;
};
struct SgPic {
  static constexpr std::uint32_t kOffset = 0x290;
};
struct SgWin {
  static constexpr std::uint32_t kOffset = 0x294;
};
struct SgFr {
  static constexpr std::uint32_t kOffset = 0x298;
};

// ---------------------------------------------------------------------------------------------------------------------

constexpr const char* timing_fault(const Timing& t) {
  if (t.hdp > Hdp::kHdp.max() || t.vdp > Vdp::kVdp.max()) return "the picture is larger than 4096 x 4096";
  if (t.htp > Htp::kHtp.max() || t.hsp > Hsp::kHsp.max()) return "a line is longer than 8192 pixels";
  if (t.vtr > Vtr::kVtr.max() || t.vsp > Vdp::kVsp.max()) return "a frame has more than 8192 lines";
  if (t.hsw > Hsp::kHsw.max()) return "HSYNC is wider than 256 pixels";
  if (t.vsw > Hsp::kVsw.max()) return "VSYNC is wider than 64 lines";
  if (t.sc > Dcm1::kSc.max()) return "the pixel clock is slower than reference / 64";
  if (t.hdp == 0) return "HDP must be greater than 0";
  if (t.hsp <= t.hdp) return "HSP must be greater than HDP: HSYNC needs a front porch";
  if (t.hsp + t.hsw + 1 >= t.htp) return "HTP must be greater than HSP + HSW + 1: HSYNC needs a back porch";
  if (t.vdp == 0) return "VDP must be greater than 0";
  if (t.vsp <= t.vdp) return "VSP must be greater than VDP: VSYNC needs a front porch";
  if (t.vsp + t.vsw + 1 >= t.vtr) return "VTR must be greater than VSP + VSW + 1: VSYNC needs a back porch";
  return nullptr;
}

}  // namespace usuzumi::display_registers
