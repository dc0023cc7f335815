// The slots that records and tile lists are put in. Jobs on several threads take runs of slots from one counter;
// running out is ordinary: the round is rasterized and the pool starts anew.
#pragma once

#include <atomic>

#include "gfx_subsystem/engine_soft/records.h"

namespace usuzumi::gfx::soft {

class SlotPool {
 public:
  void reset(Slot* slots, std::uint32_t count) {
    slots_ = slots;
    count_ = count;
    used_.store(0, std::memory_order_relaxed);
  }
  void reuse() { used_.store(0, std::memory_order_relaxed); }

  /// First of `count` slots in a row, or kNone. A refusal uses nothing up for good: the round ends soon after.
  static constexpr std::uint32_t kNone = ~0u;
  std::uint32_t take(std::uint32_t count) {
    std::uint32_t at = used_.load(std::memory_order_relaxed);
    do {
      if (count > count_ - at) return kNone;
    } while (!used_.compare_exchange_weak(at, at + count, std::memory_order_relaxed));
    return at;
  }

  std::uint32_t capacity() const { return count_; }
  template <class Record>
  Record& at(std::uint32_t slot) { return *reinterpret_cast<Record*>(slots_ + slot); }
  template <class Record>
  const Record& at(std::uint32_t slot) const { return *reinterpret_cast<const Record*>(slots_ + slot); }

 private:
  Slot* slots_ = nullptr;
  std::uint32_t count_ = 0;
  std::atomic<std::uint32_t> used_{0};
};

}  // namespace usuzumi::gfx::soft
