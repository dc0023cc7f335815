// usuzumi run with pins, faults and drawing data for one board alone.
#include "tests/sim/cli/command.h"

namespace usuzumi {
namespace {

using testing::expect_one_line_error;
using testing::Ran;

class RunPins : public testing::CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    write_hills("hills.obj", 20);
    ASSERT_EQ(usuzumi("pack hills.obj -o hills.rom --default-level 3").exit_code, 0);
  }
  nlohmann::json frames(const std::string& options) {
    const Ran ran = usuzumi("run hills.rom --size 160x96 --stats stats.json " + options);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return json_file("stats.json")["frames"];
  }
};

TEST_F(RunPins, IgnitionAndButtonAreFollowedFrameByFrame) {
  const auto f = frames("--frames 7 --gpio 1:ignition=1,3:mode=1,4:mode=0,5:ignition=0,6:ignition=1 --out pictures");
  const char* shown[] = {"dark", "picture", "picture", "picture", "picture", "dark", "picture"};
  const char* mode[] = {"thinned", "thinned", "thinned", "budget", "budget", "budget", "budget"};
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(f[i]["shown"], shown[i]) << i;
    EXPECT_EQ(f[i]["mode"], mode[i]) << i;
    EXPECT_EQ(f[i]["backlight"], f[i]["shown"] == "picture") << i;
    EXPECT_EQ(f[i]["wake_ms"].get<double>() > 0, i == 1 || i == 6) << i;
    EXPECT_TRUE(exists("pictures/frame-000" + std::to_string(i) + ".png"));
  }
  EXPECT_EQ(f[2]["faces_thinned"], 400);
  EXPECT_EQ(f[3]["faces_thinned"], 200) << "a quarter of 800";
  EXPECT_EQ(usuzumi("compare pictures/frame-0004.png pictures/frame-0006.png").exit_code, 0) << "state is kept";
  EXPECT_EQ(usuzumi("compare pictures/frame-0000.png pictures/frame-0005.png").exit_code, 0) << "black is black";
}

TEST_F(RunPins, EachModeOfTheButtonIsWhatItsOptionDraws) {
  const auto cycle = frames("--frames 12 --gpio 0:ignition=1,4:mode=1,5:mode=0,8:mode=1");
  EXPECT_EQ(cycle[0]["crc32"], frames("")[0]["crc32"]);
  EXPECT_EQ(cycle[4]["crc32"], frames("--quota 25%")[0]["crc32"]);
  EXPECT_EQ(cycle[8]["crc32"], frames("--thin off")[0]["crc32"]);
}

TEST_F(RunPins, TheBudgetIsTheQuotaThatIsGiven) {
  const auto cycle =
      frames("--frames 12 --quota 100 --gpio 0:ignition=1,2:mode=1,3:mode=0,6:mode=1,7:mode=0,10:mode=1");
  EXPECT_EQ(cycle[0]["faces_thinned"], 100);
  EXPECT_EQ(cycle[2]["mode"], "full");
  EXPECT_EQ(cycle[6]["faces_thinned"], 400);
  EXPECT_EQ(cycle[10]["faces_thinned"], 100);
}

TEST_F(RunPins, AFaultShowsTheSafePictureAndTheRunGoesOn) {
  const auto f = frames("--frames 4 --fault 1:engine-hang=1,2:engine-hang=0 --out pictures");
  EXPECT_EQ(f[0]["shown"], "picture");
  EXPECT_EQ(f[0]["fault"], "");
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(f[i]["shown"], "safe");
    EXPECT_NE(f[i]["fault"].get<std::string>().find("engine"), std::string::npos);
    EXPECT_EQ(f[i]["backlight"], true);
  }
  EXPECT_NE(f[1]["crc32"], f[0]["crc32"]);
  EXPECT_EQ(f[1]["crc32"], f[3]["crc32"]);
}

TEST_F(RunPins, SaysWhatNoFrameWillSee) {
  Ran ran = usuzumi("run hills.rom --size 160x96 --frames 3 --gpio 0:ignition=1,5:mode=1");
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_NE(ran.err.find("--frames 6"), std::string::npos) << ran.err;
  ran = usuzumi("run hills.rom --size 160x96 --gpio 0:mode=1");
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_NE(ran.err.find("0:ignition=1"), std::string::npos) << ran.err;
  expect_one_line_error(usuzumi("run hills.rom --gpio 0:lights=1"), 2, "--gpio 0:lights=1");
  expect_one_line_error(usuzumi("run hills.rom --fault 0:mode=1"), 2, "engine-hang");
}

TEST_F(RunPins, DrawingDataForOneBoardAreRefusedByAnother) {
  ASSERT_EQ(usuzumi("pack hills.obj -o m7.rom --board cortex-m7").exit_code, 0);
  EXPECT_EQ(usuzumi("run m7.rom --board cortex-m7 --size 160x96").exit_code, 0);
  expect_one_line_error(usuzumi("run m7.rom --size 160x96"), 3, "for board cortex-m7 alone");
  EXPECT_NE(usuzumi("inspect m7.rom").out.find("for board cortex-m7 alone"), std::string::npos);
  EXPECT_EQ(usuzumi("inspect m7.rom --json").json()["board"], "cortex-m7");
  EXPECT_EQ(usuzumi("inspect hills.rom --json").json()["board"], nullptr);
  expect_one_line_error(usuzumi("pack hills.obj -o x.rom --bare --board small"), 2, "--bare");
  EXPECT_FALSE(exists("x.rom"));
}

TEST_F(RunPins, WhereVramIsShortPixelsBecomeSmallerAndItIsSaid) {
  // Two pictures and depth of 1440x540 take 9.3 MB, of which there are 8.4; with 16 bits of depth 7.8.
  const Ran ran = usuzumi("run hills.rom --board cortex-a9 --size 1440x540 --stats stats.json");
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_NE(ran.err.find("VRAM is short"), std::string::npos) << ran.err;
  EXPECT_EQ(usuzumi("run hills.rom --board cortex-a9 --size 800x480").err.find("VRAM"), std::string::npos);
}

}  // namespace
}  // namespace usuzumi
