// Standard output and standard error that are closed or full.
#include "tests/sim/cli/command.h"

namespace usuzumi {
namespace {

using StandardError = testing::CommandTest;

// Packed without levels: a note says what to do about that.
constexpr const char* kFace = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
constexpr const char* kUnwritable[] = {">stdout.txt 2>&-", ">stdout.txt 2>/dev/full"};

TEST_F(StandardError, WhereItCannotBeWrittenAnErrorKeepsItsExitCode) {
  for (const std::string streams : kUnwritable) {
    EXPECT_EQ(usuzumi("thin none.obj -o out.ply --faces 1", streams).exit_code, 3) << streams;
    EXPECT_EQ(usuzumi("thin none.obj --no-such-option", streams).exit_code, 2) << streams;
    EXPECT_EQ(usuzumi("nonesuch", streams).exit_code, 2) << streams;
  }
}

TEST_F(StandardError, WhereItCannotBeWrittenANoteStopsNothing) {
  write("face.obj", kFace);
  ASSERT_NE(usuzumi("pack face.obj -o expected.rom").err, "") << "this test needs a note";
  for (const std::string streams : kUnwritable) {
    EXPECT_EQ(usuzumi("pack face.obj -o out.rom", streams).exit_code, 0) << streams;
    EXPECT_EQ(text("out.rom"), text("expected.rom")) << streams;
  }
}

}  // namespace
}  // namespace usuzumi
