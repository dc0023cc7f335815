// Plays a bundle of golden cases (bundle.h) on whatever runs it, a host or a bare board, and prints the manifest's
// lines.
//
// No heap, no exceptions, 16 KiB of stack. The bundle stays in ROM, command lists are executed where they lie.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "hal/status.h"

namespace usuzumi::golden {

/// What the board gives. Runs take from `ram` what they say, no more, so that they run short where they are meant to.
struct PlayerMemory {
  std::span<std::byte> ram;          // the firmware's work area
  std::span<std::byte> vram;
  std::span<std::byte> engine_work;  // see SoftEngine::minimum_work_bytes
};

class LineSink {
 public:
  /// A whole line with its '\n', as boards::Board::print() takes it. Valid during the call.
  void line(std::string_view text) { do_line(text); }

 protected:
  ~LineSink() = default;

 private:
  virtual void do_line(std::string_view text) = 0;
};

/// Plays all cases in order. Lines are
///
///   # golden: 41 cases on cortex-m7
///   33-cluster 480 272 6307efc7                     a picture: width, height, CRC-32
///   run-01-levels/mesh-03 144 144 a1abf842          a mesh of the RAM copy: vertices, indices, CRC-32
///   run-06-wide not on cortex-m7: REASON            passed over, as the bundle says
///   run-05-short-of-ram failed: MESSAGE 1234        what went wrong, and where
///   # golden: done, 172 lines                       between the first line and this one
///
/// A case that fails does not stop those behind it; the first failure is returned. So is what is wrong with the bundle,
/// with no line but the message.
Status play(std::span<const std::byte> bundle, const PlayerMemory& memory, std::string_view board, LineSink& out);

}  // namespace usuzumi::golden
