#include "sim/desk/frame_script.h"

#include <fmt/format.h>

#include <algorithm>

#include "firmware/instrument/frame_event.h"
#include "sim/common/error.h"

namespace usuzumi::sim {
namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

std::vector<FrameEvent> parse_frame_script(const std::string& option, std::string_view text,
                                           std::span<const std::string_view> names) {
  std::vector<FrameEvent> events;
  for (const std::string_view part : split(text, ',')) {
    firmware::FrameEvent event;
    const bool read = firmware::read_frame_event(part, event);
    if (read && std::find(names.begin(), names.end(), event.name) != names.end()) {
      events.push_back({event.frame, std::string(event.name), event.level});
      continue;
    }
    throw Error(ExitCode::kUsage,
                fmt::format("{} {}: '{}' must be FRAME:NAME=0 or =1, e.g. 120:{}=1, with NAME one of {}", option, text,
                            part, names.front(), fmt::join(names, ", ")));
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const FrameEvent& a, const FrameEvent& b) { return a.frame < b.frame; });
  return events;
}

}  // namespace usuzumi::sim
