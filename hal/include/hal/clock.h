// Time as the firmware sees it: a counter that only rises, and the wait for an interrupt.
#pragma once

#include <cstdint>

#include "hal/status.h"

namespace usuzumi {

/// What the CPU has just done, so that a simulated machine can charge virtual time for it. Boards ignore it: there the
/// time has passed. The unit is one item; the simulator's cost model states the cycles of each.
enum class CpuWork : std::uint8_t {
  kVertexCopied,      // one vertex read from ROM and written to the RAM copy
  kIndexCopied,       // one index
  kFaceMeasured,      // one face projected, clipped and added to the area on screen
  kConnectivityBuilt, // one face entered into the mesh connectivity
  kEdgeCosted,        // one edge's quadric error and placement evaluated
  kQueueOperation,    // one edge taken from the cost order, or put back into it
  kEdgeCollapsed,     // one edge collapse carried out
  kCornerReplayed,    // one corner of a face named another vertex by a replay of collapses
  kVertexMoved,       // one vertex put between two layers
  kCommandWritten,    // one command-list word
  kCount
};

class Clock {
 public:
  /// Nanoseconds since power-on.
  std::uint64_t now_ns() { return do_now_ns(); }
  /// Charges `count` items of work.
  void charge(CpuWork work, std::uint64_t count) { do_charge(work, count); }

 protected:
  ~Clock() = default;

 private:
  virtual std::uint64_t do_now_ns() = 0;
  virtual void do_charge(CpuWork work, std::uint64_t count) = 0;
};

/// Interrupt lines of the device (BOARD numbers differ; these are the firmware's).
enum class Interrupt : std::uint8_t { kEngineDone, kVerticalBlank, kDisplayFault, kCount };

class InterruptWaiter {
 public:
  /// Sleeps until `interrupt` is pending, acknowledges it at the controller and returns; kDeadlineExceeded after
  /// `timeout_us`. The device's own status flag stays set: its driver clears it.
  Status wait(Interrupt interrupt, std::uint32_t timeout_us) { return do_wait(interrupt, timeout_us); }

 protected:
  ~InterruptWaiter() = default;

 private:
  virtual Status do_wait(Interrupt interrupt, std::uint32_t timeout_us) = 0;
};

}  // namespace usuzumi
