#include "firmware/instrument/instrument.h"

namespace usuzumi::firmware {
namespace {

/// How long a dark instrument sleeps between looks at its pins: about a frame.
constexpr std::uint32_t kDarkSleepUs = 16'667;

}  // namespace

Status Instrument::boot(const InstrumentConfig& config) {
  pins_.set_backlight(false);
  lit_ = false;
  black_ = true;
  fault_ = ok_status();
  config_ = config;
  controls_ = {};
  booted_ = device_.boot(config.device);
  if (booted_.ok()) return booted_;
  read_pins();
  StepReport report;
  if (controls_.ignition()) show_fault(booted_, report);
  return booted_;
}

void Instrument::read_pins() {
  const PinInputs inputs = pins_.read();
  controls_.update(inputs, clock_.now_ns());
}

StepReport Instrument::step(const FrameRequest& request) {
  StepReport report;
  read_pins();
  if (!controls_.ignition()) stay_dark(report);
  else if (!fault_.ok() && clock_.now_ns() - safe_since_ns_ < kSafePictureNs) stay_safe(report);
  else draw(request, report);
  report.mode = draw_mode_of(after_presses(request.thinning, controls_.presses(), config_.budget));
  report.backlight = lit_;
  return report;
}

void Instrument::stay_dark(StepReport& report) {
  report.shown = Shown::kDark;
  fault_ = ok_status();  // the next ignition tries anew
  if (lit_) pins_.set_backlight(false);
  lit_ = false;
  if (black_) {
    pins_.wait_for_change(kDarkSleepUs);
    return;
  }
  // A display that does not answer is dark all the same: its light is off. The next ignition finds it out.
  report.fault = device_.blank();
  black_ = true;
}

void Instrument::draw(const FrameRequest& request, StepReport& report) {
  FrameRequest wanted = request;
  wanted.thinning = after_presses(request.thinning, controls_.presses(), config_.budget);
  Status status = booted_;
  if (status.ok()) status = display_.check();  // of the pictures sent so far
  if (status.ok()) status = device_.draw_picture(wanted, report.frame);
  read_pins();
  if (!controls_.ignition()) {
    stay_dark(report);
    return;
  }
  if (status.ok()) {
    black_ = false;  // even where it fails: the picture may come late
    status = device_.show_picture(report.frame);
  }
  if (status.ok()) {
    report.shown = Shown::kPicture;
    fault_ = ok_status();
    status = light(report);
  }
  if (!status.ok()) show_fault(status, report);
}

Status Instrument::light(StepReport& report) {
  if (lit_) return ok_status();
  Status status = device_.complete_picture();
  if (status.ok()) status = display_.check();  // it was sent whole, and unbroken
  if (!status.ok()) return status;
  read_pins();
  if (!controls_.ignition()) return status;  // it has gone off meanwhile; the next step is dark
  pins_.set_backlight(true);
  lit_ = true;
  report.wake_ns = clock_.now_ns() - controls_.ignition_on_ns();
  return status;
}

void Instrument::show_fault(const Status& fault, StepReport& report) {
  fault_ = report.fault = fault;
  safe_since_ns_ = clock_.now_ns();
  black_ = false;
  Status status = device_.show_safe_picture();
  if (status.ok()) {
    report.shown = Shown::kSafePicture;
    // The broken picture was sent until now; what it did to the display is told already.
    static_cast<void>(display_.check());
    status = light(report);
    if (status.ok()) return;
  }
  // Not even the safe picture reaches the panel: nothing is better than something wrong, and this is what to tell of.
  fault_ = report.fault = status;
  pins_.set_backlight(false);
  lit_ = false;
  report.shown = Shown::kDark;
}

/// Waits a frame. The safe picture stands; a display that failed with it stays dark.
void Instrument::stay_safe(StepReport& report) {
  report.fault = fault_;
  report.shown = lit_ ? Shown::kSafePicture : Shown::kDark;
  if (!lit_ || !device_.complete_picture().ok()) pins_.wait_for_change(kDarkSleepUs);
}

}  // namespace usuzumi::firmware
