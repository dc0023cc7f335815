// The instrument's pins on the desk: inputs after a script, the backlight to be looked at.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "hal/pins.h"
#include "sim/desk/frame_script.h"
#include "sim/machine/machine.h"

namespace usuzumi::sim {

inline constexpr std::string_view kPinNames[] = {"ignition", "mode"};

class ScriptedPins final : public Pins {
 public:
  /// All low at first; the script's names are kPinNames. Without a script the ignition is on, the button up, for good.
  /// A wait lets the machine's time pass.
  ScriptedPins(Machine& machine, const std::vector<FrameEvent>* script)
      : machine_(machine), script_(script == nullptr ? std::vector<FrameEvent>{} : *script) {
    levels_.ignition = script == nullptr;
  }

  /// Sets the lines as the script has them at this frame. Frames come in rising order.
  void begin_frame(std::uint32_t frame);

  bool backlight() const { return backlight_; }

 private:
  PinInputs do_read() override;
  void do_set_backlight(bool on) override { backlight_ = on; }
  void do_wait_for_change(std::uint32_t timeout_us) override { machine_.idle(cycles_from_us(timeout_us)); }

  Machine& machine_;
  std::vector<FrameEvent> script_;
  std::size_t next_ = 0;
  PinInputs levels_;
  bool pressed_since_read_ = false;
  bool backlight_ = false;
};

}  // namespace usuzumi::sim
