// The display driver: what it writes, by literal offsets, into a block that only remembers; what it does with a real
// controller behind it; and the modes it makes.
#include "hal/drivers/display_driver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "gfx_subsystem/display/display_controller.h"

namespace usuzumi {
namespace {

using ::testing::HasSubstr;
using ::testing::UnorderedElementsAreArray;
using Writes = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

constexpr BusAddress kBase = 0xF0001000;

/// Registers that keep what is written, and the list of writes.
class Notebook final : public RegisterIo {
 public:
  std::map<std::uint32_t, std::uint32_t> values{{0x000, 0x31434455}};
  Writes writes;
  std::uint32_t last(std::uint32_t offset) { return values[offset]; }

 private:
  std::uint32_t do_read32(BusAddress address) override { return values[address - kBase]; }
  void do_write32(BusAddress address, std::uint32_t value) override {
    values[address - kBase] = value;
    writes.emplace_back(address - kBase, value);
  }
};

struct Written {
  Notebook io;
  DisplayDriver driver{io, kBase};

  /// All writes lie between taking the lock and giving it back.
  void expect_locked() {
    ASSERT_GE(io.writes.size(), 2u);
    EXPECT_EQ(io.writes.front(), (std::pair<std::uint32_t, std::uint32_t>{0x038, 1}));
    EXPECT_EQ(io.writes.back(), (std::pair<std::uint32_t, std::uint32_t>{0x038, 0}));
  }
};

TEST(DisplayDriver, ProbeLooksForTheIdentity) {
  Written w;
  EXPECT_TRUE(w.driver.probe().ok());
  w.io.values[0x000] = 0x44335A55;
  EXPECT_EQ(w.driver.probe().code, StatusCode::kUnavailable);
}

TEST(DisplayDriver, SetModeWritesEveryTimingValueMinusOne) {
  Written w;
  w.io.values[0x100] = 0x810F0000;
  ASSERT_TRUE(w.driver.set_mode(kMode480x272).ok());
  w.expect_locked();
  // 480 + 2 + 41 + 2 = 525 pixels; 272 + 4 + 10 + 2 = 288 lines; 400 MHz / 44.
  EXPECT_EQ(w.io.last(0x004), 524u << 16);
  EXPECT_EQ(w.io.last(0x008), 479u);
  EXPECT_EQ(w.io.last(0x00C), 9u << 24 | 40u << 16 | 481u);
  EXPECT_EQ(w.io.last(0x010), 287u << 16);
  EXPECT_EQ(w.io.last(0x014), 271u << 16 | 275u);
  EXPECT_EQ(w.io.last(0x100), 0x810F0000u | 43u << 8) << "enables stay";
}

TEST(DisplayDriver, IllegalModesAreRefusedBeforeAnyRegisterIsWritten) {
  const auto broken = [](auto change) {
    DisplayMode mode = kMode800x480;
    change(mode);
    return mode;
  };
  const DisplayMode modes[] = {
      {},
      broken([](DisplayMode& m) { m.width = 0; }),
      broken([](DisplayMode& m) { m.width = 4097; }),
      broken([](DisplayMode& m) { m.height = 0; }),
      broken([](DisplayMode& m) { m.h_front_porch = 0; }),
      broken([](DisplayMode& m) { m.h_sync = 0; }),
      broken([](DisplayMode& m) { m.h_sync = 257; }),
      broken([](DisplayMode& m) { m.h_back_porch = 0; }),
      broken([](DisplayMode& m) { m.v_front_porch = 0; }),
      broken([](DisplayMode& m) { m.v_sync = 0; }),
      broken([](DisplayMode& m) { m.v_back_porch = 0; }),
      broken([](DisplayMode& m) { m.v_back_porch = 9000; }),
      broken([](DisplayMode& m) { m.clock_divider = 0; }),
      broken([](DisplayMode& m) { m.clock_divider = 65; }),
  };
  for (const DisplayMode& mode : modes) {
    Written w;
    const Status status = w.driver.set_mode(mode);
    EXPECT_EQ(status.code, StatusCode::kInvalidArgument);
    EXPECT_STRNE(status.message, "");
    EXPECT_TRUE(w.io.writes.empty());
  }
}

TEST(DisplayDriver, ConfigureLayerWritesItsBlock) {
  Written w;
  ASSERT_TRUE(w.driver
                  .configure_layer(2, {.format = LayerFormat::kArgb8888,
                                       .stride_bytes = 1280,
                                       .bank_address = {0x80000000, 0x80100000},
                                       .bank = 1,
                                       .x = -5,
                                       .y = 7,
                                       .width = 320,
                                       .height = 240,
                                       .global_alpha = 0x40,
                                       .per_pixel_alpha = true,
                                       .colour_key_enabled = true,
                                       .colour_key_rgb = 0x123456})
                  .ok());
  w.expect_locked();
  Writes inside(w.io.writes.begin() + 1, w.io.writes.end() - 1);
  EXPECT_THAT(inside, UnorderedElementsAreArray(Writes{{0x1C0, 0x00400032},
                                                       {0x1C4, 1280},
                                                       {0x1C8, 0x80000000},
                                                       {0x1CC, 0x80100000},
                                                       {0x1D0, 7u << 16 | 0x1FFB},
                                                       {0x1D4, 239u << 16 | 319},
                                                       {0x1D8, 0x123456},
                                                       {0x1DC, 1}}));
}

TEST(DisplayDriver, LayersOutOfRangeAreRefusedBeforeAnyRegisterIsWritten) {
  const LayerConfig good{.stride_bytes = 3200, .bank_address = {0x80000000, 0x80000000}, .width = 800, .height = 480};
  const auto refused = [&](std::uint32_t layer, auto change) {
    LayerConfig config = good;
    change(config);
    Written w;
    const Status status = w.driver.configure_layer(layer, config);
    return status.code == StatusCode::kInvalidArgument && status.where == layer && w.io.writes.empty();
  };
  Written w;
  EXPECT_TRUE(w.driver.configure_layer(3, good).ok());
  EXPECT_TRUE(refused(4, [](LayerConfig&) {}));
  EXPECT_TRUE(refused(1, [](LayerConfig& c) { c.format = static_cast<LayerFormat>(3); }));
  EXPECT_TRUE(refused(1, [](LayerConfig& c) { c.per_pixel_alpha = true; })) << "XRGB8888 has none";
  EXPECT_TRUE(refused(1, [](LayerConfig& c) { c.width = 0; }));
  EXPECT_TRUE(refused(1, [](LayerConfig& c) { c.height = 4097; }));
  EXPECT_TRUE(refused(1, [](LayerConfig& c) { c.x = 4096; }));
  EXPECT_TRUE(refused(1, [](LayerConfig& c) { c.y = -4097; }));
  EXPECT_TRUE(refused(1, [](LayerConfig& c) { c.stride_bytes = 3196; })) << "shorter than a row";
  EXPECT_TRUE(refused(1, [](LayerConfig& c) { c.stride_bytes = 3202; }));
  EXPECT_TRUE(refused(1, [](LayerConfig& c) { c.stride_bytes = 65536; }));
  EXPECT_TRUE(refused(1, [](LayerConfig& c) { c.bank_address[0] = 0x80000002; }));
  EXPECT_TRUE(refused(1, [](LayerConfig& c) { c.bank_address[1] = 0x80000001; }));
  EXPECT_TRUE(refused(1, [](LayerConfig& c) { c.bank = 2; }));
  EXPECT_TRUE(refused(1, [](LayerConfig& c) { c.colour_key_rgb = 0x01000000; }));
}

TEST(DisplayDriver, SmallCallsWriteTheirRegister) {
  Written w;
  w.io.values[0x100] = 0x80000000;
  ASSERT_TRUE(w.driver.show_layer(3, true).ok());
  EXPECT_EQ(w.io.last(0x100), 0x80080000u);
  w.driver.show_cursor(true);
  EXPECT_EQ(w.io.last(0x100), 0x81080000u);
  ASSERT_TRUE(w.driver.show_layer(3, false).ok());
  EXPECT_EQ(w.io.last(0x100), 0x81000000u);
  EXPECT_EQ(w.driver.show_layer(4, true).code, StatusCode::kInvalidArgument);
  w.driver.set_background(0xFF123456);
  EXPECT_EQ(w.io.last(0x034), 0x123456u);
  ASSERT_TRUE(w.driver.set_cursor_image(0x80000100).ok());
  EXPECT_EQ(w.io.last(0x240), 0x80000100u);
  EXPECT_EQ(w.driver.set_cursor_image(0x80000102).code, StatusCode::kInvalidArgument);
  ASSERT_TRUE(w.driver.move_cursor(-63, 4095).ok());
  EXPECT_EQ(w.io.last(0x244), 0x0FFF1FC1u);
  EXPECT_EQ(w.driver.move_cursor(0, 4096).code, StatusCode::kInvalidArgument);
  w.driver.enable_vertical_blank_interrupt(true);
  w.driver.enable_fault_interrupts(true);
  EXPECT_EQ(w.io.last(0x024), 0xFu);
  w.driver.enable_vertical_blank_interrupt(false);
  EXPECT_EQ(w.io.last(0x024), 0xEu);
  w.driver.clear_vertical_blank();
  EXPECT_EQ(w.io.last(0x020), 1u);
  w.driver.clear_faults();
  EXPECT_EQ(w.io.last(0x020), 0xEu);
  EXPECT_EQ(w.io.last(0x03C), 0x010F0003u);
  w.driver.enable_picture_signature(true);
  EXPECT_EQ(w.io.last(0x280), 1u);
}

TEST(DisplayDriver, FlipWritesTheBankAndMovesItsBufferWhenAsked) {
  Written w;
  ASSERT_TRUE(w.driver.request_flip(1, 1).ok());
  EXPECT_EQ(w.io.writes, (Writes{{0x19C, 1}}));
  w.io.writes.clear();
  ASSERT_TRUE(w.driver.request_flip(1, 1, 0x80200000).ok());
  EXPECT_EQ(w.io.writes, (Writes{{0x038, 1}, {0x18C, 0x80200000}, {0x19C, 1}, {0x038, 0}}));
  EXPECT_EQ(w.driver.request_flip(4, 0).code, StatusCode::kInvalidArgument);
  EXPECT_EQ(w.driver.request_flip(0, 2).code, StatusCode::kInvalidArgument);
  EXPECT_EQ(w.driver.request_flip(0, 0, 0x80000003).code, StatusCode::kInvalidArgument);
  w.io.values[0x19C] = 0x80000001;
  EXPECT_TRUE(w.driver.flip_pending(1));
  EXPECT_EQ(w.driver.shown_bank(1), 0u);
  w.io.values[0x19C] = 0x40000001;
  EXPECT_FALSE(w.driver.flip_pending(1));
  EXPECT_EQ(w.driver.shown_bank(1), 1u);
}

TEST(DisplayDriver, SignatureWindowMustLieInThePictureOfTheMode) {
  Written w;
  ASSERT_TRUE(w.driver.set_mode(kMode480x272).ok());
  w.io.writes.clear();
  EXPECT_EQ(w.driver.check_window({0, 0, 0, 1}, 1).code, StatusCode::kInvalidArgument);
  EXPECT_EQ(w.driver.check_window({0xFFFFFFFF, 0, 1, 1}, 1).code, StatusCode::kInvalidArgument);
  EXPECT_EQ(w.driver.check_window({479, 0, 2, 1}, 1).code, StatusCode::kFailedPrecondition);
  EXPECT_EQ(w.driver.check_window({0, 200, 1, 73}, 1).code, StatusCode::kFailedPrecondition);
  EXPECT_TRUE(w.io.writes.empty());
  ASSERT_TRUE(w.driver.check_window({470, 200, 10, 72}, 0x12345678).ok());
  EXPECT_EQ(w.io.last(0x284), 200u << 16 | 470);
  EXPECT_EQ(w.io.last(0x288), 71u << 16 | 9);
  EXPECT_EQ(w.io.last(0x28C), 0x12345678u);
  EXPECT_EQ(w.io.last(0x280), 6u);
  ASSERT_TRUE(w.driver.measure_window({470, 200, 10, 72}).ok());
  EXPECT_EQ(w.io.last(0x280), 2u);
  w.driver.stop_window();
  EXPECT_EQ(w.io.last(0x280), 0u);
}

TEST(DisplayDriver, FaultsNameWhatHappened) {
  Written w;
  w.io.values[0x020] = 1;
  EXPECT_TRUE(w.driver.vertical_blank_seen());
  EXPECT_FALSE(w.driver.faults().any());
  w.io.values[0x020] = 2;
  EXPECT_TRUE(w.driver.faults().fifo_underflow);
  w.io.values[0x020] = 4;
  EXPECT_TRUE(w.driver.faults().signature_mismatch);
  w.io.values[0x020] = 8;
  w.io.values[0x03C] = 0x00020000;
  EXPECT_TRUE(w.driver.faults().configuration_error);
  EXPECT_EQ(w.driver.faults().configuration_detail, 0x00020000u);
}

// ----------------------------------------------------------------------------------------- with a controller behind it

class NoMemory final : public BusMemory {
 private:
  std::span<const std::byte> do_read_window(BusAddress, std::size_t) const override { return {}; }
  std::span<std::byte> do_write_window(BusAddress, std::size_t) override { return {}; }
};
class NoPanel final : public gfx::VideoSink {
 private:
  void do_segment(const gfx::VideoSegment&) override {}
};

class Device final : public RegisterIo {
 public:
  NoMemory memory;
  NoPanel panel;
  gfx::DisplayController controller{memory, panel, {}};
  DisplayDriver driver{*this, kBase};

 private:
  std::uint32_t do_read32(BusAddress address) override { return controller.read(address - kBase); }
  void do_write32(BusAddress address, std::uint32_t value) override { controller.write(address - kBase, value); }
};

TEST(DisplayDriverOnTheController, EnableNeedsAMode) {
  Device d;
  EXPECT_EQ(d.driver.enable().code, StatusCode::kFailedPrecondition);
  EXPECT_FALSE(d.driver.running());
  ASSERT_TRUE(d.driver.set_mode(kMode800x480).ok());
  EXPECT_TRUE(d.driver.enable().ok());
  EXPECT_TRUE(d.driver.running());
}

TEST(DisplayDriverOnTheController, RunsAtTheModesRefreshAndStopsAfterTheFrame) {
  Device d;
  ASSERT_TRUE(d.driver.probe().ok());
  ASSERT_TRUE(d.driver.set_mode(kMode1920x720).ok());
  ASSERT_TRUE(d.driver.enable().ok());
  d.controller.advance_to(400'000'000);  // a second
  EXPECT_EQ(d.driver.frame_count(), 60u);
  d.driver.disable();
  EXPECT_TRUE(d.driver.running());
  d.controller.advance_to(400'000'000 + kMode1920x720.frame_ticks());
  EXPECT_FALSE(d.driver.running());
}

TEST(DisplayDriverOnTheController, AFlipIsPendingUntilTheVerticalBlank) {
  Device d;
  ASSERT_TRUE(d.driver.set_mode(kMode480x272).ok());
  ASSERT_TRUE(d.driver.enable().ok());
  ASSERT_TRUE(d.driver.request_flip(0, 1).ok());
  EXPECT_TRUE(d.driver.flip_pending(0));
  EXPECT_EQ(d.driver.shown_bank(0), 0u);
  d.controller.advance_to(d.controller.next_vertical_blank());
  EXPECT_FALSE(d.driver.flip_pending(0));
  EXPECT_EQ(d.driver.shown_bank(0), 1u);
  EXPECT_TRUE(d.driver.vertical_blank_seen());
  d.driver.clear_vertical_blank();
  EXPECT_FALSE(d.driver.vertical_blank_seen());
}

TEST(DisplayDriverOnTheController, NothingTheDriverWritesIsAGuestMistake) {
  Device d;
  ASSERT_TRUE(d.driver.set_mode(kMode480x272).ok());
  for (std::uint32_t n = 0; n < 4; ++n) {
    ASSERT_TRUE(
        d.driver.configure_layer(n, {.stride_bytes = 1920, .x = -4096, .y = 4095, .width = 480, .height = 272}).ok());
    ASSERT_TRUE(d.driver.show_layer(n, true).ok());
    ASSERT_TRUE(d.driver.request_flip(n, 1, 0xFFFFFFFC).ok());
  }
  ASSERT_TRUE(d.driver.set_cursor_image(0xFFFFFFFC).ok());
  ASSERT_TRUE(d.driver.move_cursor(-4096, 4095).ok());
  d.driver.show_cursor(true);
  d.driver.set_background(0xFFFFFFFF);
  ASSERT_TRUE(d.driver.check_window({0, 0, 480, 272}, 0xFFFFFFFF).ok());
  ASSERT_TRUE(d.driver.enable().ok());
  d.controller.advance_to(10'000'000);
  EXPECT_TRUE(d.driver.faults().signature_mismatch);
  EXPECT_TRUE(d.driver.faults().any());
  d.driver.clear_faults();
  d.driver.enable_fault_interrupts(true);
  EXPECT_FALSE(d.controller.fault_asserted());
  EXPECT_EQ(d.controller.registers().mistake_count(), 0u);
  EXPECT_EQ(d.controller.registers().unimplemented_count(), 0u);
}

// --------------------------------------------------------------------------------------------------------------- modes

TEST(DisplayModes, CommonPanelsGetTheirDataSheetsTiming) {
  EXPECT_EQ(kMode480x272.pixel_clock_hz(), 9'090'909u);
  EXPECT_EQ(kMode800x480.pixel_clock_hz(), 33'333'333u);
  EXPECT_EQ(kMode1280x480.pixel_clock_hz(), 44'444'444u);
  EXPECT_EQ(kMode1920x720.pixel_clock_hz(), 100'000'000u);
  EXPECT_EQ(kMode480x272.refresh_millihertz(), 60'125u);
  EXPECT_EQ(kMode800x480.refresh_millihertz(), 60'125u);
  EXPECT_EQ(kMode1280x480.refresh_millihertz(), 60'125u);
  EXPECT_EQ(kMode1920x720.refresh_millihertz(), 60'021u);
  EXPECT_EQ(*make_display_mode(1920, 720), kMode1920x720);
  EXPECT_EQ(*make_display_mode(800, 480), kMode800x480);
}

TEST(DisplayModes, EverySizeIsLegalAndNear60HzWhere400MHzReaches) {
  for (std::uint32_t width = 16; width <= 4096; width += 17) {
    for (std::uint32_t height = 16; height <= 4096; height += 17) {
      const Result<DisplayMode> mode = make_display_mode(width, height);
      ASSERT_TRUE(mode.ok());
      ASSERT_EQ(mode->width, width);
      ASSERT_EQ(mode->height, height);
      ASSERT_EQ(display_registers::timing_fault(timing_of(*mode)), nullptr) << width << "x" << height;
      const bool reachable = std::uint64_t{width + 80} * (height + 14) * 60 <= 400'000'000;
      ASSERT_LE(mode->refresh_millihertz(), 60'200u) << width << "x" << height;
      if (reachable) {
        ASSERT_GE(mode->refresh_millihertz(), 60'000u) << width << "x" << height;
      } else {
        ASSERT_EQ(mode->clock_divider, 1u);
      }
    }
  }
  for (const auto& [width, height] : {std::pair{16u, 16u}, {16u, 4096u}, {4096u, 16u}, {4096u, 4096u}}) {
    ASSERT_TRUE(make_display_mode(width, height).ok());
    EXPECT_EQ(display_registers::timing_fault(timing_of(*make_display_mode(width, height))), nullptr);
  }
  EXPECT_EQ(make_display_mode(4096, 4096)->refresh_millihertz(), 23'305u) << "400 MHz / (4176 * 4110)";
}

TEST(DisplayModes, SizesOutOfRangeAreRefused) {
  for (const auto& [width, height] : {std::pair{15u, 16u}, {16u, 15u}, {4097u, 16u}, {16u, 4097u}, {0u, 0u}})
    EXPECT_EQ(make_display_mode(width, height).status().code, StatusCode::kInvalidArgument);
  EXPECT_THAT(make_display_mode(5000, 16).status().message, HasSubstr("16x16 to 4096x4096"));
}

}  // namespace
}  // namespace usuzumi
