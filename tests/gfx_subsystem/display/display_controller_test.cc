// The display controller driven by registers and virtual time alone: when things happen, to the tick.
#include "gfx_subsystem/display/display_controller.h"

#include <gtest/gtest.h>

#include "tests/gfx_subsystem/display/display_bench.h"

namespace usuzumi::gfx {
namespace {

constexpr std::uint64_t kLine = SmallDisplay::kLineTicks, kFrame = SmallDisplay::kFrameTicks;
constexpr std::uint64_t kFirstLine0 = SmallDisplay::kFirstLine0, kFirstBlank = SmallDisplay::kFirstBlank;
constexpr BusAddress kA = 0x80000000, kB = 0x80001000, kC = 0x80002000;

TEST(DisplayController, IsSilentUntilEnabled) {
  SmallDisplay d;
  d.controller.advance_to(1'000'000);
  EXPECT_TRUE(d.cable.segments.empty());
  EXPECT_EQ(d.controller.next_event(), DisplayController::kNever);
  EXPECT_EQ(d.controller.next_vertical_blank(), DisplayController::kNever);
  EXPECT_EQ(d.read(0x02C), 0u);
}

TEST(DisplayController, SignalOfOneFrameHasThePorchesAndSyncsOfTheRegisters) {
  SmallDisplay d;
  d.turn_on();
  d.controller.advance_to(kFrame - 1);
  struct Expected {
    bool hsync, vsync, data_enable;
    std::uint32_t pixels;
  };
  std::vector<Expected> expected;
  for (std::uint32_t line : {5u, 6u, 0u, 1u, 2u, 3u, 4u}) {
    const bool vsync = line == 5;
    if (line < 4) {
      expected.push_back({false, vsync, true, 8});
      expected.push_back({false, vsync, false, 1});
    } else {
      expected.push_back({false, vsync, false, 9});
    }
    expected.push_back({true, vsync, false, 2});
    expected.push_back({false, vsync, false, 1});
  }
  ASSERT_EQ(d.cable.segments.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const VideoSegment& s = d.cable.segments[i];
    EXPECT_EQ(s.hsync, expected[i].hsync) << i;
    EXPECT_EQ(s.vsync, expected[i].vsync) << i;
    EXPECT_EQ(s.data_enable, expected[i].data_enable) << i;
    EXPECT_EQ(s.pixel_count, expected[i].pixels) << i;
  }
}

TEST(DisplayController, EachLineIsSentAtTheTickOfItsFirstPixel) {
  SmallDisplay d;
  d.controller.advance_to(1000);
  d.turn_on();
  EXPECT_EQ(d.controller.next_event(), 1000 + kLine);
  for (std::uint64_t line = 0; line < 4; ++line) {
    d.controller.advance_to(1000 + kFirstLine0 + line * kLine - 1);
    EXPECT_EQ(d.cable.lines.size(), line);
    d.controller.advance_to(1000 + kFirstLine0 + line * kLine);
    EXPECT_EQ(d.cable.lines.size(), line + 1);
    EXPECT_EQ(d.read(0x030), line);
    EXPECT_EQ(d.read(0x02C), 1u) << "running, not in the vertical blank";
    EXPECT_EQ(d.controller.next_event(), 1000 + kFirstLine0 + (line + 1) * kLine);
  }
}

TEST(DisplayController, VerticalBlankComesAtItsTickAndNotOneBefore) {
  SmallDisplay d;
  d.write(0x024, 1);
  d.turn_on();
  EXPECT_EQ(d.controller.next_vertical_blank(), kFirstBlank);
  d.controller.advance_to(kFirstBlank - 1);
  EXPECT_EQ(d.read(0x020), 0u);
  EXPECT_EQ(d.read(0x028), 0u);
  EXPECT_FALSE(d.controller.vertical_blank_asserted());
  d.controller.advance_to(kFirstBlank);
  EXPECT_EQ(d.read(0x020), 1u);
  EXPECT_EQ(d.read(0x028), 1u);
  EXPECT_EQ(d.read(0x02C), 3u);
  EXPECT_TRUE(d.controller.vertical_blank_asserted());
  EXPECT_TRUE(d.controller.interrupt_asserted());
  EXPECT_FALSE(d.controller.fault_asserted());
  EXPECT_EQ(d.controller.next_vertical_blank(), kFirstBlank + kFrame);
}

TEST(DisplayController, InterruptLineFollowsEnableAndIsClearedByWritingOne) {
  SmallDisplay d;
  d.run_one_picture();
  EXPECT_FALSE(d.controller.interrupt_asserted()) << "not enabled";
  d.write(0x024, 1);
  EXPECT_TRUE(d.controller.interrupt_asserted());
  d.write(0x020, 0);
  EXPECT_TRUE(d.controller.interrupt_asserted());
  d.write(0x020, 1);
  EXPECT_FALSE(d.controller.interrupt_asserted());
  d.controller.advance_to(kFirstBlank + kFrame - 1);
  EXPECT_FALSE(d.controller.interrupt_asserted());
  d.controller.advance_to(kFirstBlank + kFrame);
  EXPECT_TRUE(d.controller.interrupt_asserted());
}

TEST(DisplayController, FlipTakesEffectAtVerticalBlankAndNotAmidThePicture) {
  SmallDisplay d;
  d.memory.fill32(kA, 32, 0x00AA0000);
  d.memory.fill32(kB, 32, 0x000000BB);
  d.show_layer(0, kA, 0, 0, 8, 4);
  d.write(0x14C, kB);
  d.turn_on();
  d.controller.advance_to(kFirstLine0 + kLine);  // line 1 is being sent
  d.write(0x15C, 1);
  EXPECT_EQ(d.read(0x15C), 0x80000001u) << "pending, bank 0 shown";
  d.controller.advance_to(kFirstBlank - 1);
  EXPECT_EQ(d.read(0x15C), 0x80000001u);
  ASSERT_EQ(d.cable.lines.size(), 4u);
  for (const auto& line : d.cable.lines) EXPECT_EQ(line, std::vector<std::uint32_t>(8, 0xAA0000));
  d.controller.advance_to(kFirstBlank);
  EXPECT_EQ(d.read(0x15C), 0x40000001u) << "bank 1 shown";
  d.cable.forget();
  d.controller.advance_to(kFirstBlank + kFrame);
  ASSERT_EQ(d.cable.lines.size(), 4u);
  for (const auto& line : d.cable.lines) EXPECT_EQ(line, std::vector<std::uint32_t>(8, 0x0000BB));
}

TEST(DisplayController, LockHoldsEveryLatchBackUntilReleased) {
  SmallDisplay d;
  d.memory.fill32(kB, 32, 0x000000BB);
  d.show_layer(0, kA, 0, 0, 8, 4);
  d.write(0x14C, kB);
  d.turn_on();
  d.write(0x038, 1);
  d.write(0x15C, 1);
  d.write(0x034, 0x123456);
  d.controller.advance_to(kFirstBlank);
  EXPECT_EQ(d.read(0x15C), 0x80000001u);
  EXPECT_EQ(d.read(0x020), 1u) << "the vertical blank itself is not held back";
  d.write(0x038, 0);
  EXPECT_EQ(d.read(0x15C), 0x80000001u) << "only a vertical blank latches";
  d.controller.advance_to(kFirstBlank + kFrame);
  EXPECT_EQ(d.read(0x15C), 0x40000001u);
}

TEST(DisplayController, WritesToMemoryAmidTheFrameTearAtTheBeam) {
  SmallDisplay d;
  d.memory.fill32(kA, 32, 0x00111111);
  d.show_layer(0, kA, 0, 0, 8, 4);
  d.turn_on();
  d.controller.advance_to(kFirstLine0 + 2 * kLine - 1);  // line 1 has been sent, line 2 not
  d.memory.fill32(kA, 32, 0x00222222);
  d.controller.advance_to(kFirstBlank);
  ASSERT_EQ(d.cable.lines.size(), 4u);
  EXPECT_EQ(d.cable.lines[1][0], 0x111111u);
  EXPECT_EQ(d.cable.lines[2][0], 0x222222u);
}

TEST(DisplayController, TimingLatchesAtVerticalBlankAndRulesFromTheNextLine0) {
  SmallDisplay d;
  d.turn_on();
  d.controller.advance_to(kFirstLine0);
  d.write(0x100, (d.read(0x100) & ~0x3F00u) | 7u << 8);  // half the pixel clock
  d.write(0x008, 6);                                     // seven pixels
  d.controller.advance_to(kFirstBlank);
  for (const auto& line : d.cable.lines) EXPECT_EQ(line.size(), 8u);
  const std::uint64_t line0 = kFirstLine0 + kFrame;
  EXPECT_EQ(d.controller.next_vertical_blank(), line0 + 4 * 96) << "four lines of 12 pixels of 8 ticks";
  d.cable.forget();
  d.controller.advance_to(line0 + 4 * 96 - 1);
  EXPECT_EQ(d.read(0x028), 1u);
  EXPECT_EQ(d.cable.lines.size(), 4u);
  d.controller.advance_to(line0 + 4 * 96);
  EXPECT_EQ(d.read(0x028), 2u);
  for (const auto& line : d.cable.lines) EXPECT_EQ(line.size(), 7u);
}

TEST(DisplayController, IllegalTimingKeepsTheOldOneAndRaisesAConfigurationError) {
  SmallDisplay d;
  d.write(0x024, 8);
  d.turn_on();
  d.write(0x008, 8);  // HDP = HSP
  d.controller.advance_to(kFirstBlank - 1);
  EXPECT_EQ(d.read(0x020), 0u);
  d.controller.advance_to(kFirstBlank);
  EXPECT_EQ(d.read(0x020), 9u);
  EXPECT_EQ(d.read(0x03C), 1u);
  EXPECT_TRUE(d.controller.fault_asserted());
  d.write(0x03C, 1);
  EXPECT_EQ(d.read(0x03C), 0u);
  d.cable.forget();
  d.controller.advance_to(kFirstBlank + kFrame);
  ASSERT_EQ(d.cable.lines.size(), 4u);
  EXPECT_EQ(d.cable.lines[0].size(), 8u);
}

TEST(DisplayController, DoesNotStartWithIllegalTiming) {
  SmallDisplay d;
  d.write(0x004, 10u << 16);  // HTP = HSP + HSW + 1
  d.turn_on();
  EXPECT_EQ(d.read(0x02C), 0u);
  EXPECT_EQ(d.read(0x020), 8u);
  EXPECT_EQ(d.read(0x03C), 1u);
  d.controller.advance_to(10 * kFrame);
  EXPECT_TRUE(d.cable.segments.empty());
}

TEST(DisplayController, DisablingCompletesTheFrame) {
  SmallDisplay d;
  d.turn_on();
  d.controller.advance_to(kFirstLine0);
  d.clear(0x100, 1u << 31);
  EXPECT_EQ(d.read(0x02C), 1u);
  const std::uint64_t end = kFirstLine0 + kFrame;
  d.controller.advance_to(end - 1);
  EXPECT_EQ(d.read(0x02C), 3u);
  EXPECT_EQ(d.read(0x028), 1u);
  const std::size_t sent = d.cable.segments.size();
  d.controller.advance_to(end);
  EXPECT_EQ(d.read(0x02C), 0u);
  EXPECT_EQ(d.cable.segments.size(), sent);
  EXPECT_EQ(d.controller.next_event(), DisplayController::kNever);
  d.controller.advance_to(end + 1000);
  d.turn_on();
  EXPECT_EQ(d.controller.next_vertical_blank(), end + 1000 + kFirstBlank) << "starts anew with the vertical sync";
}

TEST(DisplayController, EnablingAgainBeforeTheFrameEndsChangesNothing) {
  SmallDisplay d;
  d.turn_on();
  d.controller.advance_to(kFirstLine0);
  d.clear(0x100, 1u << 31);
  d.controller.advance_to(kFirstBlank);
  d.turn_on();
  EXPECT_EQ(d.controller.next_vertical_blank(), kFirstBlank + kFrame);
}

TEST(DisplayController, OneLongAdvanceSendsWhatManyShortOnesDo) {
  SmallDisplay a, b;
  for (SmallDisplay* d : {&a, &b}) {
    for (std::uint32_t i = 0; i < 32; ++i) d->memory.put32(kA + 4 * i, i * 0x010203);
    d->show_layer(0, kA, 0, 0, 8, 4);
    d->turn_on();
  }
  a.controller.advance_to(5 * kFrame);
  for (std::uint64_t t = 1; t <= 5 * kFrame; t += 7) b.controller.advance_to(t);
  b.controller.advance_to(5 * kFrame);
  EXPECT_EQ(a.cable.lines, b.cable.lines);
  EXPECT_EQ(a.cable.segments.size(), b.cable.segments.size());
}

TEST(DisplayController, LayersAreCutAtEveryEdgeOfThePicture) {
  SmallDisplay d;
  for (std::uint32_t i = 0; i < 12 * 6; ++i) d.memory.put32(kA + 4 * i, 0x100 + i);
  d.write(0x034, 0xB0B0B0);
  d.show_layer(0, kA, -2, -1, 12, 6);                   // covers all
  d.memory.fill32(kB, 9, 0xFEFEFE);
  d.show_layer(1, kB, 7, 3, 3, 3);                      // one pixel in the lower right corner
  d.show_layer(2, kB, 8, 0, 3, 3);                      // just outside
  d.show_layer(3, kB, 0, -3, 3, 3);                     // just above
  d.run_one_picture();
  ASSERT_EQ(d.cable.lines.size(), 4u);
  for (std::uint32_t y = 0; y < 4; ++y)
    for (std::uint32_t x = 0; x < 8; ++x)
      EXPECT_EQ(d.cable.lines[y][x], x == 7 && y == 3 ? 0xFEFEFEu : 0x100 + (y + 1) * 12 + x + 2) << x << "," << y;
  EXPECT_EQ(d.read(0x020) & 8u, 0u);
}

TEST(DisplayController, CursorLiesBeforeAllLayersAndMayHangOverTheEdge) {
  SmallDisplay d;
  d.memory.fill32(kA, 32, 0x00404040);
  for (std::uint32_t n = 0; n < 4; ++n) d.show_layer(n, kA, 0, 0, 8, 4);
  d.memory.put32(kB + 256 * 62 + 4 * 61, 0xFF00FF00);  // cursor pixel (61, 62): opaque
  d.memory.put32(kB + 256 * 63 + 4 * 63, 0x80FF0000);  // (63, 63): half red
  d.write(0x240, kB);
  d.write(0x244, ((0x1FFFu & static_cast<std::uint32_t>(-61)) << 16) | (0x1FFFu & static_cast<std::uint32_t>(-60)));
  d.set(0x100, 1u << 24);
  d.run_one_picture();
  EXPECT_EQ(d.cable.lines[1][1], 0x00FF00u);
  // 255 * 128/255 + 64 * 127/255 = 159.87; 64 * 127/255 = 31.87.
  EXPECT_EQ(d.cable.lines[2][3], 0xA02020u);
  EXPECT_EQ(d.cable.lines[0][0], 0x404040u) << "transparent";
}

TEST(DisplayController, LayerModeBitsReachThePixels) {
  SmallDisplay d;
  d.write(0x034, 0x000000);
  for (std::uint32_t i = 0; i < 8; ++i) d.memory.put16(kA + 2 * i, static_cast<std::uint16_t>(i < 4 ? 0xF800 : 0x07E0));
  d.show_layer(0, kA, 0, 0, 8, 1, 0x00FF0010, 2);  // RGB565 with colour key
  d.write(0x158, 0xFF0000);
  d.memory.fill32(kB, 8, 0x80FFFFFF);
  d.show_layer(1, kB, 0, 1, 8, 1, 0x00FF0022);  // ARGB8888, own alpha
  d.show_layer(2, kB, 0, 2, 8, 1, 0x00800022);  // and global alpha 128: 128 * 128 / 255 = 64.25
  d.show_layer(3, kB, 0, 3, 8, 1, 0x00800001);  // XRGB8888, global alpha alone
  d.run_one_picture();
  EXPECT_EQ(d.cable.lines[0], (std::vector<std::uint32_t>{0, 0, 0, 0, 0x00FF00, 0x00FF00, 0x00FF00, 0x00FF00}));
  EXPECT_EQ(d.cable.lines[1][0], 0x808080u);
  EXPECT_EQ(d.cable.lines[2][0], 0x404040u);
  EXPECT_EQ(d.cable.lines[3][0], 0x808080u);
}

TEST(DisplayController, LayersThatCannotBeObeyedAreLeftOutAndNamed) {
  SmallDisplay d;
  d.write(0x034, 0x00B0B0);
  d.show_layer(0, kA, 0, 0, 8, 4, 0x00FF0003);         // no such format
  d.show_layer(1, kA, 0, 0, 8, 4);
  d.write(0x184, 28);                                  // stride shorter than the row
  d.show_layer(2, 0x10000000, 0, 0, 8, 4);             // not memory
  d.show_layer(3, 0xFFFFFFF0, 0, 0, 8, 4);             // runs out of the address space
  d.write(0x240, 0x10000000);
  d.set(0x100, 1u << 24);
  d.turn_on();
  EXPECT_EQ(d.read(0x03C), 0x00030000u) << "seen when latched";
  d.controller.advance_to(kFirstBlank - 1);
  EXPECT_EQ(d.read(0x03C), 0x010F0000u) << "seen when fetched";
  EXPECT_EQ(d.read(0x020), 8u);
  for (const auto& line : d.cable.lines) EXPECT_EQ(line, std::vector<std::uint32_t>(8, 0x00B0B0));
}

TEST(DisplayController, ALayerNeverWrapsAroundTheAddressSpace) {
  // A bus on which every address is memory.
  class Everywhere final : public BusMemory {
    std::span<const std::byte> do_read_window(BusAddress, std::size_t size) const override {
      return std::as_bytes(std::span(words_)).first(size);
    }
    std::span<std::byte> do_write_window(BusAddress, std::size_t) override { return {}; }
    std::vector<std::uint32_t> words_ = std::vector<std::uint32_t>(64, 0x00FFFFFF);
  };
  SmallDisplay d;  // for its timing, copied below
  Everywhere memory;
  CableTap cable;
  DisplayController controller(memory, cable, {});
  for (const std::uint32_t offset : {0x004u, 0x008u, 0x00Cu, 0x010u, 0x014u}) controller.write(offset, d.read(offset));
  controller.write(0x140, 0x00FF0001);
  controller.write(0x144, 32);
  controller.write(0x148, 0xFFFFFFE0);  // line 0 is the last of the address space
  controller.write(0x154, 3u << 16 | 7);
  controller.write(0x100, 1u << 31 | 1u << 16 | 3u << 8);
  controller.advance_to(kFirstBlank - 1);
  ASSERT_EQ(cable.lines.size(), 4u);
  EXPECT_EQ(cable.lines[0][0], 0x00FFFFFFu);
  EXPECT_EQ(cable.lines[1][0], 0u);
  EXPECT_EQ(controller.read(0x03C), 0x00010000u);
}

TEST(DisplayController, SlowBusStarvesTheRestOfTheLineAndRaisesTheFault) {
  // Twelve pixels of 4 ticks: a byte a tick is 4 bytes a pixel. Eight pixels of two layers need 8 bytes each; the blank
  // of 4 pixels fills the FIFO with 16 bytes: before pixel k it holds 16 - 4 k, so that pixel 3 (4 bytes) starves. Line
  // 0 has had the vertical blank, so that its FIFO is full: 20 - 4 k, pixel 4 starves.
  SmallDisplay d({.bus_bytes_per_second = 400'000'000, .fifo_bytes = 20});
  for (std::uint32_t i = 0; i < 32; ++i) d.memory.put32(kA + 4 * i, i);
  d.show_layer(0, kC, 0, 0, 8, 4);
  d.show_layer(1, kA, 0, 0, 8, 4);
  d.write(0x024, 2);
  d.turn_on();
  d.controller.advance_to(kFirstLine0 - 1);
  EXPECT_FALSE(d.controller.fault_asserted());
  d.controller.advance_to(kFirstLine0);
  EXPECT_TRUE(d.controller.fault_asserted());
  d.controller.advance_to(kFirstBlank);
  EXPECT_EQ(d.read(0x020), 3u);
  EXPECT_EQ(d.cable.lines[0], (std::vector<std::uint32_t>{0, 1, 2, 3, 3, 3, 3, 3}));
  EXPECT_EQ(d.cable.lines[1], (std::vector<std::uint32_t>{8, 9, 10, 10, 10, 10, 10, 10}));
  EXPECT_EQ(d.controller.starved_lines(), 4u);
}

TEST(DisplayController, ALineStarvedFromTheStartShowsTheBackground) {
  SmallDisplay d({.bus_bytes_per_second = 0, .fifo_bytes = 20});
  d.write(0x034, 0x00B0B0);
  d.show_layer(0, kA, 0, 0, 8, 4);
  d.run_one_picture();
  EXPECT_EQ(d.cable.lines[2], std::vector<std::uint32_t>(8, 0x00B0B0));
}

TEST(DisplayController, DefaultBusFeedsTwoLayersOf1920x720) {
  const FifoModel fifo{400'000'000, DisplayConfig{}.bus_bytes_per_second, DisplayConfig{}.fifo_bytes};
  const FetchSpan spans[] = {{0, 1920, 4}, {0, 1920, 4}};
  EXPECT_EQ(first_starved_pixel(spans, 1920, 4, 160, fifo), 1920u);
}

}  // namespace
}  // namespace usuzumi::gfx
