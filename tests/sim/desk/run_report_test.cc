#include "sim/desk/run_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace usuzumi::sim {
namespace {

using ::testing::HasSubstr;

TEST(RunReport, TellsTheTimeOfThinningOverAllFramesAndTheLongest) {
  std::array<FrameRecord, 4> frames;
  frames[0].thin_ms = 2;
  frames[2].thin_ms = 10;  // the decisions changed
  EXPECT_THAT(run_report_text({}, frames), HasSubstr("thinning 3.00 ms a frame (10.00 ms the longest)"));
}

}  // namespace
}  // namespace usuzumi::sim
