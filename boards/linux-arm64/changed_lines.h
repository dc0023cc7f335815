// Which lines of the main loop are news. A service's log is kept for weeks: it wants what changed, not every frame.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace usuzumi::linux_arm64 {

class ChangedLines {
 public:
  /// Of a frame's line whether what is shown, mode, light or fault differ from those of the frame before; true of every
  /// other line.
  bool is_news(std::string_view line);

 private:
  std::array<char, 320> last_{};  // those words, as far as they fit
  std::size_t last_size_ = 0;
};

}  // namespace usuzumi::linux_arm64
