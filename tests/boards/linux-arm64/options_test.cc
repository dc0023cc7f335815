#include "boards/linux-arm64/options.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace usuzumi::linux_arm64 {
namespace {

using ::testing::HasSubstr;

struct Parsed {
  bool ok = false;
  Options options;
  std::string said;
};

Parsed parse(std::vector<std::string> words) {
  words.insert(words.begin(), "usuzumi-device");
  static std::vector<std::string> kept;  // options point into the arguments
  kept = std::move(words);
  std::vector<char*> arguments;
  for (std::string& word : kept) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  Parsed parsed;
  ::testing::internal::CaptureStderr();
  parsed.ok = parse_options(static_cast<int>(kept.size()), arguments.data(), parsed.options);
  parsed.said = ::testing::internal::GetCapturedStderr();
  return parsed;
}

TEST(DeviceOptions, AreTakenAsGiven) {
  const Parsed p = parse({"--rom", "a.rom", "--size=1920x720", "--card", "/dev/dri/card1", "--gpio-chip", "GPIOB",
                          "--ignition", "2n", "--mode", "3", "--backlight", "11n", "--frames", "60", "--orbit"});
  ASSERT_TRUE(p.ok) << p.said;
  EXPECT_STREQ(p.options.rom, "a.rom");
  EXPECT_EQ(p.options.width, 1920u);
  EXPECT_EQ(p.options.height, 720u);
  EXPECT_STREQ(p.options.card, "/dev/dri/card1");
  EXPECT_STREQ(p.options.pins.chip, "GPIOB");
  EXPECT_EQ(p.options.pins.ignition.offset, 2u);
  EXPECT_TRUE(p.options.pins.ignition.active_low);
  EXPECT_EQ(p.options.pins.mode_button.offset, 3u);
  EXPECT_FALSE(p.options.pins.mode_button.active_low);
  EXPECT_EQ(p.options.pins.backlight.offset, 11u);
  EXPECT_TRUE(p.options.pins.backlight.active_low);
  EXPECT_EQ(p.options.frames, 60u);
  EXPECT_TRUE(p.options.orbit);
  EXPECT_FALSE(p.options.pause);
}

TEST(DeviceOptions, HelpNeedsNothingElse) {
  const Parsed p = parse({"--help"});
  EXPECT_TRUE(p.ok);
  EXPECT_TRUE(p.options.help);
  for (const char* option : {"--rom", "--size", "--card", "--rgb565", "--gpio-chip", "--ignition", "--mode",
                             "--backlight", "--frames", "--orbit", "--pause"})
    EXPECT_THAT(kUsage, HasSubstr(option));
}

struct Wrong {
  std::vector<std::string> words;
  const char* said;
};

TEST(DeviceOptions, WhatIsWrongIsOneLineThatNamesIt) {
  const Wrong cases[] = {
      {{}, "error: --rom FILE is missing"},
      {{"--rom", "a", "--size", "800"}, "error: --size 800: give width and height"},
      {{"--rom", "a", "--size", "0x480"}, "error: --size 0x480"},
      {{"--rom", "a", "--size", "800x4097"}, "error: --size 800x4097"},
      {{"--rom", "a", "--size", "800x480x"}, "error: --size 800x480x"},
      {{"--rom", "a", "--frames", "-1"}, "error: --frames -1: give a whole number"},
      {{"--rom", "a", "--frames", "4294967296"}, "error: --frames 4294967296"},
      {{"--rom", "a", "--ignition", "x"}, "error: --ignition x: give a line's number"},
      {{"--rom", "a", "--mode", "n"}, "error: --mode n"},
      {{"--rom", "a", "--backlight", "1024"}, "error: --backlight 1024"},
      {{"--rom", "a", "--mode", "4"}, "give three different lines, not 4, 4 and 6"},
      {{"--rom", "a", "extra"}, "error: extra: no option"},
      {{"--rom", "a", "--colour"}, "error: --colour: no such option"},
      {{"--rom"}, "error: --rom: its value is missing"},
  };
  for (const Wrong& wrong : cases) {
    const Parsed p = parse(wrong.words);
    EXPECT_FALSE(p.ok) << wrong.said;
    EXPECT_THAT(p.said, HasSubstr(wrong.said));
    EXPECT_EQ(std::count(p.said.begin(), p.said.end(), '\n'), 1) << p.said;
  }
}

}  // namespace
}  // namespace usuzumi::linux_arm64
