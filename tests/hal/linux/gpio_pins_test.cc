// GpioPins against stand-ins of libgpiod: built twice, for 1.6 and for 2.x.
#include "hal/linux/gpio_pins.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hal/linux/fake_chip.h"

namespace usuzumi::linux_hal::testing {
namespace {

class GpioPinsTest : public ::testing::Test {
 protected:
  static constexpr unsigned kIgnition = 4, kMode = 5, kBacklight = 6;

  GpioPinsTest() {
    fake_chips() = {{&chip_}, 0, 0, {}};
    EXPECT_TRUE(pins_.open({.chip = "gpiochip0",
                            .ignition = {kIgnition, false},
                            .mode_button = {kMode, false},
                            .backlight = {kBacklight, false}})
                    .ok());
  }
  ~GpioPinsTest() override {
    pins_.close();
    fake_chips() = {};
  }

  bool read_button() { return pins_.read().mode_button; }

  FakeChip chip_;
  GpioPins pins_;
};

TEST_F(GpioPinsTest, IgnitionAndButtonAreReadAsTheyAre) {
  EXPECT_EQ(pins_.read(), PinInputs{});
  chip_.drive(kIgnition, true);
  EXPECT_EQ(pins_.read(), (PinInputs{.ignition = true, .mode_button = false}));
  chip_.drive(kMode, true);
  EXPECT_EQ(pins_.read(), (PinInputs{.ignition = true, .mode_button = true}));
  EXPECT_TRUE(read_button()) << "held down";
  chip_.drive(kMode, false);
  EXPECT_FALSE(read_button()) << "a release is no press";
  chip_.drive(kIgnition, false);
  EXPECT_EQ(pins_.read(), PinInputs{});
}

TEST_F(GpioPinsTest, APressBetweenTwoReadsIsReportedOnce) {
  chip_.drive(kMode, true);
  chip_.drive(kMode, false);
  EXPECT_TRUE(read_button());
  EXPECT_FALSE(read_button());
}

TEST_F(GpioPinsTest, APressTooShortForTheKernelToSeeIsReported) {
  chip_.glitch(kMode);
  EXPECT_TRUE(read_button());
  EXPECT_FALSE(read_button());
}

TEST_F(GpioPinsTest, AGapInTheIgnitionLeavesItOn) {
  chip_.drive(kIgnition, true);
  EXPECT_TRUE(pins_.read().ignition);
  chip_.drive(kIgnition, false);
  chip_.drive(kIgnition, true);
  EXPECT_TRUE(pins_.read().ignition);
}

TEST_F(GpioPinsTest, AStormOfEdgesEndsInTheLevel) {
  for (int i = 0; i < 101; ++i) {
    chip_.drive(kMode, i % 2 == 0);
    chip_.drive(kIgnition, i % 2 == 0);
  }
  EXPECT_EQ(pins_.read(), (PinInputs{.ignition = true, .mode_button = true}));
  chip_.drive(kMode, false);
  chip_.drive(kIgnition, false);
  EXPECT_EQ(pins_.read(), PinInputs{});
}

TEST_F(GpioPinsTest, TheBacklightFollowsAndIsOffAtTheEnd) {
  EXPECT_FALSE(chip_.lines[kBacklight].level);
  pins_.set_backlight(true);
  EXPECT_TRUE(chip_.lines[kBacklight].level);
  pins_.close();
  EXPECT_FALSE(chip_.lines[kBacklight].level);
  EXPECT_EQ(chip_.requested_lines(), 0);
  EXPECT_EQ(pins_.read(), PinInputs{}) << "closed pins are quiet";
}

TEST_F(GpioPinsTest, WhereReadingFailsTheLastLevelsHoldAndCheckTells) {
  chip_.drive(kIgnition, true);
  EXPECT_TRUE(pins_.read().ignition);
  EXPECT_TRUE(pins_.check().ok());
  chip_.lines[kIgnition].broken = true;
  EXPECT_TRUE(pins_.read().ignition);
  EXPECT_EQ(pins_.check().code, StatusCode::kUnavailable);
  EXPECT_TRUE(pins_.check().ok()) << "told once";
}

}  // namespace
}  // namespace usuzumi::linux_hal::testing
