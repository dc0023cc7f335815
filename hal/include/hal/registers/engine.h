// Registers of the 3D engine: one definition for the driver that writes them and the model that obeys them.
//
// A list is run by writing LADR and LWRD and then BELL. STAT.BUSY is set at once; when the list has been worked off,
// BUSY falls and INTST shows DONE, or ERR with its cause in ECODE and EWORD. The counters belong to the last list that
// ended and keep their values while the next one runs.
//
// Registers are 32-bit words; reserved bits read zero and must be written zero. RW read and write, RO read only, WO
// write only (reads zero), W1C write one to clear.
//
//   offset  name   access reset       what
//   0x000   ID     RO     0x44335A55  "UZ3D": tells a driver that a 3D engine is there
//   0x004   VER    RO     0x00010000  version of the rasterizer: 31-16 major (a new one may change pixels), 15-0 minor
//   0x008   CTRL   WO     0           0 RST: stops the list (what is drawn stays drawn), every register to its reset
//   0x00C   STAT   RO     0           0 BUSY, 1 ERR: the last list stopped at a fault
//   0x010   LADR   RW     0           bus address of the list, a multiple of 4
//   0x014   LWRD   RW     0           23-0 words of the list, kEnd included; not 0
//   0x018   BELL   WO     0           0 RING: starts the list at LADR; while BUSY ignored, and INTST.DBI set
//   0x01C   INTST  W1C    0           interrupt status: 0 DONE, 1 ERR, 2 DBI (doorbell ignored)
//   0x020   INTEN  RW     0           interrupt enable, same bits; the line is high while INTST & INTEN is not 0
//   0x024   ECODE  RO     0           why the last list stopped (ErrorCode), 0 when it ended well
//   0x028   EWORD  RO     0           the word of the list, from 0, whose packet is at fault
//   0x030   CYCL   RO     0           engine clocks from the doorbell to the end of the last list, bits 31-0
//   0x034   CYCH   RO     0           bits 63-32
//   0x038   FDRAW  RO     0           triangles left after clipping, culling and dropping those without area
//   0x03C   FIN    RO     0           triangles submitted
//   0x040   VTX    RO     0           vertices transformed; FDRAW, FIN and VTX stick at 0xFFFFFFFF
#pragma once

#include <cstdint>

#include "hal/registers/field.h"

namespace usuzumi::engine_registers {

inline constexpr std::uint32_t kBlockSize = 0x044;  // bytes of address space

struct Id {
  static constexpr std::uint32_t kOffset = 0x000, kReset = 0x44335A55;
};
struct Ver {
  static constexpr std::uint32_t kOffset = 0x004, kReset = 0x00010000;
  static constexpr RegisterField kMinor{0, 16}, kMajor{16, 16};
};
struct Ctrl {
  static constexpr std::uint32_t kOffset = 0x008;
  static constexpr RegisterField kRst{0, 1};
};
struct Stat {
  static constexpr std::uint32_t kOffset = 0x00C;
  static constexpr RegisterField kBusy{0, 1}, kErr{1, 1};
};
struct Ladr {
  static constexpr std::uint32_t kOffset = 0x010;
};
struct Lwrd {
  static constexpr std::uint32_t kOffset = 0x014;
  static constexpr RegisterField kWords{0, 24};
};
struct Bell {
  static constexpr std::uint32_t kOffset = 0x018;
  static constexpr RegisterField kRing{0, 1};
};

/// Bits of INTST and INTEN.
inline constexpr std::uint32_t kIntDone = 1u << 0;
inline constexpr std::uint32_t kIntError = 1u << 1;
inline constexpr std::uint32_t kIntDoorbellIgnored = 1u << 2;
inline constexpr std::uint32_t kIntAll = 0x7;

struct IntSt {
  static constexpr std::uint32_t kOffset = 0x01C;
};
struct IntEn {
  static constexpr std::uint32_t kOffset = 0x020;
};

enum class ErrorCode : std::uint32_t {
  kNone = 0,
  kListUnaligned = 1,        // LADR is no multiple of 4
  kListEmpty = 2,            // LWRD is 0
  kListNotMemory = 3,        // some word of the list lies where no memory is
  kListCorrupt = 4,          // a packet of the wrong length, one past the end, or no end packet
  kUnknownCommand = 5,       // opcode or feature this engine does not have
  kValueOutOfRange = 6,      // a packet's value breaks its rule, or an address in it is no memory
  kStateMissing = 7,         // a draw or clear before the target or stream it needs
  kOutOfInternalMemory = 8,  // the engine's own buffers are too small for this draw
  kInternal = 9,             // the engine itself failed
};
struct ECode {
  static constexpr std::uint32_t kOffset = 0x024;
};
struct EWord {
  static constexpr std::uint32_t kOffset = 0x028;
};

/// Both words belong to the same list when STAT.BUSY reads 0 after them.
struct CycL {
  static constexpr std::uint32_t kOffset = 0x030;
};
struct CycH {
  static constexpr std::uint32_t kOffset = 0x034;
};
struct FDraw {
  static constexpr std::uint32_t kOffset = 0x038;
};
struct FIn {
  static constexpr std::uint32_t kOffset = 0x03C;
};
struct Vtx {
  static constexpr std::uint32_t kOffset = 0x040;
};

}  // namespace usuzumi::engine_registers
