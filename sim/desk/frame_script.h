// What happens to the simulated device at which frame: "0:ignition=1,120:mode=1".
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace usuzumi::sim {

/// From this frame on the line `name` is at this level.
struct FrameEvent {
  std::uint32_t frame = 0;
  std::string name;
  bool level = false;
  friend bool operator==(const FrameEvent&, const FrameEvent&) = default;
};

/// FRAME:NAME=0|1, parted by commas, sorted by frame; events of one frame keep their order. `names` are those allowed.
/// Throws Error kUsage that begins with `option`.
std::vector<FrameEvent> parse_frame_script(const std::string& option, std::string_view text,
                                           std::span<const std::string_view> names);

}  // namespace usuzumi::sim
