// The progress bar as a terminal receives it.
#include "sim/common/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "tests/sim/common/terminal.h"

namespace usuzumi::sim {
namespace {

using namespace std::chrono_literals;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;
using testing::Terminal;
using Clock = std::chrono::steady_clock;

constexpr const char* kWipe = "\r\x1b[K";

/// Set before main(), as the program's start in progress.cc is.
const Clock::time_point near_program_start = Clock::now();

TEST(ProgressBar, ShowsOneLongStepWithItsLabelAndTimeAndIsWipedAtTheEnd) {
  Terminal terminal;
  {
    Progress progress("thinning fish.obj", 0, terminal.screen());
    EXPECT_THAT(terminal.shown_until(" 1 s"), HasSubstr("\rthinning fish.obj ["));
  }
  EXPECT_THAT(terminal.shown_within(200ms), EndsWith(kWipe));
}

TEST(ProgressBar, CountsStepsWhereTheirNumberIsKnown) {
  Terminal terminal;
  Progress progress("drawing", 4, terminal.screen());
  EXPECT_THAT(terminal.shown_until("0 of 4"), HasSubstr("[..............................] 0 of 4"));
  progress.step();
  progress.step();
  EXPECT_THAT(terminal.shown_until("2 of 4"), HasSubstr("[###############...............] 2 of 4"));
}

TEST(ProgressBar, SaysNothingBeforeItsTime) {
  Terminal terminal;
  {
    Progress progress("drawing", 4, terminal.screen(Clock::now() + 1h));
    EXPECT_THAT(terminal.shown_within(300ms), IsEmpty());
  }
  EXPECT_THAT(terminal.shown_within(100ms), IsEmpty()) << "there is nothing to wipe";
}

TEST(ProgressBar, SaysNothingWhereThereIsNoTerminal) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  {
    Progress progress("drawing", 4, {ends[1], Clock::now()});
    std::this_thread::sleep_for(300ms);
  }
  pollfd readable{ends[0], POLLIN, 0};
  EXPECT_EQ(::poll(&readable, 1, 0), 0);
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST(ProgressBar, CutsItsLabelWhereTheLineWouldWrap) {
  Terminal terminal;
  Progress progress("reading " + std::string(200, 'x'), 0, terminal.screen());
  const std::string line = terminal.first_line();
  EXPECT_EQ(line.size(), 60u) << "a return and 59 characters: " << line;
  EXPECT_THAT(line, EndsWith(" s"));
}

TEST(ProgressBar, GivesUpTheBarBeforeTheNumbersWhereTheTerminalIsNarrow) {
  for (const auto& [columns, expected] :
       {std::pair<unsigned short, const char*>{30, "\rreading fish.o 0 of 4000, [0-9] s"},
        {40, "\rreading fish.obj 0 of 4000, [0-9] s"},
        {20, "\rread 0 of 4000, [0-9] s"},
        {16, "\r 0 of 4000, [0-9] s"},
        {9, "\r 0 of 40"},
        {1, "\r"}}) {
    Terminal terminal(columns);
    const Progress progress("reading fish.obj", 4000, terminal.screen());
    EXPECT_THAT(terminal.first_line(), MatchesRegex(expected)) << columns << " columns";
  }
}

TEST(ProgressBar, CutsNoCharacterInHalf) {
  // " 0 of 4000, 0 s" and the free last column leave 1, 2 and 3 bytes.
  for (const auto& [columns, expected] :
       {std::pair<unsigned short, const char*>{17, "\rf 0 of 4000, [0-9] s"},
        {18, "\rf 0 of 4000, [0-9] s"},
        {19, "\rf\u00e4 0 of 4000, [0-9] s"}}) {
    Terminal terminal(columns);
    const Progress progress("f\u00e4hre.obj", 4000, terminal.screen());
    EXPECT_THAT(terminal.first_line(), MatchesRegex(expected)) << columns << " columns";
  }
}

TEST(ProgressBar, WaitsForTwoSecondsOfTheProgramsLife) {
  const std::chrono::duration<double> patience = end_of_patience() - near_program_start;
  EXPECT_NEAR(patience.count(), 2, 0.5) << "half a second for a busy computer, which is arbitrary";
}

}  // namespace
}  // namespace usuzumi::sim
