#include "hal/linux/monotonic_clock.h"

#include <time.h>

namespace usuzumi::linux_hal {

std::uint64_t monotonic_now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);  // cannot fail: the clock exists wherever Linux runs
  return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000u + static_cast<std::uint64_t>(now.tv_nsec);
}

}  // namespace usuzumi::linux_hal
