// The whole instrument on a fake kernel and a fake GPIO chip: firmware, engine, drivers, main loop.
#include "boards/linux-arm64/linux_board.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <sys/mman.h>
#include <vector>

#include "boards/common/run.h"
#include "hal/crc32.h"
#include "tests/hal/linux/fake_chip.h"
#include "tests/hal/linux/fake_kernel.h"
#include "tests/support/test_meshes.h"

namespace usuzumi::linux_arm64 {
namespace {

using linux_hal::testing::fake_chips;
using linux_hal::testing::FakeChip;
using linux_hal::testing::FakeKernel;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

volatile std::sig_atomic_t stop = 0;

class LinuxBoardTest : public ::testing::Test {
 protected:
  static constexpr unsigned kIgnition = 4, kMode = 5, kBacklight = 6;
  static constexpr std::size_t kVramBytes = 1 << 20;

  LinuxBoardTest() : rom_(usuzumi::testing::container_rom({usuzumi::testing::hills(6, 3)})) {
    stop = 0;
    fake_chips() = {{&chip_}, 0, 0, {}};
    void* const vram = mmap(nullptr, kVramBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    memory_ = {.rom = {0x4000'0000, rom_.writable(), false},
               .ram = {0x1000'0000, ram_},
               .vram = {0x2000'0000, {static_cast<std::byte*>(vram), kVramBytes}},
               .engine_work = std::span(engine_work_).first(engine_work_.size() / 64 * 64)};
    chip_.drive(kIgnition, true);
  }
  ~LinuxBoardTest() override {
    board_.close();
    munmap(memory_.vram.bytes.data(), kVramBytes);
    fake_chips() = {};
  }

  Status open() {
    return board_.open({.chip = "gpiochip0",
                        .ignition = {kIgnition, false},
                        .mode_button = {kMode, false},
                        .backlight = {kBacklight, false}},
                       {.card = nullptr, .width = 64, .height = 48, .vram = memory_.vram, .flip_timeout_ms = 10});
  }

  /// Steps `frames` times; the exit code. The lines are in lines_.
  int run(std::uint32_t frames, bool signature = true) {
    boards::RunConfig config;
    config.signature = signature;
    config.instrument.device.width = 64;
    config.instrument.device.height = 48;
    config.frames = frames;
    ::testing::internal::CaptureStdout();
    const int code = boards::run(board_, memory_, config);
    const std::string said = ::testing::internal::GetCapturedStdout();
    for (std::size_t at = 0; at < said.size(); at = said.find('\n', at) + 1)
      lines_.push_back(said.substr(at, said.find('\n', at) - at));
    return code;
  }

  /// Of the panel's R, G, B bytes in scan order; XRGB8888 lies in memory as B, G, R, X.
  std::string panel_crc() const {
    const std::vector<std::uint8_t> pixels = kernel_.panel(4);
    std::vector<std::byte> rgb;
    for (std::size_t i = 0; i < pixels.size(); i += 4)
      for (const std::size_t channel : {2u, 1u, 0u}) rgb.push_back(static_cast<std::byte>(pixels[i + channel]));
    char text[16];
    std::snprintf(text, sizeof text, "crc32=%08x", crc32(kCrc32Start, rgb));
    return text;
  }
  bool light() const { return chip_.lines[kBacklight].level; }
  std::string frame_line(std::size_t frame) const { return lines_.at(frame + 1); }  // after the boot's

  FakeKernel kernel_;
  FakeChip chip_;
  usuzumi::testing::RomImage rom_;
  std::vector<std::byte> ram_ = std::vector<std::byte>(1 << 20);
  std::vector<std::byte> engine_work_ = std::vector<std::byte>(4 << 20);
  boards::BoardMemory memory_;
  LinuxBoard board_{kernel_, stop};
  std::vector<std::string> lines_;
};

TEST_F(LinuxBoardTest, ThePanelShowsThePictureWhoseCrcIsPrinted) {
  ASSERT_TRUE(open().ok());
  EXPECT_EQ(run(3), 0);
  ASSERT_EQ(lines_.size(), 4u);
  EXPECT_THAT(lines_[0], StartsWith("boot 64x48 xrgb8888"));
  for (int frame = 0; frame < 3; ++frame)
    EXPECT_THAT(frame_line(static_cast<std::size_t>(frame)),
                StartsWith("frame " + std::to_string(frame) + " picture thinned light=1 " + panel_crc()));
  EXPECT_THAT(kernel_.panel(4), Not(Each(0)));
  EXPECT_TRUE(light());
}

TEST_F(LinuxBoardTest, IgnitionOffDarkensThePanelAndTheLightComesBackWithIt) {
  ASSERT_TRUE(open().ok());
  std::uint32_t flips_when_off = 0;
  kernel_.card.on_flip = [&](std::uint32_t flips) {
    if (flips == 3) chip_.drive(kIgnition, false), flips_when_off = flips;
  };
  fake_chips().on_wait = [&] {
    EXPECT_THAT(kernel_.panel(4), Each(0));
    EXPECT_FALSE(light());
    chip_.drive(kIgnition, true);
  };
  EXPECT_EQ(run(6), 0);
  EXPECT_EQ(flips_when_off, 3u);
  std::string shown;
  for (std::size_t i = 0; i < 6; ++i) shown += frame_line(i).find(" dark ") != std::string::npos ? 'd' : 'p';
  EXPECT_EQ(shown, "ppddpp") << "the blank step and the one that waits, by the lines:\n"
                             << ::testing::PrintToString(lines_);
  EXPECT_THAT(frame_line(2), HasSubstr("light=0"));
  EXPECT_THAT(frame_line(4), HasSubstr("light=1"));
  EXPECT_THAT(frame_line(4), HasSubstr("wake_us="));
  EXPECT_TRUE(light());
}

TEST_F(LinuxBoardTest, AShortPressOfTheButtonStepsTheMode) {
  ASSERT_TRUE(open().ok());
  kernel_.card.on_flip = [&](std::uint32_t flips) {
    if (flips == 3) chip_.glitch(kMode);
  };
  EXPECT_EQ(run(5), 0);
  EXPECT_THAT(frame_line(0), HasSubstr("picture thinned"));
  EXPECT_THAT(frame_line(4), HasSubstr("picture budget"));
}

TEST_F(LinuxBoardTest, ADisplayThatStopsFlippingIsAFaultAndDark) {
  ASSERT_TRUE(open().ok());
  kernel_.card.on_flip = [&](std::uint32_t flips) { kernel_.card.flips_arrive = flips < 4; };
  EXPECT_EQ(run(5), 0) << "the instrument goes on";
  EXPECT_THAT(lines_.back(), HasSubstr("fault=\"display /dev/dri/card0: no vertical blank came"));
  EXPECT_THAT(lines_.back(), HasSubstr("dark"));
  EXPECT_FALSE(light());
}

TEST_F(LinuxBoardTest, AChipThatFailsIsAFaultOnTheSafePicture) {
  ASSERT_TRUE(open().ok());
  kernel_.card.on_flip = [&](std::uint32_t flips) { chip_.lines[kMode].broken = flips >= 3; };
  EXPECT_EQ(run(4), 0);
  EXPECT_THAT(lines_.back(), HasSubstr("safe"));
  EXPECT_THAT(lines_.back(), HasSubstr("fault=\"GPIO chip gpiochip0 line 5: cannot be read"));
}

TEST_F(LinuxBoardTest, AStopEndsAfterTheStepAndLeavesTheConsoleDarkOfUs) {
  ASSERT_TRUE(open().ok());
  kernel_.card.on_flip = [](std::uint32_t flips) { stop = flips >= 4; };
  EXPECT_EQ(run(0), 0) << "without an end but the stop";
  EXPECT_EQ(lines_.size(), 4u) << "boot and three frames: the first of them takes two flips";
  EXPECT_TRUE(light());
  board_.close();
  EXPECT_FALSE(light());
  EXPECT_TRUE(kernel_.as_before());
  EXPECT_EQ(chip_.requested_lines() + fake_chips().open_chips + fake_chips().objects, 0);
}

TEST_F(LinuxBoardTest, BadDrawingDataShowTheSafePictureWhileTheIgnitionIsOnUntilTheStop) {
  for (const bool on_at_first : {true, false}) {
    stop = 0;
    lines_.clear();
    rom_[24] ^= on_at_first ? 1 : 0;  // behind the header: the CRC is wrong now
    ASSERT_TRUE(open().ok());
    chip_.drive(kIgnition, on_at_first);
    std::uint32_t lit_flips = 0;
    int waits = 0;
    kernel_.card.on_flip = [&](std::uint32_t) {
      if (!light()) return;
      if (++lit_flips == 4) chip_.drive(kIgnition, false);
      if (lit_flips == 9) stop = 1;
    };
    fake_chips().on_wait = [&] {
      EXPECT_FALSE(light());
      EXPECT_TRUE(lit_flips == 0 || kernel_.panel(4) == std::vector<std::uint8_t>(std::size_t{64} * 48 * 4));
      if (++waits % 3 == 0) chip_.drive(kIgnition, true);
    };
    EXPECT_EQ(run(0), 3);
    ASSERT_EQ(lines_.size(), 1u);
    EXPECT_THAT(lines_[0], StartsWith("error: "));
    EXPECT_TRUE(light());
    EXPECT_EQ(lit_flips, 9u);
    EXPECT_GE(waits, 3) << "it followed the ignition into the dark";
    EXPECT_THAT(kernel_.panel(4), Not(Each(0)));
    board_.close();
  }
}

TEST_F(LinuxBoardTest, ACardThatTakesNoPictureIsToldOfTheFormatAskedForAndNothingIsLit) {
  kernel_.card.formats.clear();
  ASSERT_TRUE(open().ok());
  EXPECT_EQ(run(0), boards::kExitDevice) << "goes on without a display";
  ASSERT_EQ(lines_.size(), 1u);
  EXPECT_EQ(lines_[0],
            "error: display /dev/dri/card0 takes no XRGB8888 pictures of 64x48; name another by --card; errno 22");
  EXPECT_FALSE(chip_.lines[kBacklight].level);
  board_.close();
  EXPECT_TRUE(kernel_.as_before());
}

TEST_F(LinuxBoardTest, WithoutADisplayTheLightIsOffAndThePinsAreGivenBack) {
  chip_.lines[kBacklight].level = true;  // as a boot loader may leave it
  kernel_.card.path = "/dev/fb0";
  EXPECT_EQ(open().code, StatusCode::kUnavailable);
  EXPECT_FALSE(light());
  board_.close();
  EXPECT_EQ(chip_.requested_lines(), 0);
}

TEST_F(LinuxBoardTest, AServiceTellsOnlyOfChanges) {
  ASSERT_TRUE(open().ok());
  board_.print_only_changes();
  kernel_.card.on_flip = [&](std::uint32_t flips) {
    if (flips == 5) chip_.drive(kMode, true);
  };
  EXPECT_EQ(run(8, false), 0);
  ASSERT_EQ(lines_.size(), 3u);
  for (const std::string& line : lines_) EXPECT_THAT(line, Not(HasSubstr("crc32=")));
  EXPECT_THAT(lines_[1], StartsWith("frame 0 picture thinned"));
  EXPECT_THAT(lines_[2], HasSubstr("picture budget"));
}

}  // namespace
}  // namespace usuzumi::linux_arm64
