// OSMesa starts as llvmpipe, leaves the user's choice alone, and says so when it cannot.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string_view>
#include <thread>

#include "tests/gfx_subsystem/engine_osmesa/osmesa_test_bench.h"

namespace usuzumi::gfx {
namespace {

TEST(OsmesaStart, DrawsByLlvmpipe) {
  ASSERT_TRUE(shared_engine().status().ok()) << shared_engine().status().message;
  EXPECT_TRUE(std::string_view(shared_engine().renderer()).starts_with("llvmpipe")) << shared_engine().renderer();
}

// Mesa reads its environment once per process: these two need processes of their own.
TEST(OsmesaStartDeathTest, UsersDriverAndThreadsAreLeftAlone) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        ::setenv("GALLIUM_DRIVER", "softpipe", 1);
        ::setenv("LP_NUM_THREADS", "3", 1);
        const OsmesaEngine engine(1);
        const bool kept = std::string_view(std::getenv("GALLIUM_DRIVER")) == "softpipe" &&
                          std::string_view(std::getenv("LP_NUM_THREADS")) == "3";
        std::exit(kept && (!engine.status().ok() || std::string_view(engine.renderer()).starts_with("softpipe")) ? 0
                                                                                                                 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(OsmesaStartDeathTest, ContextThatCannotBeMadeGivesAReasonAndDrawsNothing) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        ::setenv("MESA_GL_VERSION_OVERRIDE", "2.1", 1);  // Mesa then knows no OpenGL 4.2
        OsmesaEngine engine;
        Bench bench;
        bench.put(Clear{kClearColour, rgba8(1, 2, 3), 1});
        const ExecutionReport report = bench.run(engine);
        std::fputs(report.status.message, stderr);
        std::exit(report.status.code == StatusCode::kUnavailable && bench.pixel(0, 0) == 0 ? 0 : 1);
      },
      testing::ExitedWithCode(0), "OSMesa cannot make an OpenGL 4.2 context");
}

TEST(OsmesaStart, AnyThreadMayExecuteInTurn) {
  Bench bench;
  bench.put(Clear{kClearColour, rgba8(9, 8, 7), 1});
  ExecutionReport report;
  std::thread([&] { report = bench.run(); }).join();
  EXPECT_TRUE(report.status.ok()) << report.status.message;
  EXPECT_EQ(bench.pixel(15, 11), 0xFF090807u);
  bench.begin();
  bench.put(Clear{kClearColour, rgba8(1, 2, 3), 1});
  EXPECT_TRUE(bench.run().status.ok());
  EXPECT_EQ(bench.pixel(15, 11), 0xFF010203u);
}

TEST(OsmesaStart, EnginesDoNotDisturbEachOther) {
  OsmesaEngine second;
  Bench a, b;
  a.put(Clear{kClearColour, rgba8(10, 20, 30), 1});
  b.put(Clear{kClearColour, rgba8(40, 50, 60), 1});
  EXPECT_TRUE(a.run().status.ok());
  EXPECT_TRUE(b.run(second).status.ok());
  a.begin();
  a.set_pixel_transform();
  a.rectangle(0, 0, 1, 1, 0.5f, rgba8(1, 1, 1));
  EXPECT_TRUE(a.run().status.ok());
  EXPECT_EQ(a.pixel(0, 0), 0xFF010101u);
  EXPECT_EQ(a.pixel(1, 0), 0xFF0A141Eu);
  EXPECT_EQ(b.pixel(0, 0), 0xFF28323Cu);
}

}  // namespace
}  // namespace usuzumi::gfx
