// GpioLines with libgpiod 1.6: every line is requested on its own, and lives as long as its chip is open.
#include "hal/linux/gpio_lines.h"

#include <cerrno>
#include <cstring>
#include <gpiod.h>
#include <time.h>

namespace usuzumi::linux_hal {
namespace {

timespec timespec_of(std::uint32_t us) {
  return {static_cast<time_t>(us / 1'000'000), static_cast<long>(us % 1'000'000) * 1000};
}

int flags_of(const GpioLine& line) { return line.active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0; }

}  // namespace

bool GpioLines::open_path(const char* path) {
  chip_ = gpiod_chip_open(path);
  return chip_ != nullptr;
}

bool GpioLines::chip_is_called(const char* label_or_name) {
  return std::strcmp(gpiod_chip_label(chip_), label_or_name) == 0 ||
         std::strcmp(gpiod_chip_name(chip_), label_or_name) == 0;
}

void GpioLines::close_chip() {
  if (chip_ != nullptr) gpiod_chip_close(chip_);  // its lines are released with it
  chip_ = nullptr;
}

Status GpioLines::take_lines() {
  for (std::size_t i = 0; i < input_count_; ++i) {
    input_lines_[i] = gpiod_chip_get_line(chip_, inputs_[i].offset);
    if (input_lines_[i] == nullptr || gpiod_line_request_both_edges_events_flags(
                                          input_lines_[i], kConsumer, flags_of(inputs_[i])) < 0)
      return line_failed(inputs_[i].offset, errno);
  }
  for (std::size_t i = 0; i < output_count_; ++i) {
    output_lines_[i] = gpiod_chip_get_line(chip_, outputs_[i].offset);
    if (output_lines_[i] == nullptr ||
        gpiod_line_request_output_flags(output_lines_[i], kConsumer, flags_of(outputs_[i]), 0) < 0)
      return line_failed(outputs_[i].offset, errno);
  }
  return ok_status();
}

void GpioLines::close() {
  close_chip();
  chip_open_ = false;
  input_lines_ = output_lines_ = {};
}

Result<bool> GpioLines::get(std::size_t input) {
  const int value = gpiod_line_get_value(input_lines_[input]);
  if (value < 0) return access_failed("cannot be read", inputs_[input].offset, errno);
  return value != 0;
}

Status GpioLines::set(std::size_t output, bool active) {
  if (gpiod_line_set_value(output_lines_[output], active ? 1 : 0) == 0) return ok_status();
  return access_failed("cannot be set", outputs_[output].offset, errno);
}

Result<bool> GpioLines::wait_edge(std::uint32_t timeout_us) {
  gpiod_line_bulk lines, ready;
  gpiod_line_bulk_init(&lines);
  for (std::size_t i = 0; i < input_count_; ++i) gpiod_line_bulk_add(&lines, input_lines_[i]);
  const timespec timeout = timespec_of(timeout_us);
  const int result = gpiod_line_event_wait_bulk(&lines, &timeout, &ready);
  if (result < 0 && errno != EINTR) return access_failed("cannot be waited for", inputs_[0].offset, errno);
  return result > 0;
}

Result<std::size_t> GpioLines::read_edges(std::span<GpioEdge> edges) {
  constexpr unsigned kAtOnce = 16;  // the kernel's queue of a line
  gpiod_line_event events[kAtOnce];
  std::size_t count = 0;
  for (std::size_t i = 0; i < input_count_; ++i) {
    for (int reads = 0; reads < kMostReads; ++reads) {
      const timespec at_once{};
      const int waiting = gpiod_line_event_wait(input_lines_[i], &at_once);
      if (waiting == 0 || (waiting < 0 && errno == EINTR)) break;
      const int read = waiting < 0 ? waiting : gpiod_line_event_read_multiple(input_lines_[i], events, kAtOnce);
      if (read < 0) return access_failed("events cannot be read", inputs_[i].offset, errno);
      for (int e = 0; e < read && count < edges.size(); ++e) {
        const auto seconds = static_cast<std::uint64_t>(events[e].ts.tv_sec);
        edges[count++] = {i, events[e].event_type == GPIOD_LINE_EVENT_RISING_EDGE,
                          seconds * 1'000'000'000u + static_cast<std::uint64_t>(events[e].ts.tv_nsec)};
      }
    }
  }
  return count;
}

}  // namespace usuzumi::linux_hal
