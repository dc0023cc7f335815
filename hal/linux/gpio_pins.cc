#include "hal/linux/gpio_pins.h"

#include <array>
#include <time.h>

namespace usuzumi::linux_hal {
namespace {

constexpr std::size_t kIgnition = 0, kMode = 1, kBacklight = 0;  // places in the lists of lines

}  // namespace

Status GpioPins::open(const GpioPinsConfig& config) {
  const std::array inputs{config.ignition, config.mode_button};
  const std::array outputs{config.backlight};
  last_ = {};
  failed_ = ok_status();
  return lines_.open(config.chip, inputs, outputs);
}

void GpioPins::close() {
  if (!lines_.is_open()) return;
  note(lines_.set(kBacklight, false));
  lines_.close();
}

Status GpioPins::check() {
  const Status status = failed_;
  failed_ = ok_status();
  return status;
}

void GpioPins::note(const Status& status) {
  if (!status.ok()) failed_ = status;
}

PinInputs GpioPins::do_read() {
  if (!lines_.is_open()) return {};
  // Events before levels: what happens in between is then seen twice at worst, never lost.
  std::array<GpioEdge, 64> edges;
  const Result<std::size_t> count = lines_.read_edges(edges);
  const Result<bool> ignition = lines_.get(kIgnition);
  const Result<bool> button = lines_.get(kMode);
  note(count.status());
  note(ignition.status());
  note(button.status());
  const bool was_down = last_.mode_button;
  if (ignition.ok()) last_.ignition = *ignition;
  if (button.ok()) last_.mode_button = *button;
  PinInputs inputs = last_;
  // The kernel names an edge by the level it finds when it comes to look: of a press that is over by then both edges
  // are falling ones. On a button that was up, any edge is a press.
  for (std::size_t i = 0; i < *count; ++i)
    if (edges[i].input == kMode && (edges[i].active || !was_down)) inputs.mode_button = true;
  return inputs;
}

void GpioPins::do_set_backlight(bool on) {
  if (lines_.is_open()) note(lines_.set(kBacklight, on));
}

void GpioPins::do_wait_for_change(std::uint32_t timeout_us) {
  if (lines_.is_open()) {
    const Result<bool> edge = lines_.wait_edge(timeout_us);
    if (edge.ok()) return;
    note(edge.status());
  }
  // A chip that fails must not make the instrument spin.
  const timespec pause{static_cast<time_t>(timeout_us / 1'000'000), static_cast<long>(timeout_us % 1'000'000) * 1000};
  nanosleep(&pause, nullptr);
}

}  // namespace usuzumi::linux_hal
