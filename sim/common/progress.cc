#include "sim/common/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <condition_variable>
#include <cstddef>
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

}  // namespace

Clock::time_point end_of_patience() { return program_start + kPatience; }

Progress::Progress(std::string label, std::uint64_t steps, const ProgressScreen& screen)
    : label_(std::move(label)), steps_(steps), screen_(screen), start_(Clock::now()) {
  if (::isatty(screen_.fd) == 1) thread_ = std::jthread([this](const std::stop_token& stop) { show(stop); });
}

Progress::~Progress() = default;

void Progress::show(const std::stop_token& stop) const {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any wake;
  bool drawn = false;
  // Short work after the patience has ended is not worth a flicker.
  Clock::time_point next = std::max(screen_.from, start_ + kRedrawInterval);
  while (!wake.wait_until(lock, stop, next, [&] { return stop.stop_requested(); })) {
    const auto now = Clock::now();
    draw(now - start_);
    drawn = true;
    next = now + kRedrawInterval;
  }
  if (drawn) write_to(screen_.fd, "\r\x1b[K");
}

void Progress::draw(Clock::duration elapsed) const {
  std::string bar(kBarCells, '.');
  std::string tail = fmt::format("{} s", std::chrono::duration_cast<std::chrono::seconds>(elapsed).count());
  if (steps_ == 0) {
    bar[static_cast<std::size_t>(elapsed / kRedrawInterval) % kBarCells] = '#';
  } else {
    const std::uint64_t done = std::min(done_.load(std::memory_order_relaxed), steps_);
    std::fill_n(bar.begin(), done * kBarCells / steps_, '#');
    tail = fmt::format("{} of {}, ", done, steps_) + tail;
  }
  const std::string rest = fmt::format(" [{}] {}", bar, tail);
  const std::size_t room = columns_of(screen_.fd) - std::min(columns_of(screen_.fd), rest.size() + 1);
  // A line that wraps could not be wiped.
  write_to(screen_.fd, fmt::format("\r{}{}\x1b[K", std::string_view(label_).substr(0, room), rest));
}

}  // namespace usuzumi::sim
