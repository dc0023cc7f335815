// A pseudo terminal for a progress bar to draw on.
#pragma once

#include <poll.h>
#include <pty.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <stdexcept>
#include <string>

#include "sim/common/progress.h"

namespace usuzumi::sim::testing {

/// A terminal and whoever looks at it.
class Terminal {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Terminal(unsigned short columns = 60) {
    const winsize size{.ws_row = 25, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
    if (::openpty(&outer_, &inner_, nullptr, nullptr, &size) != 0) throw std::runtime_error("no pseudo terminal");
  }
  ~Terminal() {
    ::close(outer_);
    ::close(inner_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  ProgressScreen screen(Clock::time_point from = Clock::now()) const { return {inner_, from}; }
  /// What has been shown up to the first `end`, or after half a minute without it.
  std::string shown_until(const std::string& end) { return read(std::chrono::seconds(30), end); }
  /// The first line drawn, from its return on and without the wiping of what was there before.
  std::string first_line() {
    const std::string erase_to_end = "\x1b[K", text = shown_until(erase_to_end);
    return text.substr(0, text.find(erase_to_end));
  }
  std::string shown_within(std::chrono::milliseconds time) { return read(time, ""); }

 private:
  std::string read(std::chrono::milliseconds time, const std::string& end) {
    std::string text;
    const auto deadline = Clock::now() + time;
    while ((end.empty() || text.find(end) == std::string::npos) && Clock::now() < deadline) {
      pollfd readable{outer_, POLLIN, 0};
      if (::poll(&readable, 1, 10) <= 0) continue;
      std::array<char, 256> block;
      const ssize_t n = ::read(outer_, block.data(), block.size());
      if (n > 0) text.append(block.data(), static_cast<std::size_t>(n));
    }
    return text;
  }
  int outer_ = -1, inner_ = -1;
};

}  // namespace usuzumi::sim::testing
