// A progress bar on standard error: only on a terminal, only once the work has taken two seconds.
#pragma once

#include <chrono>
#include <string>

namespace usuzumi::sim {

class Progress {
 public:
  /// `label` says what is being done: "reading fish.obj".
  explicit Progress(std::string label);
  /// Wipes the bar.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Draws the bar at `fraction` (0..1). Cheap enough to call for every item.
  void update(double fraction);
  /// The same for work whose end is not known: a mark that moves with the time.
  void tick();

 private:
  bool due();
  void draw(const std::string& bar);

  std::string label_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point next_;
  bool terminal_;
  bool drawn_ = false;
};

}  // namespace usuzumi::sim
