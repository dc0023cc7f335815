#include "sim/desk/frame_script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/common/error.h"

namespace usuzumi::sim {
namespace {

using testing::HasSubstr;

constexpr std::string_view kNames[] = {"ignition", "mode"};

TEST(FrameScript, IsSortedByFrameAndKeepsTheOrderWithinOne) {
  const auto events = parse_frame_script("--gpio", "120:mode=1,0:ignition=1,120:mode=0", kNames);
  const std::vector<FrameEvent> expected{{0, "ignition", true}, {120, "mode", true}, {120, "mode", false}};
  EXPECT_EQ(events, expected);
}

TEST(FrameScript, WhatCannotBeReadIsNamedWithWhatCould) {
  for (const char* text : {"", "mode=1", "1:mode", "1:mode=2", "1:brake=1", "x:mode=1", "1:mode=1,", "-1:mode=1",
                           "1 :mode=1", "4294967296:mode=1", "=1:mode"}) {
    try {
      parse_frame_script("--gpio", text, kNames);
      ADD_FAILURE() << text << " was taken";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::kUsage) << text;
      EXPECT_THAT(e.what(), HasSubstr("FRAME:NAME=0 or =1")) << text;
      EXPECT_THAT(e.what(), HasSubstr("ignition, mode")) << text;
    }
  }
}

}  // namespace
}  // namespace usuzumi::sim
