// Wall-clock time of the host, for reports beside virtual time. Nothing in the machine ever looks at it.
#pragma once

#include <chrono>

namespace usuzumi::sim {

class HostStopwatch {
 public:
  HostStopwatch() : start_(std::chrono::steady_clock::now()) {}
  void restart() { start_ = std::chrono::steady_clock::now(); }
  double elapsed_ms() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_;
};

}  // namespace usuzumi::sim
