// The panel fed by hand with pixels and sync, and behind a real display controller.
#include "sim/panel/panel.h"

#include <gtest/gtest.h>

#include <cstring>

#include "gfx_subsystem/display/display_controller.h"

namespace usuzumi::sim {
namespace {

/// Sends signals as a controller would; each line: pixels, porch 1, sync 2, porch 1.
class Sender {
 public:
  explicit Sender(Panel& panel) : panel_(panel) {}

  void blank_line(std::uint32_t width, bool vsync = false) {
    panel_.segment({.vsync = vsync, .pixel_count = width + 1});
    end_line(vsync);
  }
  void picture_line(std::uint32_t width, std::uint32_t first_value) {
    std::vector<std::uint32_t> pixels;
    for (std::uint32_t i = 0; i < width; ++i) pixels.push_back(first_value + i);
    panel_.segment({.data_enable = true, .pixel_count = width, .xrgb = pixels.data()});
    panel_.segment({.pixel_count = 1});
    end_line(false);
  }
  void vsync_line(std::uint32_t width) { blank_line(width, true); }
  void frame(std::uint32_t width, std::uint32_t height, std::uint32_t first_value) {
    for (std::uint32_t y = 0; y < height; ++y) picture_line(width, first_value + y * width);
    blank_line(width);
    vsync_line(width);
    blank_line(width);
  }

 private:
  void end_line(bool vsync) {
    panel_.segment({.hsync = true, .vsync = vsync, .pixel_count = 2});
    panel_.segment({.vsync = vsync, .pixel_count = 1});
  }
  Panel& panel_;
};

TEST(Panel, LearnsThePicturesSizeFromTheSignal) {
  Panel panel;
  Sender sender(panel);
  sender.vsync_line(5);
  sender.frame(5, 3, 100);
  ASSERT_EQ(panel.frames_completed(), 1u);
  EXPECT_TRUE(panel.stable());
  const Image& picture = panel.last_frame().picture;
  EXPECT_EQ(picture.width, 5u);
  EXPECT_EQ(picture.height, 3u);
  for (std::uint32_t i = 0; i < 15; ++i) EXPECT_EQ(picture.xrgb[i], 100 + i);
}

TEST(Panel, CompletesAPictureAtTheRiseOfVsyncAndNumbersIt) {
  Panel panel;
  std::vector<std::uint64_t> numbers;
  std::uint32_t first_pixel = 0;
  panel.on_frame([&](const PanelFrame& frame) {
    numbers.push_back(frame.number);
    first_pixel = frame.picture.at(0, 0);
  });
  Sender sender(panel);
  sender.vsync_line(4);
  for (std::uint32_t y = 0; y < 3; ++y) sender.picture_line(4, 7 + 4 * y);
  sender.blank_line(4);
  EXPECT_TRUE(numbers.empty());
  sender.vsync_line(4);
  EXPECT_EQ(numbers, std::vector<std::uint64_t>{0});
  sender.frame(4, 3, 50);
  EXPECT_EQ(numbers, (std::vector<std::uint64_t>{0, 1}));
  EXPECT_EQ(first_pixel, 50u);
}

TEST(Panel, WaitsForVsyncWhenItIsSwitchedOnAmidAPicture) {
  Panel panel;
  Sender sender(panel);
  sender.picture_line(4, 0);
  sender.picture_line(4, 0);
  sender.blank_line(4);
  sender.vsync_line(4);
  EXPECT_EQ(panel.frames_completed(), 0u);
  EXPECT_FALSE(panel.stable());
  sender.frame(4, 3, 0);
  EXPECT_EQ(panel.frames_completed(), 1u);
}

TEST(Panel, LinesOfDifferentLengthAreUnstableAndThePictureIsDropped) {
  Panel panel;
  Sender sender(panel);
  sender.vsync_line(4);
  sender.frame(4, 3, 9);
  sender.picture_line(4, 0);
  sender.picture_line(5, 0);
  sender.blank_line(4);
  sender.vsync_line(4);
  EXPECT_EQ(panel.frames_completed(), 1u);
  EXPECT_EQ(panel.frames_dropped(), 1u);
  EXPECT_FALSE(panel.stable());
  EXPECT_EQ(panel.last_frame().picture.at(0, 0), 9u) << "the last good picture stays";
  sender.frame(4, 3, 20);
  EXPECT_TRUE(panel.stable());
  EXPECT_EQ(panel.frames_completed(), 2u);
}

TEST(Panel, UnequalPictureLinesInLinesOfEqualLengthAreUnstable) {
  Panel panel;
  Sender sender(panel);
  const std::uint32_t pixels[5] = {};
  sender.vsync_line(4);
  sender.picture_line(4, 0);
  sender.picture_line(4, 0);
  panel.segment({.data_enable = true, .pixel_count = 5, .xrgb = pixels});  // no front porch
  panel.segment({.hsync = true, .pixel_count = 2});
  panel.segment({.pixel_count = 1});
  sender.picture_line(4, 0);
  sender.blank_line(4);
  sender.vsync_line(4);
  EXPECT_EQ(panel.frames_completed(), 0u);
  EXPECT_EQ(panel.frames_dropped(), 1u);
}

TEST(Panel, EqualPictureLinesWithUnequalBlankingAreUnstable) {
  Panel panel;
  Sender sender(panel);
  sender.vsync_line(4);
  sender.picture_line(4, 0);
  sender.picture_line(4, 0);
  sender.picture_line(4, 0);
  sender.blank_line(5);
  sender.vsync_line(4);
  EXPECT_EQ(panel.frames_completed(), 0u);
  EXPECT_EQ(panel.frames_dropped(), 1u);
}

TEST(Panel, PixelsDuringVsyncAreUnstable) {
  const std::uint32_t pixels[4] = {};
  Panel panel;
  Sender sender(panel);
  sender.vsync_line(4);
  panel.segment({.vsync = true, .data_enable = true, .pixel_count = 4, .xrgb = pixels});
  panel.segment({.pixel_count = 1});
  sender.frame(4, 3, 0);
  EXPECT_EQ(panel.frames_completed(), 0u);
  EXPECT_EQ(panel.frames_dropped(), 1u);
}

TEST(Panel, PixelsDuringHsyncOrWithoutDataAreUnstable) {
  const std::uint32_t pixels[4] = {};
  const gfx::VideoSegment bad[] = {
      {.hsync = true, .data_enable = true, .pixel_count = 4, .xrgb = pixels},
      {.data_enable = true, .pixel_count = 4, .xrgb = nullptr},
      {.data_enable = true, .pixel_count = 20000, .xrgb = pixels},
  };
  for (const gfx::VideoSegment& segment : bad) {
    Panel panel;
    Sender sender(panel);
    sender.vsync_line(4);
    sender.picture_line(4, 0);
    panel.segment(segment);
    sender.vsync_line(4);
    sender.vsync_line(4);
    EXPECT_EQ(panel.frames_completed(), 0u);
    EXPECT_GE(panel.frames_dropped(), 1u);
  }
}

TEST(Panel, VsyncAmidALineOfPictureIsUnstable) {
  Panel panel;
  Sender sender(panel);
  const std::uint32_t pixels[4] = {};
  sender.vsync_line(4);
  sender.picture_line(4, 0);
  panel.segment({.data_enable = true, .pixel_count = 4, .xrgb = pixels});
  panel.segment({.vsync = true, .pixel_count = 4});
  EXPECT_EQ(panel.frames_dropped(), 1u);
}

TEST(Panel, ASplitLineOfPictureIsOneLine) {
  Panel panel;
  Sender sender(panel);
  const std::uint32_t pixels[4] = {1, 2, 3, 4};
  sender.vsync_line(4);
  panel.segment({.data_enable = true, .pixel_count = 1, .xrgb = pixels});
  panel.segment({.data_enable = true, .pixel_count = 3, .xrgb = pixels + 1});
  panel.segment({.pixel_count = 1});
  panel.segment({.hsync = true, .pixel_count = 2});
  panel.segment({.pixel_count = 1});
  sender.vsync_line(4);
  ASSERT_EQ(panel.frames_completed(), 1u);
  EXPECT_EQ(panel.last_frame().picture.xrgb, (std::vector<std::uint32_t>{1, 2, 3, 4}));
}

// ---------------------------------------------------------------------------------------- behind a display controller

class Vram final : public BusMemory {
 public:
  static constexpr BusAddress kBase = 0x80000000;
  explicit Vram(std::size_t words) : words_(words) {}
  std::vector<std::uint32_t> words_;

 private:
  std::span<const std::byte> do_read_window(BusAddress address, std::size_t size) const override {
    const auto all = std::as_bytes(std::span(words_));
    if (address < kBase || address - kBase > all.size() || size > all.size() - (address - kBase)) return {};
    return all.subspan(address - kBase, size);
  }
  std::span<std::byte> do_write_window(BusAddress, std::size_t) override { return {}; }
};

/// 40 x 30 pixels; four clocks and four lines of blanking after the picture; one tick a pixel.
void set_timing(gfx::DisplayController& d, std::uint32_t width, std::uint32_t height) {
  d.write(0x004, (width + 3) << 16);
  d.write(0x008, width - 1);
  d.write(0x00C, width);
  d.write(0x010, (height + 3) << 16);
  d.write(0x014, (height - 1) << 16 | height);
}

TEST(PanelAndController, ThePanelsPictureIsVramsAndItsCrcTheSignatureUnits) {
  Vram vram(40 * 30);
  Panel panel;
  gfx::DisplayController d(vram, panel, {});
  for (std::uint32_t i = 0; i < 40 * 30; ++i) vram.words_[i] = (i * 2654435761u) & 0xFFFFFF;
  set_timing(d, 40, 30);
  d.write(0x140, 0x00FF0001);
  d.write(0x144, 160);
  d.write(0x148, Vram::kBase);
  d.write(0x154, 29u << 16 | 39);
  d.write(0x280, 1);
  d.write(0x100, 1u << 31 | 1u << 16);
  const std::uint64_t frame_ticks = 44 * 34;
  d.advance_to(frame_ticks - 1);
  EXPECT_EQ(panel.frames_completed(), 0u);
  d.advance_to(frame_ticks);
  ASSERT_EQ(panel.frames_completed(), 1u) << "the very first picture is not lost";
  EXPECT_EQ(panel.last_frame().picture.width, 40u);
  EXPECT_EQ(panel.last_frame().picture.height, 30u);
  EXPECT_EQ(panel.last_frame().picture.xrgb, vram.words_);
  EXPECT_EQ(panel.last_frame().crc32(), d.read(0x290));
}

TEST(PanelAndController, ANewTimingChangesThePicturesSizeWithoutALostPicture) {
  Vram vram(40 * 30);
  Panel panel;
  gfx::DisplayController d(vram, panel, {});
  std::vector<std::uint32_t> widths;
  panel.on_frame([&](const PanelFrame& frame) { widths.push_back(frame.picture.width); });
  set_timing(d, 40, 30);
  d.write(0x100, 1u << 31);
  d.advance_to(20 * 44);
  set_timing(d, 24, 30);
  d.advance_to(10 * 44 * 34);
  ASSERT_GE(widths.size(), 3u);
  EXPECT_EQ(widths[0], 40u);
  EXPECT_EQ(widths[1], 24u);
  EXPECT_EQ(panel.frames_dropped(), 0u);
}

}  // namespace
}  // namespace usuzumi::sim
