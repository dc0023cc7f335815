// How fast the panel follows the ignition: what a test, or a person with a console, wants to know of it.
#pragma once

#include <cstdint>

#include "boards/common/text_line.h"

namespace usuzumi::boards::cortex_a9 {

/// Is told of edges, light and pictures as they happen; times are of the board's clock. Interrupts are masked
/// meanwhile.
class IgnitionTimes {
 public:
  struct Moment {
    std::uint64_t ns = 0;
    std::uint32_t vertical_compares = 0;
  };

  void ignition(bool on, const Moment& now);
  void light(bool on, const Moment& now);
  /// A picture has been drawn and is handed to the display.
  void handed(bool black, const Moment& now);
  /// It has begun to be sent.
  void sent(bool black, const Moment& now);

  /// Once for each edge that has been followed, "ignition 0 light_us=4 black_us=21033 vcompares=1": from the edge until
  /// the light was off and until black was sent; or "ignition 1 light_us=61000 vcompares=2": from the edge until the
  /// light was on. Vertical compares count from when the picture was drawn. False where there is nothing new.
  bool take_line(TextLine& line);

 private:
  /// What follows an edge, in the order in which it comes: off, then handed, then sent; or handed, then lit.
  enum class Stage : std::uint8_t { kNone, kEdge, kHanded, kFollowed };

  bool on_ = false, lit_ = false;
  Stage stage_ = Stage::kNone;
  Moment edge_, light_, handed_, sent_;
};

}  // namespace usuzumi::boards::cortex_a9
