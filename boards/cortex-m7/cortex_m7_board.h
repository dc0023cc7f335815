// The board: time from SysTick, text by semihosting, pins after a script. Its machine has no display controller: which
// picture would be sent is known, nothing sends it.
#pragma once

#include <cstdint>

#include "boards/common/board.h"
#include "boards/cortex-m7/pin_script.h"

namespace usuzumi::boards::cortex_m7 {

class CortexM7Board final : public Board {
 public:
  /// Starts the timer.
  explicit CortexM7Board(const PinScript& pins);

 private:
  std::uint64_t do_now_ns() override;
  Status do_start(const Scanout& scanout) override;
  /// There is no vertical blank to wait for: the picture counts as sent.
  Status do_show(std::uint32_t picture, const PictureRectangle* part) override;
  PinInputs do_read() override;
  void do_set_backlight(bool) override {}  // its state stands in each step's line
  void do_wait_for_change(std::uint32_t timeout_us) override;
  void do_print(std::string_view line) override;
  /// "cost 3 instructions=4711000", where a picture was shown: from the step's first look at the pins until then, so
  /// that the text and the picture's checksum are not in it. Exact to 40 instructions under QEMU's -icount shift=0,
  /// else a measure of time.
  void do_step_done() override;

  PinScript pins_;
  std::uint32_t frame_ = 0;
  bool step_begun_ = false, shown_ = false;
  std::uint64_t step_start_ticks_ = 0, step_end_ticks_ = 0;
};

}  // namespace usuzumi::boards::cortex_m7
