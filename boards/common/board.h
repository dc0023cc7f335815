// What a port writes for its board: five functions. The rest has defaults that are right, if not the best, everywhere.
#pragma once

#include <cstdint>
#include <string_view>

#include "hal/clock.h"
#include "hal/display.h"
#include "hal/pins.h"

namespace usuzumi::boards {

/// To write:
///
///   do_now_ns()             time since power-on, from a timer that never falls        (hal/clock.h)
///   do_start(scanout)       the display's mode; the panel stays black                 (hal/display.h)
///   do_show(picture, part)  the picture to send from the next vertical blank on       (hal/display.h)
///   do_read()               ignition and mode button                                  (hal/pins.h)
///   do_set_backlight(on)                                                              (hal/pins.h)
///
/// Worth writing later: do_print, for the lines below; do_wait_for_change, to sleep; do_check, for a display that can
/// tell of faults; do_stride_bytes, for one that wants other rows than multiples of 64 bytes; do_stop_wanted, for a
/// program that an operating system ends.
class Board : public Clock, public Pins, public Display {
 public:
  /// What happens, for a person or for a test: whole lines, each with its '\n'.
  void print(std::string_view line) { do_print(line); }
  /// After each step's line: where a test holds the board to look at its panel.
  void step_done() { do_step_done(); }
  /// Asked after each step: the main loop then ends as it does after its last frame.
  bool stop_wanted() { return do_stop_wanted(); }

 protected:
  ~Board() = default;

 private:
  virtual void do_print(std::string_view) {}
  virtual void do_step_done() {}
  virtual bool do_stop_wanted() { return false; }
  void do_charge(CpuWork, std::uint64_t) final {}  // on a board the time has passed
};

}  // namespace usuzumi::boards
