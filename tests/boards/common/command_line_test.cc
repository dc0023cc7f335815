#include "boards/common/command_line.h"

#include <gtest/gtest.h>

namespace usuzumi::boards {
namespace {

TEST(CommandLine, WordsArePartedByAnyNumberOfSpaces) {
  std::string_view text = "  --frames   8 --orbit ";
  EXPECT_EQ(take_word(text), "--frames");
  EXPECT_EQ(take_word(text), "8");
  EXPECT_EQ(take_word(text), "--orbit");
  EXPECT_EQ(take_word(text), "");
  EXPECT_EQ(take_word(text), "");
}

TEST(CommandLine, ANumberIsDigitsAndNothingElse) {
  std::uint32_t number = 0;
  EXPECT_TRUE(read_number("4294967295", number));
  EXPECT_EQ(number, 4294967295u);
  for (const char* text : {"", "4294967296", "-1", "+1", "1x", " 1", "0x1"})
    EXPECT_FALSE(read_number(text, number)) << text;
}

TEST(CommandLine, TakesTheMainLoopsOptionsAndLeavesTheBoardsOwn) {
  RunConfig config;
  std::string_view rest = " 12 --orbit";
  EXPECT_EQ(read_run_option("--frames", rest, config), OptionRead::kRead);
  EXPECT_EQ(config.frames, 12u);
  EXPECT_EQ(read_run_option(take_word(rest), rest, config), OptionRead::kRead);
  EXPECT_TRUE(config.orbit);
  EXPECT_EQ(read_run_option("--full", rest, config), OptionRead::kRead);
  EXPECT_FALSE(config.thinning.enabled);
  EXPECT_EQ(read_run_option("--frames", rest, config), OptionRead::kWrongValue) << "there is no value left";
  EXPECT_EQ(read_run_option("--gpio", rest, config), OptionRead::kOther);
}

}  // namespace
}  // namespace usuzumi::boards
