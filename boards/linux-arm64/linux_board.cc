#include "boards/linux-arm64/linux_board.h"

#include <cerrno>
#include <unistd.h>

#include "hal/linux/monotonic_clock.h"

namespace usuzumi::linux_arm64 {

Status LinuxBoard::open(const linux_hal::GpioPinsConfig& pins, const linux_hal::DrmConfig& display) {
  const Status status = pins_.open(pins);
  return status.ok() ? display_.open(display) : status;
}

void LinuxBoard::close() {
  pins_.close();
  display_.release();
}

std::uint64_t LinuxBoard::do_now_ns() { return linux_hal::monotonic_now_ns(); }

std::uint32_t LinuxBoard::do_stride_bytes(std::uint32_t width, std::uint32_t height, command::PixelFormat format) {
  return display_.stride_bytes(width, height, format);
}

Status LinuxBoard::do_show(std::uint32_t picture, const PictureRectangle* part) {
  return part != nullptr ? display_.show_part(picture, *part) : display_.show(picture);
}

PinInputs LinuxBoard::do_read() { return pins_.read(); }
void LinuxBoard::do_wait_for_change(std::uint32_t timeout_us) { pins_.wait_for_change(timeout_us); }

/// Whole lines at once, so that those of other programs on the same console do not come in between. A reader that has
/// gone is no reason to stop drawing.
void LinuxBoard::do_print(std::string_view line) {
  if (only_changes_ && !changed_lines_.is_news(line)) return;
  while (!line.empty()) {
    const ssize_t written = write(STDOUT_FILENO, line.data(), line.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    line.remove_prefix(static_cast<std::size_t>(written));
  }
}

void LinuxBoard::do_step_done() {
  if (!pause_) return;
  char byte;
  while (!stop_wanted() && ::read(STDIN_FILENO, &byte, 1) < 0 && errno == EINTR) {
  }
}

}  // namespace usuzumi::linux_arm64
