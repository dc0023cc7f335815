#include "sim/image/png.h"
#include "tests/sim/cli/command.h"

namespace usuzumi {
namespace {

using sim::Image;
using testing::expect_one_line_error;

/// Two pictures of 4x3 of which one pixel differs by 16 in red.
class CompareCommand : public testing::CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    Image picture(4, 3, 0x102030);
    sim::write_png(folder() / "a.png", picture);
    picture.at(2, 1) = 0x202030;
    sim::write_png(folder() / "b.png", picture);
  }
};

TEST_F(CompareCommand, EndsWithOneWhereMoreDiffersThanAllowed) {
  EXPECT_EQ(usuzumi("compare a.png a.png").exit_code, 0);
  EXPECT_EQ(usuzumi("compare a.png b.png").exit_code, 1);
  EXPECT_EQ(usuzumi("compare a.png b.png --max-diff 15").exit_code, 1);
  EXPECT_EQ(usuzumi("compare a.png b.png --max-diff 16").exit_code, 0);
  EXPECT_EQ(usuzumi("compare a.png b.png --max-pixels 1").exit_code, 0);
  EXPECT_EQ(usuzumi("compare a.png b.png --max-pixels 0001").exit_code, 0);
}

TEST_F(CompareCommand, TakesNoNumberThatWouldWrapAround) {
  for (const char* number : {"-1", "-18446744073709551615", "18446744073709551616", "1e3", "0x10", "+1", "one"})
    for (const char* option : {"--max-pixels", "--max-diff"})
      expect_one_line_error(usuzumi(std::string("compare a.png b.png ") + option + " " + number), 2, number);
  expect_one_line_error(usuzumi("compare a.png b.png --max-diff 256"), 2, "0 to 255");
}

TEST_F(CompareCommand, EndsWithTwoWhereThereIsNothingToCompare) {
  expect_one_line_error(usuzumi("compare a.png b.png --ignore 0:0-3:2"), 2, "a.png and b.png: no pixel");
  expect_one_line_error(usuzumi("compare a.png a.png --ignore 4:0-9:2"), 2, "4:0-9:2");
  const auto report = usuzumi("compare a.png b.png --ignore 0:0-3:2 --json");
  EXPECT_EQ(report.exit_code, 2);
  EXPECT_EQ(report.json()["result"], "cannot-compare");
  EXPECT_TRUE(report.out.ends_with("}\n")) << "one line break, as every command's JSON";
}

TEST_F(CompareCommand, WritesOverNeitherPicture) {
  const std::string a = text("a.png"), b = text("b.png");
  expect_one_line_error(usuzumi("compare a.png b.png --diff a.png"), 2, "--diff a.png");
  expect_one_line_error(usuzumi("compare a.png b.png --diff b.png"), 2, "--diff b.png");
  EXPECT_EQ(text("a.png"), a);
  EXPECT_EQ(text("b.png"), b);
}

TEST_F(CompareCommand, TakesFilesAlsoAfterARectangle) {
  EXPECT_EQ(usuzumi("compare --ignore 2:1-2:1 a.png b.png").exit_code, 0);
}

}  // namespace
}  // namespace usuzumi
