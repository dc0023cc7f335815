// GpioLines against stand-ins of libgpiod: built twice, for 1.6 and for 2.x.
#include "hal/linux/gpio_lines.h"

#include <algorithm>
#include <cerrno>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hal/linux/fake_chip.h"

namespace usuzumi::linux_hal::testing {
namespace {

using ::testing::HasSubstr;

class GpioLinesTest : public ::testing::Test {
 protected:
  GpioLinesTest() { fake_chips() = {{&chip_}, 0, 0, {}}; }
  ~GpioLinesTest() override { fake_chips() = {}; }

  Status open(const char* chip = "9030000.pl061") {
    const GpioLine inputs[] = {{4, false}, {5, true}}, outputs[] = {{6, false}, {7, true}};
    return lines_.open(chip, inputs, outputs);
  }
  bool nothing_is_open() const {
    return chip_.requested_lines() == 0 && fake_chips().open_chips == 0 && fake_chips().objects == 0;
  }
  std::vector<GpioEdge> read(std::size_t room = 64) {
    std::vector<GpioEdge> edges(room);
    const auto count = lines_.read_edges(edges);
    EXPECT_TRUE(count.ok());
    edges.resize(*count);
    return edges;
  }

  FakeChip chip_;
  GpioLines lines_;
};

TEST_F(GpioLinesTest, AChipIsFoundByLabelByNameAndByPath) {
  FakeChip other;
  other.path = "/dev/gpiochip3";
  other.name = "gpiochip3";
  other.label = "soc-gpio";
  fake_chips().chips = {&other, &chip_};
  for (const char* chip : {"9030000.pl061", "gpiochip0", "/dev/gpiochip0"}) {
    EXPECT_TRUE(open(chip).ok()) << chip;
    EXPECT_EQ(chip_.requested_lines(), 4) << chip;
  }
  EXPECT_TRUE(open("soc-gpio").ok()) << "numbers have gaps";
  EXPECT_EQ(other.requested_lines(), 4);
  EXPECT_EQ(chip_.requested_lines(), 0) << "the lines held before are given back";
  lines_.close();  // before `other` goes
}

TEST_F(GpioLinesTest, LevelsAreMeaningsNotVoltages) {
  ASSERT_TRUE(open().ok());
  chip_.drive(4, true);
  chip_.drive(5, true);
  EXPECT_TRUE(*lines_.get(0));
  EXPECT_FALSE(*lines_.get(1)) << "line 5 is active-low";
  chip_.drive(5, false);
  EXPECT_TRUE(*lines_.get(1));
}

TEST_F(GpioLinesTest, OutputsBeginInactiveAndFollow) {
  ASSERT_TRUE(open().ok());
  EXPECT_FALSE(chip_.lines[6].level);
  EXPECT_TRUE(chip_.lines[7].level) << "line 7 is active-low";
  ASSERT_TRUE(lines_.set(0, true).ok());
  ASSERT_TRUE(lines_.set(1, true).ok());
  EXPECT_TRUE(chip_.lines[6].level);
  EXPECT_FALSE(chip_.lines[7].level);
}

TEST_F(GpioLinesTest, EdgesComeWithTheirInputNameAndTime) {
  ASSERT_TRUE(open().ok());
  EXPECT_FALSE(*lines_.wait_edge(0));
  chip_.drive(4, true);
  chip_.drive(4, false);
  chip_.drive(5, true);
  EXPECT_TRUE(*lines_.wait_edge(0));
  const auto edges = read();
  ASSERT_EQ(edges.size(), 3u);
  EXPECT_EQ(edges[0].input, 0u);
  EXPECT_TRUE(edges[0].active);
  EXPECT_EQ(edges[0].time_ns, 1'000'001'000u);
  EXPECT_FALSE(edges[1].active);
  EXPECT_EQ(edges[1].time_ns, 1'000'002'000u);
  EXPECT_EQ(edges[2].input, 1u);
  EXPECT_FALSE(edges[2].active) << "high is inactive on line 5";
  EXPECT_FALSE(*lines_.wait_edge(0));
  EXPECT_TRUE(read().empty());
}

TEST_F(GpioLinesTest, EdgesWithoutRoomAreDroppedNotLeftBehind) {
  ASSERT_TRUE(open().ok());
  for (int i = 0; i < 6; ++i) chip_.drive(4, i % 2 == 0);
  EXPECT_EQ(read(2).size(), 2u);
  EXPECT_TRUE(read().empty());
}

TEST_F(GpioLinesTest, EdgesLostInTheKernelDoNotLoseTheLevel) {
  ASSERT_TRUE(open().ok());
  for (int i = 0; i < 41; ++i) chip_.drive(4, i % 2 == 0);
  EXPECT_EQ(read().size(), 16u);
  EXPECT_TRUE(*lines_.get(0)) << "the last edge kept was a falling one; the line is high";
}

TEST_F(GpioLinesTest, ALineThatChattersWithoutEndDoesNotHoldTheReader) {
  ASSERT_TRUE(open().ok());
  constexpr unsigned kChatter = 10'000;
  chip_.lines[4].chatter = kChatter;
  chip_.drive(5, true);
  const auto edges = read();
  EXPECT_GT(chip_.lines[4].chatter, kChatter - 100) << "read on while there was more to read";
  const auto of_other = [](const GpioEdge& edge) { return edge.input == 1; };
  EXPECT_EQ(std::count_if(edges.begin(), edges.end(), of_other), 1) << "the quiet line's edge is lost";
  EXPECT_EQ(*lines_.get(0), chip_.lines[4].level);
}

TEST_F(GpioLinesTest, CloseGivesEverythingBack) {
  ASSERT_TRUE(open().ok());
  EXPECT_TRUE(lines_.is_open());
  lines_.close();
  EXPECT_FALSE(lines_.is_open());
  EXPECT_TRUE(nothing_is_open());
  ASSERT_TRUE(open().ok()) << "and may be taken again";
}

TEST_F(GpioLinesTest, AMissingChipIsNamed) {
  Status status = open("tlmm");
  EXPECT_EQ(status.code, StatusCode::kUnavailable);
  EXPECT_STREQ(status.message, "GPIO chip tlmm: not there; gpiodetect lists labels and names; chips seen");
  EXPECT_EQ(status.where, 1u);
  status = open("/dev/gpiochip9");
  EXPECT_THAT(status.message, HasSubstr("GPIO chip /dev/gpiochip9: not there"));
  EXPECT_EQ(status.where, static_cast<std::uint32_t>(ENOENT));
  EXPECT_TRUE(nothing_is_open());
}

TEST_F(GpioLinesTest, AChipWithoutRightsSaysWhichGroup) {
  chip_.open_error = EACCES;
  for (const char* chip : {"9030000.pl061", "/dev/gpiochip0"}) {
    const Status status = open(chip);
    EXPECT_EQ(status.code, StatusCode::kUnavailable);
    EXPECT_THAT(status.message, HasSubstr("no permission; run as a member of the group"));
    EXPECT_EQ(status.where, static_cast<std::uint32_t>(EACCES));
  }
}

TEST_F(GpioLinesTest, ALineThatAnotherHoldsIsNamed) {
  for (const unsigned held : {5u, 7u}) {
    chip_.lines[held].held_by_another = true;
    const Status status = open();
    EXPECT_EQ(status.code, StatusCode::kUnavailable);
    EXPECT_THAT(status.message, HasSubstr("line " + std::to_string(held) + ": in use"));
    EXPECT_TRUE(nothing_is_open());
    chip_.lines[held].held_by_another = false;
  }
}

TEST_F(GpioLinesTest, ALineThatTheChipHasNotIsNamed) {
  const GpioLine inputs[] = {{4, false}, {99, false}};
  const Status status = lines_.open("gpiochip0", inputs, {});
  EXPECT_THAT(status.message, HasSubstr("line 99: the chip has no such line"));
  EXPECT_TRUE(nothing_is_open());
}

TEST_F(GpioLinesTest, ALineWithoutAnInterruptIsRefused) {
  chip_.lines[4].has_interrupt = false;
  const Status status = open();
  EXPECT_THAT(status.message, HasSubstr("line 4: cannot report edges"));
  EXPECT_TRUE(nothing_is_open());
}

TEST_F(GpioLinesTest, ALineThatBreaksLaterIsAnError) {
  ASSERT_TRUE(open().ok());
  for (FakeLine& line : chip_.lines) line.broken = true;
  EXPECT_THAT(lines_.get(1).status().message, HasSubstr("line 5: cannot be read"));
  EXPECT_THAT(lines_.set(0, true).message, HasSubstr("line 6: cannot be set"));
}

}  // namespace
}  // namespace usuzumi::linux_hal::testing
