// A clock that only counts the work charged to it.
#pragma once

#include <array>

#include "hal/clock.h"

namespace usuzumi::testing {

class FakeClock final : public Clock {
 public:
  std::uint64_t charged(CpuWork work) const { return charged_[static_cast<std::size_t>(work)]; }

 private:
  std::uint64_t do_now_ns() override { return 0; }
  void do_charge(CpuWork work, std::uint64_t count) override { charged_[static_cast<std::size_t>(work)] += count; }

  std::array<std::uint64_t, static_cast<std::size_t>(CpuWork::kCount)> charged_{};
};

}  // namespace usuzumi::testing
