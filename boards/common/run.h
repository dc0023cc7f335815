// The main loop that every board's main.cpp calls: boots the instrument and steps it, a line of text for each step.
#pragma once

#include <cstdint>
#include <string_view>

#include "boards/common/board.h"
#include "boards/common/memory.h"
#include "firmware/instrument/instrument.h"
#include "hal/vec.h"

namespace usuzumi::boards {

struct RunConfig {
  firmware::InstrumentConfig instrument;
  firmware::ThinningSettings thinning;      // where the mode button begins
  std::uint32_t frames = 0;                 // steps to take; 0: for ever
  bool orbit = false;                       // the model turns once in `frames`
  Rgba8 background = rgba8(32, 36, 40);
  bool signature = true;                    // crc32= in each line; the CPU reads every picture back for it
};

/// As the usuzumi command's.
enum ExitCode : int { kExitOk = 0, kExitUsage = 2, kExitBadInput = 3, kExitDevice = 5 };
int exit_code_of(const Status& status);

/// Boots and steps; returns the exit code. The instrument's parts live in static memory: one run at a time.
///
/// A step's line, its words parted by spaces, each frame's numbers those of `usuzumi run --stats`:
///
///   frame 3 picture thinned light=1 crc32=1a2b3c4d meshes=5->4 faces=3624->2002 drawn=1513 ram=227012 thin_us=0
///   draw_us=1460
///
/// in one line; ram is the most that was in use so far. Then, where it applies, dropped=2 halvings=1 (RAM was short),
/// wake_us=33412 (ignition to light) and fault="...". Before the first frame: "boot 800x480 xrgb8888 depth=24
/// vram=4608000", where VRAM was short with what was reduced. A boot that fails: "error: ..." and the exit code; the
/// safe picture is then shown if the display works and the ignition is on, and step_done() called once, so that a test
/// can see it. Where nothing but the drawing data are at fault and frames is 0, it goes on following the ignition with
/// the safe picture until the board is told to stop; all else ends at once.
int run(Board& board, const BoardMemory& memory, const RunConfig& config);

}  // namespace usuzumi::boards
