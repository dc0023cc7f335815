#include "firmware/instrument/controls.h"

#include <gtest/gtest.h>

namespace usuzumi {
namespace {

using firmware::Controls;

constexpr std::uint64_t kMs = 1'000'000;
constexpr PinInputs kOn{true, false}, kOnPressed{true, true}, kOff{false, false}, kOffPressed{false, true};

TEST(Controls, APressCountsWhenItBeginsHoweverLongItLasts) {
  Controls controls;
  controls.update(kOn, 0);
  EXPECT_EQ(controls.presses(), 0u);
  for (std::uint64_t t = 100; t < 2000; t += 100) controls.update(kOnPressed, t * kMs);
  EXPECT_EQ(controls.presses(), 1u);
  controls.update(kOn, 2000 * kMs);
  controls.update(kOnPressed, 2100 * kMs);
  EXPECT_EQ(controls.presses(), 2u);
}

TEST(Controls, ABouncingContactIsOnePress) {
  Controls controls;
  controls.update(kOn, 0);
  const PinInputs bounces[] = {kOnPressed, kOn, kOnPressed, kOn, kOnPressed, kOn};
  std::uint64_t t = 100 * kMs;
  for (const PinInputs& pins : bounces) controls.update(pins, t += 8 * kMs);
  EXPECT_EQ(controls.presses(), 1u);
}

TEST(Controls, AContactThatBouncesAsItOpensIsNoNewPress) {
  Controls controls;
  controls.update(kOn, 0);
  std::uint64_t t = 100 * kMs;
  for (int frame = 0; frame < 8; ++frame) controls.update(kOnPressed, t += 17 * kMs);  // held for 136 ms
  for (const PinInputs& pins : {kOn, kOnPressed, kOn, kOn, kOn, kOn}) controls.update(pins, t += 17 * kMs);
  EXPECT_EQ(controls.presses(), 1u);
  controls.update(kOnPressed, t + 17 * kMs);
  EXPECT_EQ(controls.presses(), 2u);
}

TEST(Controls, APressAtTheEndOfTheDebounceTimeCounts) {
  for (const bool late : {false, true}) {
    Controls controls;
    controls.update(kOnPressed, 0);
    controls.update(kOn, 1);
    controls.update(kOnPressed, 50 * kMs - (late ? 0 : 1));
    EXPECT_EQ(controls.presses(), late ? 2u : 1u);
  }
}

TEST(Controls, TheButtonIsDeadWhileTheIgnitionIsOff) {
  Controls controls;
  controls.update(kOffPressed, 0);
  EXPECT_EQ(controls.presses(), 0u);
  controls.update(kOnPressed, 100 * kMs);
  EXPECT_EQ(controls.presses(), 0u) << "held down since before: that press began in the dark";
  controls.update(kOn, 200 * kMs);
  controls.update(kOnPressed, 300 * kMs);
  EXPECT_EQ(controls.presses(), 1u);
  controls.update(kOff, 400 * kMs);
  EXPECT_EQ(controls.presses(), 1u) << "the mode is kept";
}

TEST(Controls, TellsWhenTheIgnitionWentOn) {
  Controls controls;
  EXPECT_FALSE(controls.ignition());
  controls.update(kOn, 7 * kMs);
  controls.update(kOn, 9 * kMs);
  EXPECT_TRUE(controls.ignition());
  EXPECT_EQ(controls.ignition_on_ns(), 7 * kMs);
  controls.update(kOff, 10 * kMs);
  EXPECT_FALSE(controls.ignition());
  controls.update(kOn, 12 * kMs);
  EXPECT_EQ(controls.ignition_on_ns(), 12 * kMs);
}

}  // namespace
}  // namespace usuzumi
