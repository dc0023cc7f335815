#include "sim/common/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <string_view>
#include <utility>

namespace usuzumi::sim {
namespace {

using Clock = std::chrono::steady_clock;

const Clock::time_point program_start = Clock::now();

constexpr auto kPatience = std::chrono::seconds(2);
constexpr auto kRedrawInterval = std::chrono::milliseconds(100);
constexpr std::size_t kBarCells = 30;
constexpr std::size_t kUsualColumns = 80;

/// Past the formatted streams: the thread shares none of their locks with the work.
void write_to(int fd, std::string_view text) {
  [[maybe_unused]] const ssize_t written = ::write(fd, text.data(), text.size());
}

std::size_t columns_of(int fd) {
  winsize size{};
  return ::ioctl(fd, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : kUsualColumns;
}

/// At most `most` bytes of UTF-8 text, and no half character. A character takes at least as many bytes as columns.
std::string_view cut(std::string_view text, std::size_t most) {
  if (text.size() <= most) return text;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xc0) == 0x80) --most;
  return text.substr(0, most);
}

/// Gives up the bar before the label's end, and that before the numbers.
std::string fit(std::string_view label, const std::string& bar, const std::string& numbers, std::size_t room) {
  std::string rest = fmt::format(" [{}] {}", bar, numbers);
  if (rest.size() > room) rest = " " + numbers;
  return std::string(cut(fmt::format("{}{}", cut(label, room - std::min(room, rest.size())), rest), room));
}

}  // namespace

Clock::time_point end_of_patience() { return program_start + kPatience; }

Progress::Progress(std::string label, std::uint64_t steps, const ProgressScreen& screen)
    : label_(std::move(label)), steps_(steps), screen_(screen), start_(Clock::now()) {
  if (::isatty(screen_.fd) != 1) return;
  try {
    thread_ = std::jthread([this](const std::stop_token& stop) { show(stop); });
  } catch (const std::exception&) {
    // No thread or no memory to be had: the work may still succeed, and says so itself if it cannot.
  }
}

Progress::~Progress() = default;

void Progress::show(const std::stop_token& stop) const noexcept {
  bool drawn = false;
  try {
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any wake;
    // Short work after the patience has ended is not worth a flicker.
    Clock::time_point next = std::max(screen_.from, start_ + kRedrawInterval);
    while (!wake.wait_until(lock, stop, next, [&] { return stop.stop_requested(); })) {
      const auto now = Clock::now();
      draw(now - start_);
      drawn = true;
      next = now + kRedrawInterval;
    }
  } catch (const std::exception&) {
    // No memory for another line: on without a bar.
  }
  if (drawn) write_to(screen_.fd, "\r\x1b[K");
}

void Progress::draw(Clock::duration elapsed) const {
  std::string bar(kBarCells, '.');
  std::string numbers = fmt::format("{} s", std::chrono::duration_cast<std::chrono::seconds>(elapsed).count());
  if (steps_ == 0) {
    bar[static_cast<std::size_t>(elapsed / kRedrawInterval) % kBarCells] = '#';
  } else {
    const std::uint64_t done = std::min(done_.load(std::memory_order_relaxed), steps_);
    std::fill_n(bar.begin(), done * kBarCells / steps_, '#');
    numbers = fmt::format("{} of {}, ", done, steps_) + numbers;
  }
  // A line that wraps could not be wiped, and many terminals wrap once the last column is filled.
  const std::size_t room = columns_of(screen_.fd) - 1;
  write_to(screen_.fd, fmt::format("\r{}\x1b[K", fit(label_, bar, numbers, room)));
}

}  // namespace usuzumi::sim
