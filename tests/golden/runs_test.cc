// Every golden run: exactly its golden on the panel, by whatever route.
#include "tests/golden/runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "tests/golden/golden_check.h"
#include "tests/golden/golden_fixture.h"

namespace usuzumi::golden {

// GoogleTest would print bytes.
static void PrintTo(const DeviceRun& run, std::ostream* out) { *out << run.name; }

namespace {

class GoldenRun : public ::testing::TestWithParam<DeviceRun> {};

TEST_P(GoldenRun, PanelShowsTheGoldenExactly) {
  const RunPicture drawn = draw_run(GetParam());
  const Verdict verdict = check_golden(source_store(), GetParam().name, drawn.picture, kFailures);
  EXPECT_TRUE(verdict.ok) << verdict.report;
  EXPECT_LT(drawn.thinning.faces_out, drawn.thinning.faces_in) << "a run that thins nothing proves nothing";
}

TEST_P(GoldenRun, EveryRouteGivesTheSamePicture) {
  const std::vector<double>& azimuths = GetParam().azimuths_rad;
  const RunPicture first = draw_run(GetParam());
  const std::uint32_t crc = sim::picture_crc32(first.picture);
  EXPECT_EQ(first.signature_crc, crc) << "what was sent and what arrived";
  EXPECT_EQ(first.vram_crc, crc) << "VRAM and panel";
  EXPECT_EQ(sim::picture_crc32(draw_run(GetParam()).picture), crc) << "second run";
  EXPECT_EQ(sim::picture_crc32(draw_run(GetParam(), azimuths, 2).picture), crc) << "two threads";
  EXPECT_EQ(sim::picture_crc32(draw_run(GetParam(), std::span(azimuths).last(1)).picture), crc)
      << "without the frames before it";
}

INSTANTIATE_TEST_SUITE_P(Runs, GoldenRun, ::testing::ValuesIn(all_runs().begin(), all_runs().end()),
                         test_name<DeviceRun>);

TEST(GoldenRuns, ShortOfRamHalvesQuotas) {
  const auto runs = all_runs();
  const auto run =
      std::find_if(runs.begin(), runs.end(), [](const DeviceRun& r) { return r.board.ram_bytes <= 100'000; });
  ASSERT_NE(run, runs.end());
  EXPECT_GT(draw_run(*run).thinning.quota_halvings, 0u);
}

}  // namespace
}  // namespace usuzumi::golden
