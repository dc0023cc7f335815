// The display: Arm PrimeCell Color LCD Controller PL111 (DDI 0293), a TFT panel, one frame buffer at a time.
#pragma once

#include <cstdint>

#include "boards/cortex-a9/registers.h"
#include "hal/bus.h"
#include "hal/display.h"
#include "hal/status.h"

namespace usuzumi::boards::cortex_a9 {

class Pl111 {
 public:
  static constexpr std::uint32_t kMaxSize = 1024;  // pixels, either way
  static constexpr std::uint32_t kWidthUnit = 16;  // the register counts pixels in sixteens

  explicit constexpr Pl111(Registers registers) : registers_(registers) {}

  /// kInvalidArgument where the controller has no such mode.
  static Status check_mode(const Scanout& scanout);

  /// Of a mode that check_mode() accepts. Syncs run, the colour lines stay low: black, until the first send().
  void start(const Scanout& scanout);
  /// From the next frame on the picture at `base`, a multiple of 8. Call memory barriers before.
  void send(BusAddress base);
  /// Black at once, in mid-frame: the colour lines go low until the next send().
  void darken();
  /// The picture of the last send() is on its way, no other is being fetched.
  bool sent() const { return sent_; }

  /// The interrupt's handler.
  void on_interrupt();
  /// Vertical compares so far; it wraps.
  std::uint32_t vertical_compares() const { return vertical_compares_; }

  /// kUnavailable where the FIFO has run empty or the bus has refused a fetch since the last call.
  Status take_fault();

 private:
  Registers registers_;
  volatile bool sent_ = false;
  volatile std::uint32_t vertical_compares_ = 0;
};

}  // namespace usuzumi::boards::cortex_a9
