#include "sim/common/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <utility>

namespace usuzumi::sim {
namespace {

constexpr auto kQuietTime = std::chrono::seconds(2);
constexpr auto kRedrawInterval = std::chrono::milliseconds(100);
constexpr std::size_t kBarCells = 30;

}  // namespace

Progress::Progress(std::string label)
    : label_(std::move(label)),
      start_(std::chrono::steady_clock::now()),
      next_(start_ + kQuietTime),
      terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
}

bool Progress::due() {
  if (!terminal_) return false;
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return false;
  next_ = now + kRedrawInterval;
  return true;
}

void Progress::draw(const std::string& bar) {
  drawn_ = true;
  fmt::print(stderr, "\r{} [{}]\x1b[K", label_, bar);
  std::fflush(stderr);
}

void Progress::update(double fraction) {
  if (!due()) return;
  const double clamped = std::clamp(fraction, 0.0, 1.0);
  const auto cells = static_cast<std::size_t>(clamped * static_cast<double>(kBarCells));
  draw(std::string(cells, '#') + std::string(kBarCells - cells, '.') + fmt::format("] [{:3.0f} %", clamped * 100));
}

void Progress::tick() {
  if (!due()) return;
  std::string bar(kBarCells, '.');
  const auto elapsed = std::chrono::steady_clock::now() - start_;
  bar[static_cast<std::size_t>(elapsed / kRedrawInterval) % kBarCells] = '#';
  draw(bar);
}

}  // namespace usuzumi::sim
