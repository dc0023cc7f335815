#include "boards/cortex-a9/cortex_a9_board.h"

#include "boards/cortex-a9/gic.h"

namespace usuzumi::boards::cortex_a9 {

void CortexA9Board::start() {
  console_.start();
  timers_.start();
  gpio_.start(kBacklightLine, kIgnitionLine | kModeLine);
  times_.ignition(ignition(), moment());
  start_interrupts();
  connect_interrupt(kTimers01Interrupt, timers_);
  connect_interrupt(kLcdInterrupt, display_);
  connect_interrupt(kGpio0Interrupt,
                    {[](void* board) { static_cast<CortexA9Board*>(board)->on_gpio_interrupt(); }, this});
  asm volatile("cpsie i" ::: "memory");
}

template <class Done>
bool CortexA9Board::wait_until(std::uint32_t timeout_us, Done done) {
  const InterruptLock lock;
  timers_.set_alarm(timeout_us);
  while (!done() && !timers_.alarm_rang()) lock.sleep();
  timers_.cancel_alarm();
  return done();
}

// ---- clock

std::uint64_t CortexA9Board::do_now_ns() {
  const InterruptLock lock;
  return timers_.now_ns();
}

// ---- display

std::uint32_t CortexA9Board::do_stride_bytes(std::uint32_t width, std::uint32_t, command::PixelFormat format) {
  return width * command::bytes_per_pixel(format);  // the PL111 knows no gap between rows
}

Status CortexA9Board::do_start(const Scanout& scanout) {
  const Status status = Pl111::check_mode(scanout);
  if (!status.ok()) return status;
  scanout_ = scanout;
  display_.start(scanout);
  return status;
}

Status CortexA9Board::do_show(std::uint32_t picture, const PictureRectangle* part) {
  const bool black = part != nullptr && part->empty();
  {
    const InterruptLock lock;
    times_.handed(black, moment());
    asm volatile("dsb" ::: "memory");  // the picture is in memory before the display fetches it
    display_.send(scanout_.picture[picture]);
  }
  if (!wait_until(kShowTimeoutUs, [this] { return display_.sent(); }))
    return {StatusCode::kDeadlineExceeded, "display: no vertical compare comes; waited, in microseconds",
            kShowTimeoutUs};
  const InterruptLock lock;
  times_.sent(black, moment());
  return ok_status();
}

// ---- pins

PinInputs CortexA9Board::do_read() {
  const InterruptLock lock;
  const std::uint32_t edges = gpio_.take_edges();
  drive_backlight();  // of an edge that no interrupt tells of any more
  // An edge of the button is a press, if only of its end: it was down since the last read.
  const bool pressed = ((edges | gpio_.read(kModeLine)) & kModeLine) != 0;
  return {.ignition = ignition(), .mode_button = pressed};
}

void CortexA9Board::do_set_backlight(bool on) {
  const InterruptLock lock;
  light_wanted_ = on;
  drive_backlight();
}

void CortexA9Board::do_wait_for_change(std::uint32_t timeout_us) {
  wait_until(timeout_us, [this] { return gpio_.edges() != 0; });
}

/// The ignition goes off in the midst of whatever the instrument does: it is dark now, not after the picture at hand.
void CortexA9Board::on_gpio_interrupt() {
  gpio_.on_interrupt();
  drive_backlight();
  if (!ignition()) display_.darken();
}

void CortexA9Board::drive_backlight() {
  times_.ignition(ignition(), moment());
  const bool on = light_wanted_ && ignition();
  gpio_.write(kBacklightLine, on);
  times_.light(on, moment());
}

// ---- for a person or a test

void CortexA9Board::do_step_done() {
  TextLine line;
  bool news;
  {
    const InterruptLock lock;
    news = times_.take_line(line);
  }
  if (news) print(line.finish());
  if (!held_) held_ = console_.receive() == 'h';
  if (!held_) return;
  constexpr std::uint32_t kLookUs = 1000;  // the console has no interrupt here
  char key = console_.receive();
  for (std::uint32_t us = 0; key == '\0' && us < kHoldUs; us += kLookUs) {
    wait_until(kLookUs, [] { return false; });
    key = console_.receive();
  }
  held_ = key != '\0' && key != 'r';
}

}  // namespace usuzumi::boards::cortex_a9
