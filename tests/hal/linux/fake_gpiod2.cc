// Stands in for libgpiod 2: the functions that gpio_lines_v2.cc calls, on fake chips.
#include <algorithm>
#include <cerrno>
#include <gpiod.h>
#include <map>
#include <vector>

#include "tests/hal/linux/fake_chip.h"

using namespace usuzumi::linux_hal::testing;

struct gpiod_chip {
  FakeChip* chip;
};
struct gpiod_chip_info {
  FakeChip* chip;
};
struct gpiod_line_info {
  FakeLine* line;
};
struct gpiod_line_settings {
  gpiod_line_direction direction = GPIOD_LINE_DIRECTION_AS_IS;
  gpiod_line_edge edge = GPIOD_LINE_EDGE_NONE;
  bool active_low = false;
  gpiod_line_value value = GPIOD_LINE_VALUE_INACTIVE;
};
struct gpiod_line_config {
  std::map<unsigned, gpiod_line_settings> lines;
};
struct gpiod_request_config {};
struct gpiod_line_request {
  FakeChip* chip = nullptr;
  std::vector<unsigned> offsets{};
};
struct gpiod_edge_event {
  FakeEdge edge;
};
struct gpiod_edge_event_buffer {
  std::size_t capacity = 0;
  std::vector<gpiod_edge_event> events{};
};

namespace {

/// Counted, so that a test can see what is not freed.
template <class T, class... Arguments>
T* taken(Arguments... arguments) {
  ++fake_chips().objects;
  return new T{arguments...};
}

template <class T>
void given_back(T* object) {
  if (object != nullptr) --fake_chips().objects;
  delete object;
}

}  // namespace

gpiod_chip* gpiod_chip_open(const char* path) {
  FakeChip* const chip = open_fake_chip(path);
  if (chip == nullptr) return nullptr;
  ++fake_chips().open_chips;
  return new gpiod_chip{chip};
}
void gpiod_chip_close(gpiod_chip* chip) {
  --fake_chips().open_chips;
  delete chip;
}
gpiod_chip_info* gpiod_chip_get_info(gpiod_chip* chip) { return taken<gpiod_chip_info>(chip->chip); }
void gpiod_chip_info_free(gpiod_chip_info* info) { given_back(info); }
const char* gpiod_chip_info_get_name(gpiod_chip_info* info) { return info->chip->name.c_str(); }
const char* gpiod_chip_info_get_label(gpiod_chip_info* info) { return info->chip->label.c_str(); }
gpiod_line_info* gpiod_chip_get_line_info(gpiod_chip* chip, unsigned int offset) {
  if (offset < chip->chip->lines.size()) return taken<gpiod_line_info>(&chip->chip->lines[offset]);
  errno = EINVAL;
  return nullptr;
}
void gpiod_line_info_free(gpiod_line_info* info) { given_back(info); }
bool gpiod_line_info_is_used(gpiod_line_info* info) { return info->line->held_by_another || info->line->requested; }

gpiod_line_request* gpiod_chip_request_lines(gpiod_chip* chip, gpiod_request_config*, gpiod_line_config* config) {
  auto& lines = chip->chip->lines;
  for (const auto& [offset, settings] : config->lines) {
    errno = 0;
    if (offset >= lines.size()) errno = EINVAL;
    else if (lines[offset].held_by_another || lines[offset].requested) errno = EBUSY;
    else if (settings.edge != GPIOD_LINE_EDGE_NONE && !lines[offset].has_interrupt) errno = ENXIO;
    if (errno != 0) return nullptr;
  }
  gpiod_line_request* const request = taken<gpiod_line_request>(chip->chip);
  for (const auto& [offset, settings] : config->lines) {
    FakeLine& line = lines[offset];
    line.requested = true;
    line.active_low = settings.active_low;
    line.output = settings.direction == GPIOD_LINE_DIRECTION_OUTPUT;
    line.edges = settings.edge == GPIOD_LINE_EDGE_BOTH;
    if (line.output) line.level = (settings.value == GPIOD_LINE_VALUE_ACTIVE) != line.active_low;
    request->offsets.push_back(offset);
  }
  return request;
}

gpiod_line_settings* gpiod_line_settings_new(void) { return taken<gpiod_line_settings>(); }
void gpiod_line_settings_free(gpiod_line_settings* settings) { given_back(settings); }
int gpiod_line_settings_set_direction(gpiod_line_settings* settings, gpiod_line_direction direction) {
  settings->direction = direction;
  return 0;
}
int gpiod_line_settings_set_edge_detection(gpiod_line_settings* settings, gpiod_line_edge edge) {
  settings->edge = edge;
  return 0;
}
void gpiod_line_settings_set_active_low(gpiod_line_settings* settings, bool active_low) {
  settings->active_low = active_low;
}
int gpiod_line_settings_set_output_value(gpiod_line_settings* settings, gpiod_line_value value) {
  settings->value = value;
  return 0;
}
gpiod_line_config* gpiod_line_config_new(void) { return taken<gpiod_line_config>(); }
void gpiod_line_config_free(gpiod_line_config* config) { given_back(config); }
int gpiod_line_config_add_line_settings(gpiod_line_config* config, const unsigned int* offsets, size_t count,
                                        gpiod_line_settings* settings) {
  for (size_t i = 0; i < count; ++i) config->lines[offsets[i]] = *settings;
  return 0;
}
gpiod_request_config* gpiod_request_config_new(void) { return taken<gpiod_request_config>(); }
void gpiod_request_config_free(gpiod_request_config* config) { given_back(config); }
void gpiod_request_config_set_consumer(gpiod_request_config*, const char*) {}

void gpiod_line_request_release(gpiod_line_request* request) {
  for (const unsigned offset : request->offsets) {
    request->chip->lines[offset].requested = false;
    request->chip->lines[offset].queue.clear();
  }
  given_back(request);
}
gpiod_line_value gpiod_line_request_get_value(gpiod_line_request* request, unsigned int offset) {
  const FakeLine& line = request->chip->lines[offset];
  errno = line.broken ? EIO : 0;
  if (line.broken) return GPIOD_LINE_VALUE_ERROR;
  return line.active() ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
}
int gpiod_line_request_set_value(gpiod_line_request* request, unsigned int offset, gpiod_line_value value) {
  FakeLine& line = request->chip->lines[offset];
  errno = line.broken ? EIO : 0;
  if (line.broken) return -1;
  line.level = (value == GPIOD_LINE_VALUE_ACTIVE) != line.active_low;
  return 0;
}
int gpiod_line_request_wait_edge_events(gpiod_line_request* request, int64_t timeout_ns) {
  if (timeout_ns > 0 && fake_chips().on_wait) fake_chips().on_wait();
  return std::any_of(request->offsets.begin(), request->offsets.end(),
                     [&](unsigned offset) { return request->chip->edges_wait(offset); })
             ? 1
             : 0;
}
int gpiod_line_request_read_edge_events(gpiod_line_request* request, gpiod_edge_event_buffer* buffer, size_t most) {
  buffer->events.clear();
  for (const unsigned offset : request->offsets)
    for (auto& queue = request->chip->lines[offset].queue;
         !queue.empty() && buffer->events.size() < std::min(most, buffer->capacity); queue.pop_front())
      buffer->events.push_back({queue.front()});
  return static_cast<int>(buffer->events.size());
}
gpiod_edge_event_buffer* gpiod_edge_event_buffer_new(size_t capacity) {
  return taken<gpiod_edge_event_buffer>(capacity);
}
void gpiod_edge_event_buffer_free(gpiod_edge_event_buffer* buffer) { given_back(buffer); }
gpiod_edge_event* gpiod_edge_event_buffer_get_event(gpiod_edge_event_buffer* buffer, unsigned long index) {
  return &buffer->events.at(index);
}
gpiod_edge_event_type gpiod_edge_event_get_event_type(gpiod_edge_event* event) {
  return event->edge.rising ? GPIOD_EDGE_EVENT_RISING_EDGE : GPIOD_EDGE_EVENT_FALLING_EDGE;
}
uint64_t gpiod_edge_event_get_timestamp_ns(gpiod_edge_event* event) { return event->edge.time_ns; }
unsigned int gpiod_edge_event_get_line_offset(gpiod_edge_event* event) { return event->edge.offset; }
