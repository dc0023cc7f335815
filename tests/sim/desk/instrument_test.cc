// The instrument on the simulated machine: what the panel shows, when, and with the light on or off.
#include "firmware/instrument/instrument.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "firmware/device/turntable.h"
#include "gfx_subsystem/engine_soft/soft_engine.h"
#include "hal/drivers/controller_display.h"
#include "sim/machine/machine.h"
#include "sim/panel/panel.h"
#include "tests/support/test_meshes.h"

namespace usuzumi {
namespace {

using firmware::DrawMode;
using firmware::Instrument;
using firmware::Shown;
using firmware::StepReport;

constexpr std::uint32_t kWidth = 160, kHeight = 96;

/// Pins that a test moves, and the moments at which the light changes.
class TestPins final : public Pins {
 public:
  explicit TestPins(sim::Machine& machine) : machine_(machine) {}

  PinInputs inputs;
  bool light = false;
  std::uint64_t light_changed = 0;  // master cycles
  /// Turns the ignition off after so many more reads; for a driver who does it while a picture is being drawn.
  int reads_until_off = -1;

 private:
  PinInputs do_read() override {
    if (reads_until_off == 0) inputs.ignition = false;
    if (reads_until_off >= 0) --reads_until_off;
    return inputs;
  }
  void do_set_backlight(bool on) override {
    if (on != light) light_changed = machine_.now_cycles();
    light = on;
  }
  void do_wait_for_change(std::uint32_t timeout_us) override { machine_.idle(sim::cycles_from_us(timeout_us)); }

  sim::Machine& machine_;
};

struct SeenFrame {
  std::uint64_t complete = 0;  // master cycles
  std::uint32_t crc = 0;
  bool light = false;
};

class InstrumentOnMachine : public ::testing::Test {
 protected:
  InstrumentOnMachine() {
    panel.on_frame([this](const sim::PanelFrame& frame) {
      seen.push_back({machine.now_cycles(), frame.crc32(), pins.light});
    });
    config.device.width = kWidth;
    config.device.height = kHeight;
    pins.inputs.ignition = true;
  }
  void boot() {
    const Status status = instrument.boot(config);
    ASSERT_TRUE(status.ok()) << status.message;
  }
  firmware::FrameRequest request(std::uint32_t frame = 0) const {
    const float aspect = static_cast<float>(kWidth) / kHeight;
    const auto bounds = firmware::bounds_of(instrument.device().drawing_data());
    return firmware::lit_request(firmware::turntable_camera(bounds, frame, 60, aspect), aspect, rgba8(10, 20, 30));
  }
  StepReport step(std::uint32_t frame = 0) { return instrument.step(request(frame)); }
  std::uint64_t frame_ticks() const { return make_display_mode(kWidth, kHeight)->frame_ticks(); }
  /// Of the display's bus, to half of what the lines of the picture take while they are sent.
  static double starving_slowdown() {
    const auto mode = *make_display_mode(kWidth, kHeight);
    const double line_bytes_per_second = 4.0 * kWidth * mode.pixel_clock_hz() / mode.line_pixels();
    return 3.2e9 / (line_bytes_per_second / 2);
  }
  /// The same instrument with other drawing data.
  Instrument instrument_with(std::span<const std::byte> rom_bytes) {
    return Instrument({.registers = machine,
                       .engine_base = sim::kEngineBase,
                       .interrupts = machine,
                       .display = display,
                       .clock = machine,
                       .memory = machine,
                       .bus = machine,
                       .rom = rom_bytes,
                       .ram = machine.ram(),
                       .vram_base = sim::kVramBase,
                       .vram_bytes = static_cast<std::uint32_t>(machine.vram().size())},
                      pins);
  }
  /// What the panel shows once everything sent so far has arrived.
  std::uint32_t settled_crc() {
    machine.idle(2 * frame_ticks());
    return seen.back().crc;
  }
  static std::uint32_t black_crc() { return picture_crc32(sim::Image(kWidth, kHeight)); }

  testing::RomImage rom = testing::container_rom({testing::hills(24, 3)});
  std::vector<std::byte> work = std::vector<std::byte>(8 << 20);
  gfx::SoftEngine engine{{.work_memory = work}};
  sim::Panel panel;
  sim::Machine machine{sim::host_sim(), rom.bytes(), engine, panel};
  ControllerDisplay display{machine, sim::kDisplayBase, machine};
  TestPins pins{machine};
  Instrument instrument = instrument_with(machine.rom());
  firmware::InstrumentConfig config;
  std::vector<SeenFrame> seen;
};

TEST_F(InstrumentOnMachine, TheLightComesOnOnlyOverWholeCorrectPictures) {
  boot();
  std::set<std::uint32_t> correct;
  for (std::uint32_t frame = 0; frame < 12; ++frame) {
    pins.inputs.ignition = frame % 5 != 3;
    const StepReport report = step(frame);
    if (report.shown != Shown::kPicture) continue;
    correct.insert(settled_crc());
    step(frame);  // the same again, so that every picture is seen at leisure as well
  }
  EXPECT_GE(correct.size(), 5u);
  for (const SeenFrame& f : seen) {
    if (!f.light) continue;
    EXPECT_EQ(correct.count(f.crc), 1u) << "lit at " << f.complete << " and not a picture of the model";
  }
}

TEST_F(InstrumentOnMachine, IgnitionOffIsDarkAtOnceAndBlackWithinAFrame) {
  boot();
  for (std::uint32_t phase = 0; phase < 8; ++phase) {  // wherever the beam is
    pins.inputs.ignition = true;
    step();
    machine.idle(frame_ticks() * phase / 8);
    pins.inputs.ignition = false;
    const std::uint64_t off = machine.now_cycles();
    const StepReport report = step();
    EXPECT_EQ(report.shown, Shown::kDark);
    EXPECT_FALSE(report.backlight);
    EXPECT_LT(pins.light_changed - off, sim::cycles_from_us(10));
    EXPECT_LE(machine.now_cycles() - off, frame_ticks() + sim::cycles_from_us(20)) << "black is being sent by now";
    EXPECT_EQ(settled_crc(), black_crc());
    const std::size_t first = seen.size();
    step();
    machine.idle(2 * frame_ticks());
    for (std::size_t i = first; i < seen.size(); ++i) EXPECT_EQ(seen[i].crc, black_crc());
  }
}

TEST_F(InstrumentOnMachine, IgnitionOffWhileAPictureIsDrawnLeavesItUnshown) {
  boot();
  step();
  pins.reads_until_off = 1;  // the first read of the step still sees it on
  const StepReport report = step(7);
  EXPECT_EQ(report.shown, Shown::kDark);
  EXPECT_GT(report.frame.draw_ns, 0u) << "the picture was drawn";
  EXPECT_EQ(settled_crc(), black_crc());
}

TEST_F(InstrumentOnMachine, IgnitionOffWhileTheFirstPictureIsSentLeavesItUnlitAndThenBlack) {
  boot();
  pins.reads_until_off = 2;  // at the step's beginning and after the drawing it is on, before the light it is off
  EXPECT_FALSE(step().backlight);
  EXPECT_EQ(pins.light_changed, 0u) << "no flash";
  EXPECT_EQ(step().shown, Shown::kDark);
  EXPECT_EQ(settled_crc(), black_crc());
}

TEST_F(InstrumentOnMachine, WakesWithinTwoFramesAndTheDrawingOfOne) {
  boot();
  const StepReport cold = step();
  const std::uint64_t frame_ns = sim::ns_from_cycles(frame_ticks());
  EXPECT_GT(cold.wake_ns, 0u);
  // Two frames, the drawing, and some register accesses.
  EXPECT_LE(cold.wake_ns, Instrument::kWakeFrames * frame_ns + cold.frame.thin_ns + cold.frame.draw_ns + 20'000);
  const std::uint32_t picture = settled_crc();
  for (std::uint32_t phase = 0; phase < 8; ++phase) {
    pins.inputs.ignition = false;
    step();
    machine.idle(frame_ticks() * phase / 8);
    pins.inputs.ignition = true;
    const std::uint64_t on = machine.now_cycles();
    const StepReport report = step();
    EXPECT_EQ(report.shown, Shown::kPicture);
    EXPECT_EQ(report.frame.thinning.cause, firmware::UpdateCause::kUnchanged) << "state was kept";
    const std::uint64_t lit = sim::ns_from_cycles(pins.light_changed - on);
    EXPECT_NEAR(static_cast<double>(lit), static_cast<double>(report.wake_ns), 1000.0);
    EXPECT_LE(lit, Instrument::kWakeFrames * frame_ns + report.frame.draw_ns + 20'000);
    EXPECT_EQ(settled_crc(), picture);
  }
}

TEST_F(InstrumentOnMachine, TheButtonCyclesFullThinnedBudget) {
  boot();
  config.budget = {firmware::format::QuotaKind::kMillionths, 250'000};
  const struct {
    DrawMode mode;
    std::uint64_t faces;  // of 1152, half by default
  } steps[] = {{DrawMode::kThinned, 576}, {DrawMode::kBudget, 288}, {DrawMode::kFull, 1152}, {DrawMode::kThinned, 576}};
  for (const auto& expected : steps) {
    const StepReport report = step();
    EXPECT_EQ(report.mode, expected.mode);
    EXPECT_EQ(report.frame.thinning.faces_out, expected.faces);
    pins.inputs.mode_button = false;
    machine.idle(sim::cycles_from_us(100'000));
    step();
    pins.inputs.mode_button = true;
  }
}

TEST_F(InstrumentOnMachine, AHungEngineShowsTheSafePictureAndDrawingIsTriedAgainLater) {
  boot();
  step();
  const std::uint32_t picture = settled_crc();
  machine.inject({.engine_hangs = true});
  const StepReport broken = step();
  EXPECT_EQ(broken.shown, Shown::kSafePicture);
  EXPECT_EQ(broken.fault.code, StatusCode::kDeadlineExceeded);
  EXPECT_TRUE(broken.backlight);
  const std::uint32_t safe = settled_crc();
  EXPECT_NE(safe, picture);
  EXPECT_NE(safe, black_crc());
  machine.inject({});
  const std::uint64_t since = machine.now_cycles();
  StepReport report = step();
  EXPECT_EQ(report.shown, Shown::kSafePicture) << "for a second, lest it flicker";
  EXPECT_EQ(report.fault.code, StatusCode::kDeadlineExceeded);
  EXPECT_EQ(settled_crc(), safe);
  while (report.shown != Shown::kPicture && machine.now_cycles() - since < 2 * sim::kMasterHz) report = step();
  EXPECT_EQ(report.shown, Shown::kPicture);
  EXPECT_TRUE(report.fault.ok());
  EXPECT_EQ(settled_crc(), picture);
}

TEST_F(InstrumentOnMachine, ABusTooSlowForThePictureIsFastEnoughForTheSafeOne) {
  boot();
  step();
  const std::uint32_t picture = settled_crc();
  machine.inject({.bus_slowdown = starving_slowdown()});
  step(1);
  machine.idle(2 * frame_ticks());
  const StepReport report = step(2);
  EXPECT_EQ(report.shown, Shown::kSafePicture);
  EXPECT_EQ(report.fault.code, StatusCode::kUnavailable) << report.fault.message;
  const std::uint32_t safe = settled_crc();
  const std::uint64_t starved = machine.display().starved_lines();
  EXPECT_EQ(step(3).shown, Shown::kSafePicture);
  EXPECT_EQ(settled_crc(), safe);
  EXPECT_EQ(machine.display().starved_lines(), starved) << "the safe picture gets all its pixels";
  EXPECT_NE(safe, picture);
  machine.inject({});
  machine.idle(sim::kMasterHz + 2 * frame_ticks());
  EXPECT_EQ(step(0).shown, Shown::kPicture);
  EXPECT_EQ(settled_crc(), picture);
}

TEST_F(InstrumentOnMachine, IgnitionOffAndOnEndsTheSafePictureAtOnce) {
  boot();
  machine.inject({.engine_hangs = true});
  EXPECT_EQ(step().shown, Shown::kSafePicture);
  machine.inject({});
  pins.inputs.ignition = false;
  EXPECT_EQ(step().shown, Shown::kDark);
  EXPECT_FALSE(pins.light);
  pins.inputs.ignition = true;
  EXPECT_EQ(step().shown, Shown::kPicture);
  EXPECT_TRUE(pins.light);
}

TEST_F(InstrumentOnMachine, ABootWithoutGoodDrawingDataShowsTheSafePicture) {
  std::vector<std::byte> nothing(64);
  Instrument broken = instrument_with(nothing);
  EXPECT_EQ(broken.boot(config).code, StatusCode::kDataLoss);
  EXPECT_TRUE(pins.light);
  const std::uint32_t shown = settled_crc();
  EXPECT_NE(shown, black_crc());
  pins.inputs.ignition = false;
  EXPECT_EQ(broken.step({}).shown, Shown::kDark);
  pins.inputs.ignition = true;
  EXPECT_EQ(broken.step({}).shown, Shown::kSafePicture) << "there is still nothing to draw";
  EXPECT_EQ(settled_crc(), shown);
}

TEST_F(InstrumentOnMachine, ABootWithoutGoodDrawingDataShowsTheSafePictureToALaterIgnitionToo) {
  std::vector<std::byte> nothing(64);
  Instrument broken = instrument_with(nothing);
  pins.inputs.ignition = false;
  EXPECT_EQ(broken.boot(config).code, StatusCode::kDataLoss);
  EXPECT_EQ(broken.step({}).shown, Shown::kDark);
  EXPECT_FALSE(pins.light);
  pins.inputs.ignition = true;
  const StepReport report = broken.step({});
  EXPECT_EQ(report.shown, Shown::kSafePicture);
  EXPECT_EQ(report.fault.code, StatusCode::kDataLoss) << "what the boot came to: " << report.fault.message;
  EXPECT_TRUE(pins.light);
  EXPECT_NE(settled_crc(), black_crc());
}

TEST_F(InstrumentOnMachine, APictureThatTheBusIsTooSlowForIsNeverLit) {
  const double slowdown = starving_slowdown();
  machine.inject({.bus_slowdown = slowdown});
  boot();
  const StepReport report = step();
  EXPECT_EQ(report.shown, Shown::kSafePicture);
  EXPECT_EQ(report.fault.code, StatusCode::kUnavailable) << report.fault.message;
  EXPECT_TRUE(report.backlight);
  const std::uint32_t safe = settled_crc();
  for (const SeenFrame& f : seen) EXPECT_TRUE(!f.light || f.crc == safe) << f.complete;
}

TEST_F(InstrumentOnMachine, WhereEvenTheSafePictureBreaksThePanelIsDark) {
  machine.inject({.bus_slowdown = 100 * starving_slowdown()});
  boot();
  const StepReport report = step();
  EXPECT_EQ(report.shown, Shown::kDark);
  EXPECT_FALSE(pins.light);
  EXPECT_EQ(report.fault.code, StatusCode::kUnavailable);
  for (const SeenFrame& f : seen) EXPECT_FALSE(f.light);
}

TEST_F(InstrumentOnMachine, WithTheIgnitionOffABootStaysDark) {
  pins.inputs.ignition = false;
  boot();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(step().shown, Shown::kDark);
  EXPECT_FALSE(pins.light);
  EXPECT_FALSE(machine.display().running()) << "nothing is sent that nobody sees";
}

TEST_F(InstrumentOnMachine, NothingItDoesIsAGuestMistake) {
  boot();
  for (std::uint32_t frame = 0; frame < 8; ++frame) {
    pins.inputs.ignition = frame != 3;
    if (frame == 5) machine.inject({.engine_hangs = true});
    step(frame);
  }
  EXPECT_EQ(machine.guest_log().mistakes(), 0u);
}

}  // namespace
}  // namespace usuzumi
