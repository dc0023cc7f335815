// The instrument: the drawing device with its pins. Dark while the ignition is off, the mode of the button while it is
// on, the safe picture while something is broken.
#pragma once

#include <cstdint>

#include "firmware/device/device.h"
#include "firmware/instrument/controls.h"
#include "firmware/instrument/draw_mode.h"
#include "hal/pins.h"
#include "hal/status.h"

namespace usuzumi::firmware {

struct InstrumentConfig {
  DeviceConfig device;
  Quota budget{format::QuotaKind::kMillionths, 250'000};  // of DrawMode::kBudget where a request has none
};

/// What the panel shows after a step.
enum class Shown : std::uint8_t { kPicture, kDark, kSafePicture };

constexpr const char* shown_name(Shown shown) {
  switch (shown) {
    case Shown::kPicture: return "picture";
    case Shown::kDark: return "dark";
    case Shown::kSafePicture: return "safe";
  }
  return "shown out of range";
}

struct StepReport {
  Shown shown = Shown::kDark;
  DrawMode mode = DrawMode::kThinned;  // that the button has come to
  bool backlight = false;
  FrameReport frame;          // all zeros where nothing was drawn
  Status fault;               // why the safe picture is shown
  std::uint64_t wake_ns = 0;  // from ignition on to light on, in the step that did it; 0 in all others
};

/// Pins are read as a step begins, when its picture is drawn, and before the light goes on, so that the instrument
/// follows them within a frame, or within the drawing of one where that takes longer.
///
/// Ignition off: the backlight goes off as soon as the pins are read, the display is black from the next vertical blank
/// on (a board whose pins interrupt can do both at once, amid a drawing); drawing data, thinned copy and mode stay as
/// they are. Ignition on: the backlight comes on once the first picture has been sent whole, and unbroken, so that
/// nothing but correct pictures is ever lit. That takes the drawing of one picture (after boot with its thinning) and
/// at most kWakeFrames frames of the display.
///
/// A fault shows the safe picture: at the end of the step that finds it. A hung engine is found after
/// DeviceConfig::engine_timeout_us, a display that runs dry in the step after.
class Instrument {
 public:
  static constexpr std::uint32_t kWakeFrames = 2;
  /// A fault's safe picture stays at least so long before drawing is tried again, lest it flicker.
  static constexpr std::uint64_t kSafePictureNs = 1'000'000'000;

  Instrument(const DevicePorts& ports, Pins& pins)
      : device_(ports), display_(ports.display), clock_(ports.clock), pins_(pins) {}

  /// Dark until the first step. Where it fails for want of good drawing data or memory, with the ignition on, the safe
  /// picture is shown and lit if the display works; steps then follow the ignition with it.
  Status boot(const InstrumentConfig& config);

  /// One turn of the main loop: draws and shows `request`, its thinning stepped on by the button's presses, or what the
  /// pins or a fault demand instead. Every turn takes a frame of the display, or a wait of about that length.
  StepReport step(const FrameRequest& request);

  const Device& device() const { return device_; }

 private:
  void read_pins();
  void stay_dark(StepReport& report);
  void draw(const FrameRequest& request, StepReport& report);
  void show_fault(const Status& fault, StepReport& report);
  void stay_safe(StepReport& report);
  /// Lights the panel once what it shows has been sent whole.
  Status light(StepReport& report);

  Device device_;
  Display& display_;
  Clock& clock_;
  Pins& pins_;
  InstrumentConfig config_;
  Controls controls_;
  bool lit_ = false;
  bool black_ = true;               // the display has been sent nothing since boot, or nothing but black
  Status booted_;                   // what boot() came to
  Status fault_;                    // while the safe picture is shown
  std::uint64_t safe_since_ns_ = 0;
};

}  // namespace usuzumi::firmware
