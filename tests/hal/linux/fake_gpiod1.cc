// Stands in for libgpiod 1.6: the functions that gpio_lines_v1.cc calls, on fake chips, by the library's own header.
#include <cerrno>
#include <gpiod.h>

#include "tests/hal/linux/fake_chip.h"

using namespace usuzumi::linux_hal::testing;

struct gpiod_line {
  FakeChip* chip = nullptr;
  unsigned offset = 0;
  FakeLine& fake() { return chip->lines[offset]; }
};

struct gpiod_chip {
  FakeChip* chip = nullptr;
  gpiod_line lines[8];
};

namespace {

int request(gpiod_line* line, int flags, bool output) {
  FakeLine& fake = line->fake();
  if (fake.held_by_another || fake.requested) errno = EBUSY;
  else if (!output && !fake.has_interrupt) errno = ENXIO;
  else {
    fake.requested = true;
    fake.output = output;
    fake.edges = !output;
    fake.active_low = (flags & GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW) != 0;
    if (output) fake.level = fake.active_low;  // inactive
    return 0;
  }
  return -1;
}

}  // namespace

gpiod_chip* gpiod_chip_open(const char* path) {
  FakeChip* const chip = open_fake_chip(path);
  if (chip == nullptr) return nullptr;
  ++fake_chips().open_chips;
  auto* const opened = new gpiod_chip{chip, {}};
  for (unsigned i = 0; i < 8; ++i) opened->lines[i] = {chip, i};
  return opened;
}

void gpiod_chip_close(gpiod_chip* chip) {
  for (FakeLine& line : chip->chip->lines) {
    line.requested = false;
    line.queue.clear();
  }
  --fake_chips().open_chips;
  delete chip;
}

const char* gpiod_chip_name(gpiod_chip* chip) { return chip->chip->name.c_str(); }
const char* gpiod_chip_label(gpiod_chip* chip) { return chip->chip->label.c_str(); }

gpiod_line* gpiod_chip_get_line(gpiod_chip* chip, unsigned int offset) {
  if (offset < 8) return &chip->lines[offset];
  errno = EINVAL;
  return nullptr;
}

int gpiod_line_request_both_edges_events_flags(gpiod_line* line, const char*, int flags) {
  return request(line, flags, false);
}

int gpiod_line_request_output_flags(gpiod_line* line, const char*, int flags, int) {
  return request(line, flags, true);
}

int gpiod_line_get_value(gpiod_line* line) {
  if (!line->fake().broken) return line->fake().active() ? 1 : 0;
  errno = EIO;
  return -1;
}

int gpiod_line_set_value(gpiod_line* line, int value) {
  if (line->fake().broken) {
    errno = EIO;
    return -1;
  }
  line->fake().level = (value != 0) != line->fake().active_low;
  return 0;
}

int gpiod_line_event_wait_bulk(gpiod_line_bulk* bulk, const timespec*, gpiod_line_bulk*) {
  if (fake_chips().on_wait) fake_chips().on_wait();
  for (unsigned i = 0; i < bulk->num_lines; ++i)
    if (!bulk->lines[i]->fake().queue.empty()) return 1;
  return 0;
}

int gpiod_line_event_wait(gpiod_line* line, const timespec*) { return line->chip->edges_wait(line->offset) ? 1 : 0; }

int gpiod_line_event_read_multiple(gpiod_line* line, gpiod_line_event* events, unsigned int most) {
  unsigned count = 0;
  for (auto& queue = line->fake().queue; count < most && !queue.empty(); queue.pop_front()) {
    const FakeEdge& edge = queue.front();
    events[count].ts = {static_cast<time_t>(edge.time_ns / 1'000'000'000),
                        static_cast<long>(edge.time_ns % 1'000'000'000)};
    events[count].event_type = edge.rising ? GPIOD_LINE_EVENT_RISING_EDGE : GPIOD_LINE_EVENT_FALLING_EDGE;
    ++count;
  }
  return static_cast<int>(count);
}
