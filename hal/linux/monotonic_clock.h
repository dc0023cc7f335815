// Time since the kernel started, by CLOCK_MONOTONIC: it never falls and nobody sets it.
#pragma once

#include <cstdint>

namespace usuzumi::linux_hal {

std::uint64_t monotonic_now_ns();

}  // namespace usuzumi::linux_hal
