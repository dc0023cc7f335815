// How fast the panel follows the ignition: what a test, or a person with a console, wants to know of it.
#pragma once

#include <cstdint>
#include <string_view>

#include "boards/common/text_line.h"

namespace usuzumi::boards::cortex_a9 {

/// Is told of edges, light and pictures as they happen; times are of the board's clock. Interrupts are masked meanwhile.
class IgnitionTimes {
 public:
  struct Moment {
    std::uint64_t ns = 0;
    std::uint32_t vertical_compares = 0;
  };

  void ignition(bool on, const Moment& now);
  void light(bool on, const Moment& now);
  /// A picture has begun to be sent.
  void sent(bool black, const Moment& now);

  /// Once for each edge that has been followed, "ignition 0 light_us=4 black_us=21033 vcompares=2": from the edge to the
  /// light's going off and to black's being sent, and the vertical compares until then; or "ignition 1 light_us=61000
  /// vcompares=4": from the edge to the light, with the right picture. False where there is nothing new.
  bool take_line(TextLine& line);

 private:
  bool pending_ = false, on_ = false, lit_ = false, light_followed_ = false, black_followed_ = false;
  Moment edge_, light_, black_;
};

}  // namespace usuzumi::boards::cortex_a9
