#include "firmware/instrument/frame_event.h"

#include <charconv>

namespace usuzumi::firmware {

bool read_frame_event(std::string_view text, FrameEvent& event) {
  const std::size_t colon = text.find(':'), equals = text.find('=');
  if (colon == text.npos || equals == text.npos || equals < colon) return false;
  const std::string_view frame = text.substr(0, colon), level = text.substr(equals + 1);
  event.name = text.substr(colon + 1, equals - colon - 1);
  event.level = level == "1";
  const auto [end, error] = std::from_chars(frame.data(), frame.data() + frame.size(), event.frame);
  return error == std::errc{} && end == frame.data() + frame.size() && (level == "0" || level == "1");
}

}  // namespace usuzumi::firmware
