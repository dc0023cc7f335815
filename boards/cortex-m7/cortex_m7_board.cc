#include "boards/cortex-m7/cortex_m7_board.h"

#include "boards/bare_metal/semihosting.h"
#include "boards/common/text_line.h"
#include "boards/cortex-m7/system_timer.h"

namespace usuzumi::boards::cortex_m7 {

CortexM7Board::CortexM7Board(const PinScript& pins) : pins_(pins) { start_system_timer(); }

std::uint64_t CortexM7Board::do_now_ns() { return system_ticks() * kTickNs; }

Status CortexM7Board::do_start(const Scanout& scanout) {
  if (scanout.width == 0 || scanout.height == 0)
    return {StatusCode::kInvalidArgument, "the picture has no pixels; width", scanout.width};
  return ok_status();
}

Status CortexM7Board::do_show(std::uint32_t picture, const PictureRectangle*) {
  if (picture > 1) return {StatusCode::kInvalidArgument, "the display has pictures 0 and 1, not", picture};
  step_end_ticks_ = system_ticks();
  shown_ = true;
  return ok_status();
}

PinInputs CortexM7Board::do_read() {
  if (!step_begun_) step_start_ticks_ = system_ticks();
  step_begun_ = true;
  return pins_.at(frame_);
}

void CortexM7Board::do_wait_for_change(std::uint32_t timeout_us) {
  const std::uint64_t deadline = system_ticks() + std::uint64_t{timeout_us} * (kTickHz / 1'000'000);
  while (system_ticks() < deadline) sleep_until_interrupt();
}

void CortexM7Board::do_print(std::string_view line) { semihosting::print(line); }

void CortexM7Board::do_step_done() {
  constexpr std::uint64_t kInstructionsPerTick = kTickNs;
  if (shown_ && step_begun_) {
    TextLine line;
    line.text("cost ").number(frame_).text(" instructions=");
    line.number((step_end_ticks_ - step_start_ticks_) * kInstructionsPerTick);
    print(line.finish());
  }
  step_begun_ = shown_ = false;
  ++frame_;
}

}  // namespace usuzumi::boards::cortex_m7
