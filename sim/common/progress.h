// A progress bar on standard error: only on a terminal, only once the user has waited for two seconds.
#pragma once

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <stop_token>
#include <string>
#include <thread>

namespace usuzumi::sim {

/// Two seconds after the program's start.
std::chrono::steady_clock::time_point end_of_patience();

/// Where a bar is drawn and from when on; tests bring terminals of their own.
struct ProgressScreen {
  int fd = STDERR_FILENO;
  std::chrono::steady_clock::time_point from = end_of_patience();
};

/// Draws itself from a thread of its own, so that one long step shows as well as many short ones.
/// It is a decoration: where there is no thread or no memory for it, the work goes on without.
/// The thread does not survive a fork: make it after, not before.
class Progress {
 public:
  /// `label` says what is being done: "reading fish.obj". `steps` is how many there are, 0 where nobody knows.
  explicit Progress(std::string label, std::uint64_t steps = 0, const ProgressScreen& screen = {});
  /// Wipes the bar.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One more step is done.
  void step() { done_.fetch_add(1, std::memory_order_relaxed); }

 private:
  void show(const std::stop_token& stop) const noexcept;
  void draw(std::chrono::steady_clock::duration elapsed) const;

  const std::string label_;
  const std::uint64_t steps_;
  const ProgressScreen screen_;
  const std::chrono::steady_clock::time_point start_;
  std::atomic<std::uint64_t> done_ = 0;
  std::jthread thread_;  // last: it looks at the others
};

}  // namespace usuzumi::sim
