// The main loop of every board, on a board that is all in memory.
#include "boards/common/run.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "firmware/device/turntable.h"
#include "sim/desk/desk.h"
#include "tests/support/test_meshes.h"

namespace usuzumi {
namespace {

using testing::RomImage;

/// A board whose time passes by a microsecond a look, whose pins a test sets step by step.
class MemoryBoard final : public boards::Board {
 public:
  std::string printed;
  std::vector<PinInputs> inputs;  // of each step; the last one holds on
  std::vector<bool> lights;       // after each step
  Status display_status;          // what the display answers to start()
  std::uint32_t steps = 0;

 private:
  std::uint64_t do_now_ns() override { return now_ns_ += 1000; }
  Status do_start(const Scanout&) override { return display_status; }
  Status do_show(std::uint32_t, const PictureRectangle*) override { return ok_status(); }
  PinInputs do_read() override {
    if (inputs.empty()) return {.ignition = true};
    return inputs[std::min<std::size_t>(steps, inputs.size() - 1)];
  }
  void do_set_backlight(bool on) override { light_ = on; }
  void do_wait_for_change(std::uint32_t timeout_us) override { now_ns_ += std::uint64_t{timeout_us} * 1000; }
  void do_print(std::string_view line) override { printed += line; }
  void do_step_done() override {
    ++steps;
    lights.push_back(light_);
    now_ns_ += 100'000'000;
  }

  std::uint64_t now_ns_ = 0;
  bool light_ = false;
};

class BoardRun : public ::testing::Test {
 protected:
  BoardRun() {
    config.instrument.device.width = 160;
    config.instrument.device.height = 96;
    config.frames = 3;
    config.orbit = true;
  }
  int run(std::span<const std::byte> image, std::size_t ram_bytes = 1 << 20, std::size_t vram_bytes = 1 << 20) {
    flash.assign(1 << 18, std::byte{0xFF});
    std::copy(image.begin(), image.end(), flash.begin());
    ram.resize(ram_bytes);
    vram.resize(vram_bytes);
    return boards::run(board,
                       {.rom = {0x10000000, flash, false},
                        .ram = {0x20000000, ram},
                        .vram = {0x30000000, vram},
                        .engine_work = work},
                       config);
  }
  std::vector<std::string> lines(const std::string& beginning) const {
    std::vector<std::string> found;
    std::istringstream text(board.printed);
    for (std::string line; std::getline(text, line);)
      if (line.starts_with(beginning)) found.push_back(line);
    return found;
  }
  static std::string field(const std::string& line, const std::string& name) {
    const auto at = line.find(" " + name + "=");
    if (at == std::string::npos) return {};
    const auto begin = at + name.size() + 2;
    return line.substr(begin, line.find(' ', begin) - begin);
  }

  MemoryBoard board;
  boards::RunConfig config;
  std::vector<std::byte> flash, ram, vram, work = std::vector<std::byte>(4 << 20);
  RomImage rom = testing::container_rom({testing::hills(16, 3), testing::square(0.1f, 2, 0.5f)});
};

TEST_F(BoardRun, EveryFrameHasTheCrcOfTheSimulatorsPanel) {
  ASSERT_EQ(run(rom.bytes()), 0) << board.printed;
  sim::DeskConfig desk_config;
  desk_config.width = 160;
  desk_config.height = 96;
  sim::Desk desk(desk_config, rom.bytes(), "rom");
  const auto frames = lines("frame ");
  ASSERT_EQ(frames.size(), 3u);
  const auto bounds = firmware::bounds_of(desk.drawing_data());
  const float aspect = 160.0f / 96;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const auto request =
        firmware::lit_request(firmware::turntable_camera(bounds, i, 3, aspect), aspect, config.background);
    char crc[9];
    std::snprintf(crc, sizeof crc, "%08x", desk.draw(request).record.panel_crc32);
    EXPECT_EQ(field(frames[i], "crc32"), crc) << frames[i];
    EXPECT_TRUE(frames[i].starts_with("frame " + std::to_string(i) + " picture thinned light=1")) << frames[i];
    EXPECT_EQ(field(frames[i], "meshes"), "2->1") << frames[i];
    EXPECT_EQ(field(frames[i], "faces"), "514->256") << frames[i];
  }
  EXPECT_EQ(lines("boot 160x96 xrgb8888 depth=24").size(), 1u) << board.printed;
}

TEST_F(BoardRun, FollowsThePins) {
  config.frames = 5;
  board.inputs = {{true, false}, {false, false}, {true, false}, {true, true}, {true, false}};
  ASSERT_EQ(run(rom.bytes()), 0);
  const auto frames = lines("frame ");
  const char* expected[] = {"0 picture thinned", "1 dark thinned", "2 picture thinned", "3 picture budget",
                            "4 picture budget"};
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_TRUE(frames[i].starts_with(std::string("frame ") + expected[i])) << frames[i];
  EXPECT_EQ(board.lights, (std::vector<bool>{true, false, true, true, true}));
  EXPECT_NE(field(frames[2], "wake_us"), "");
  EXPECT_EQ(field(frames[3], "wake_us"), "");
}

TEST_F(BoardRun, AFlashWithoutAnImageIsBadInputAndShowsTheSafePicture) {
  EXPECT_EQ(run({}), 3);
  EXPECT_TRUE(board.printed.starts_with("error: ")) << board.printed;
  EXPECT_EQ(board.steps, 1u) << "once, so that the safe picture can be looked at";
  EXPECT_TRUE(board.lights.front());
}

TEST_F(BoardRun, ADamagedTruncatedOrForeignImageIsBadInput) {
  std::vector<std::byte> damaged(rom.bytes().begin(), rom.bytes().end());
  damaged[damaged.size() / 2] ^= std::byte{1};
  EXPECT_EQ(run(damaged), 3);
  EXPECT_NE(board.printed.find("CRC-32"), std::string::npos) << board.printed;
  EXPECT_EQ(run(rom.bytes().first(rom.bytes().size() / 2)), 3) << "the rest of the flash is erased";
  board.printed.clear();
  EXPECT_EQ(run(rom.bytes()), 0) << "and the next boot is a good one: " << board.printed;
}

TEST_F(BoardRun, WhatDoesNotFitIsLeftOutAndSaid) {
  const auto room_for_little = testing::container_rom({testing::hills(16, 3), testing::hills(12, 2)});
  ASSERT_EQ(run(room_for_little.bytes(), 1 << 20), 0);
  EXPECT_EQ(field(lines("frame 0")[0], "dropped"), "");
  board.printed.clear();
  config.thinning.enabled = false;  // both whole
  ASSERT_EQ(run(room_for_little.bytes(), 8000), 0) << board.printed;
  EXPECT_EQ(field(lines("frame 0")[0], "dropped"), "1") << board.printed;
}

TEST_F(BoardRun, ShortVramReducesFormatsAndThenIsADeviceError) {
  config.instrument.device.pixel_format = command::PixelFormat::kXrgb8888;
  ASSERT_EQ(run(rom.bytes(), 1 << 20, 2 * 61440 + 30720), 0) << board.printed;  // 160 * 96: 4, 4 and 2 bytes each
  EXPECT_EQ(lines("boot 160x96 xrgb8888 depth=16").size(), 1u) << board.printed;
  board.printed.clear();
  ASSERT_EQ(run(rom.bytes(), 1 << 20, 2 * 32768 + 36864), 0) << board.printed;
  EXPECT_EQ(lines("boot 160x96 rgb565 depth=16").size(), 1u) << board.printed;
  EXPECT_NE(board.printed.find("VRAM is short"), std::string::npos);
  board.printed.clear();
  EXPECT_EQ(run(rom.bytes(), 1 << 20, 65536), 5);
  EXPECT_NE(board.printed.find("error: VRAM is too small"), std::string::npos) << board.printed;
}

TEST_F(BoardRun, ADisplayThatRefusesTheModeIsADeviceErrorInTheDark) {
  board.display_status = {StatusCode::kUnavailable, "display: no panel answers; check its cable, at address", 7};
  EXPECT_EQ(run(rom.bytes()), 5);
  EXPECT_EQ(board.printed, "error: display: no panel answers; check its cable, at address 7\n");
  EXPECT_FALSE(board.lights.front());
}

}  // namespace
}  // namespace usuzumi
