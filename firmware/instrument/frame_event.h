// What happens to an instrument at which frame, as text: "120:mode=1". For machines without pins of their own.
#pragma once

#include <cstdint>
#include <string_view>

namespace usuzumi::firmware {

/// From this frame on the line `name` is at this level.
struct FrameEvent {
  std::uint32_t frame = 0;
  std::string_view name;
  bool level = false;
};

/// One event, FRAME:NAME=0 or FRAME:NAME=1, FRAME in decimal digits. False, with `event` as it may be, for anything
/// else; the name is the caller's to check.
bool read_frame_event(std::string_view text, FrameEvent& event);

}  // namespace usuzumi::firmware
