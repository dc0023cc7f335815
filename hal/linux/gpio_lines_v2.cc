// GpioLines with libgpiod 2: one request for all inputs, one for all outputs; they outlive the chip's object.
#include "hal/linux/gpio_lines.h"

#include <cerrno>
#include <cstring>
#include <gpiod.h>

namespace usuzumi::linux_hal {
namespace {

constexpr std::size_t kAtOnce = 64;  // events a read takes; the kernel keeps 16 for each line of a request

/// nullptr with errno where the lines are not to be had.
gpiod_line_request* request_lines(gpiod_chip* chip, std::span<const GpioLine> lines, bool inputs) {
  gpiod_line_settings* const settings = gpiod_line_settings_new();
  gpiod_line_config* const config = gpiod_line_config_new();
  gpiod_request_config* const request_config = gpiod_request_config_new();
  gpiod_line_request* request = nullptr;
  if (settings != nullptr && config != nullptr && request_config != nullptr) {
    gpiod_request_config_set_consumer(request_config, GpioLines::kConsumer);
    gpiod_line_settings_set_direction(settings, inputs ? GPIOD_LINE_DIRECTION_INPUT : GPIOD_LINE_DIRECTION_OUTPUT);
    if (inputs) gpiod_line_settings_set_edge_detection(settings, GPIOD_LINE_EDGE_BOTH);
    else gpiod_line_settings_set_output_value(settings, GPIOD_LINE_VALUE_INACTIVE);
    bool complete = true;
    for (const GpioLine& line : lines) {
      gpiod_line_settings_set_active_low(settings, line.active_low);
      complete = complete && gpiod_line_config_add_line_settings(config, &line.offset, 1, settings) == 0;
    }
    if (complete) request = gpiod_chip_request_lines(chip, request_config, config);
  }
  const int error = errno;  // of what failed, not of what is freed
  gpiod_request_config_free(request_config);
  gpiod_line_config_free(config);
  gpiod_line_settings_free(settings);
  errno = error;
  return request;
}

/// The line that a refused request is about: the kernel does not say which of them it was.
unsigned blame(gpiod_chip* chip, std::span<const GpioLine> lines) {
  for (const GpioLine& line : lines) {
    gpiod_line_info* const info = gpiod_chip_get_line_info(chip, line.offset);
    const bool free_line = info != nullptr && !gpiod_line_info_is_used(info);
    if (info != nullptr) gpiod_line_info_free(info);
    if (!free_line) return line.offset;
  }
  return lines.front().offset;
}

}  // namespace

bool GpioLines::open_path(const char* path) {
  chip_ = gpiod_chip_open(path);
  return chip_ != nullptr;
}

bool GpioLines::chip_is_called(const char* label_or_name) {
  gpiod_chip_info* const info = gpiod_chip_get_info(chip_);
  if (info == nullptr) return false;
  const bool called = std::strcmp(gpiod_chip_info_get_label(info), label_or_name) == 0 ||
                      std::strcmp(gpiod_chip_info_get_name(info), label_or_name) == 0;
  gpiod_chip_info_free(info);
  return called;
}

void GpioLines::close_chip() {
  if (chip_ != nullptr) gpiod_chip_close(chip_);
  chip_ = nullptr;
}

Status GpioLines::take_lines() {
  events_ = gpiod_edge_event_buffer_new(kAtOnce);
  if (events_ == nullptr) return access_failed("no memory for events", 0, errno);
  const auto inputs = std::span<const GpioLine>(inputs_).first(input_count_);
  const auto outputs = std::span<const GpioLine>(outputs_).first(output_count_);
  for (const auto lines : {inputs, outputs}) {
    if (lines.empty()) continue;
    const bool for_inputs = lines.data() == inputs.data();
    gpiod_line_request* const request = request_lines(chip_, lines, for_inputs);
    (for_inputs ? input_request_ : output_request_) = request;
    if (request != nullptr) continue;
    const int error = errno;
    return line_failed(blame(chip_, lines), error);
  }
  close_chip();
  return ok_status();
}

void GpioLines::close() {
  if (input_request_ != nullptr) gpiod_line_request_release(input_request_);
  if (output_request_ != nullptr) gpiod_line_request_release(output_request_);
  if (events_ != nullptr) gpiod_edge_event_buffer_free(events_);
  input_request_ = output_request_ = nullptr;
  events_ = nullptr;
  close_chip();
  chip_open_ = false;
}

Result<bool> GpioLines::get(std::size_t input) {
  const gpiod_line_value value = gpiod_line_request_get_value(input_request_, inputs_[input].offset);
  if (value == GPIOD_LINE_VALUE_ERROR) return access_failed("cannot be read", inputs_[input].offset, errno);
  return value == GPIOD_LINE_VALUE_ACTIVE;
}

Status GpioLines::set(std::size_t output, bool active) {
  const gpiod_line_value value = active ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
  if (gpiod_line_request_set_value(output_request_, outputs_[output].offset, value) == 0) return ok_status();
  return access_failed("cannot be set", outputs_[output].offset, errno);
}

Result<bool> GpioLines::wait_edge(std::uint32_t timeout_us) {
  const int result = gpiod_line_request_wait_edge_events(input_request_, std::int64_t{timeout_us} * 1000);
  if (result < 0 && errno != EINTR) return access_failed("cannot be waited for", inputs_[0].offset, errno);
  return result > 0;
}

Result<std::size_t> GpioLines::read_edges(std::span<GpioEdge> edges) {
  std::size_t count = 0;
  for (int reads = 0; reads < kMostReads; ++reads) {
    const int waiting = gpiod_line_request_wait_edge_events(input_request_, 0);
    if (waiting == 0 || (waiting < 0 && errno == EINTR)) break;
    const int read = waiting < 0 ? waiting : gpiod_line_request_read_edge_events(input_request_, events_, kAtOnce);
    if (read < 0) return access_failed("events cannot be read", inputs_[0].offset, errno);
    for (int e = 0; e < read && count < edges.size(); ++e) {
      gpiod_edge_event* const event = gpiod_edge_event_buffer_get_event(events_, static_cast<unsigned long>(e));
      const unsigned offset = gpiod_edge_event_get_line_offset(event);
      std::size_t input = 0;
      while (input + 1 < input_count_ && inputs_[input].offset != offset) ++input;
      edges[count++] = {input, gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE,
                        gpiod_edge_event_get_timestamp_ns(event)};
    }
  }
  return count;
}

}  // namespace usuzumi::linux_hal
