// Registers of the 3D engine: 32-bit words at offsets from the block's base. Driver and model share this page.
//
// A list is run by writing LIST_ADDRESS and LIST_WORDS and then DOORBELL. STATUS.BUSY is set at once; when the list has
// been worked off BUSY falls and IRQ_STATUS shows DONE, or ERROR with its cause in ERROR_CODE and ERROR_WORD. The
// counters belong to the last list that ended, and hold their values while the next one runs.
#pragma once

#include <cstdint>

#include "hal/registers/field.h"

namespace usuzumi::registers::engine {

inline constexpr std::uint32_t kBlockBytes = 0x1000;

/// 0x00 read-only. Which device this is: "UZ3D" in ASCII, first letter in bits 31-24.
inline constexpr std::uint32_t kId = 0x00;
inline constexpr std::uint32_t kIdValue = 0x555A3344;

/// 0x04 read-only. Version of the rasterizer: goldens belong to one version. A new major number changes pixels.
inline constexpr std::uint32_t kVersion = 0x04;
namespace version {
inline constexpr RegisterField kMinor{0, 16};
inline constexpr RegisterField kMajor{16, 16};
}  // namespace version
inline constexpr std::uint32_t kVersionValue = 0x00010000;

/// 0x08 write-only. SOFT_RESET: stops the list (what is drawn stays drawn) and gives every register its reset value.
inline constexpr std::uint32_t kControl = 0x08;
namespace control {
inline constexpr RegisterField kSoftReset{0, 1};
}  // namespace control

/// 0x0C read-only. BUSY: a list is running. ERROR: the last list stopped at a fault; falls with the next doorbell taken.
inline constexpr std::uint32_t kStatus = 0x0C;
namespace status {
inline constexpr RegisterField kBusy{0, 1};
inline constexpr RegisterField kError{1, 1};
}  // namespace status

/// 0x10 read-write. Bus address of the list's first word, a multiple of 4. Taken at the doorbell.
inline constexpr std::uint32_t kListAddress = 0x10;

/// 0x14 read-write. Words in the list, kEnd included: 1 .. 0xFFFFFF. Taken at the doorbell.
inline constexpr std::uint32_t kListWords = 0x14;
namespace list_words {
inline constexpr RegisterField kCount{0, 24};
}  // namespace list_words

/// 0x18 write-only. RING: starts the list. While BUSY it is ignored and IRQ_STATUS.DOORBELL_IGNORED is set.
inline constexpr std::uint32_t kDoorbell = 0x18;
namespace doorbell {
inline constexpr RegisterField kRing{0, 1};
}  // namespace doorbell

/// 0x1C write 1 to clear. DONE: a list ended well. ERROR: a list stopped at a fault. DOORBELL_IGNORED: see DOORBELL.
/// 0x20 read-write IRQ_ENABLE has the same bits. The interrupt line is high while (IRQ_STATUS & IRQ_ENABLE) != 0.
inline constexpr std::uint32_t kIrqStatus = 0x1C;
inline constexpr std::uint32_t kIrqEnable = 0x20;
namespace irq {
inline constexpr RegisterField kDone{0, 1};
inline constexpr RegisterField kError{1, 1};
inline constexpr RegisterField kDoorbellIgnored{2, 1};
}  // namespace irq

/// 0x24 read-only. Why the last list stopped, as an ErrorCode; 0 when it ended well.
inline constexpr std::uint32_t kErrorCode = 0x24;
enum class ErrorCode : std::uint32_t {
  kNone = 0,
  kListUnaligned = 1,       // LIST_ADDRESS is no multiple of 4
  kListEmpty = 2,           // LIST_WORDS is 0
  kListNotMemory = 3,       // some word of the list lies where no memory is
  kListCorrupt = 4,         // a packet of the wrong length, past the end, or no end packet
  kUnknownCommand = 5,      // opcode or feature this engine does not have
  kValueOutOfRange = 6,     // a packet's value breaks its rule, or an address in it is no memory
  kStateMissing = 7,        // a draw or clear before the target or stream it needs
  kOutOfInternalMemory = 8, // the engine's own buffers are too small for this draw
  kInternal = 9,            // the engine's backend failed
};

/// 0x28 read-only. The word of the list (from 0) whose packet is at fault; 0 where ERROR_CODE is about the list itself.
inline constexpr std::uint32_t kErrorWord = 0x28;

/// 0x30, 0x34 read-only. Engine clocks from the doorbell to the end of the last list. Both words belong to the same list
/// as long as STATUS.BUSY is read 0 after them.
inline constexpr std::uint32_t kCyclesLow = 0x30;
inline constexpr std::uint32_t kCyclesHigh = 0x34;

/// 0x38 .. 0x40 read-only. Triangles left after clipping, culling and dropping those without area; triangles submitted;
/// vertices transformed. They stick at 0xFFFFFFFF.
inline constexpr std::uint32_t kFacesDrawn = 0x38;
inline constexpr std::uint32_t kFacesIn = 0x3C;
inline constexpr std::uint32_t kVertices = 0x40;

}  // namespace usuzumi::registers::engine
