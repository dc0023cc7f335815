// Standard output and standard error that are closed or full.
#include "tests/sim/cli/command.h"

namespace usuzumi {
namespace {

using testing::expect_one_line_error;
using StandardOutput = testing::CommandTest;
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

TEST_F(StandardOutput, WhatIsLostThereIsNoSuccess) {
  write("face.obj", kFace);
  ASSERT_EQ(usuzumi("pack face.obj -o face.rom --default-level 3").exit_code, 0);
  ASSERT_EQ(usuzumi("run face.rom --out pictures").exit_code, 0);
  const std::string picture = "pictures/frame-0000.png";
  ASSERT_TRUE(exists(picture));
  for (const std::string stdout_to : {">/dev/full", ">&-"})
    for (const std::string& command :
         {std::string("--help"), std::string("pack face.obj -o out.rom --default-level 3"),
          std::string("inspect face.rom"), std::string("thin face.obj -o out.ply --faces 1"),
          std::string("run face.rom"), "compare " + picture + " " + picture}) {
      SCOPED_TRACE(command + stdout_to);
      expect_one_line_error(usuzumi(command, stdout_to + " 2>stderr.txt"), 4, "standard output");
    }
}

TEST_F(StandardOutput, ALongReportThatIsLostIsNoMistakeOfOurs) {
  std::string faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 500; ++i) faces += "o face" + std::to_string(i) + "\nf 1 2 3\n";
  write("faces.obj", faces);
  ASSERT_EQ(usuzumi("pack faces.obj -o faces.rom --default-level 3").exit_code, 0);
  ASSERT_GT(usuzumi("inspect faces.rom --json").out.size(), 20'000u) << "this test needs more than a buffer";
  expect_one_line_error(usuzumi("inspect faces.rom --json", ">/dev/full 2>stderr.txt"), 4, "standard output");
}

TEST_F(StandardOutput, AnotherErrorKeepsItsExitCode) {
  expect_one_line_error(usuzumi("inspect none.rom", ">/dev/full 2>stderr.txt"), 3, "none.rom");
}

TEST_F(StandardOutput, ClosedTogetherWithStandardErrorLeavesTheFileWhole) {
  write("face.obj", kFace);
  ASSERT_EQ(usuzumi("pack face.obj -o expected.rom").exit_code, 0);
  EXPECT_EQ(usuzumi("pack face.obj -o out.rom", ">&- 2>&-").exit_code, 4);
  EXPECT_EQ(text("out.rom"), text("expected.rom"));
}

}  // namespace
}  // namespace usuzumi
