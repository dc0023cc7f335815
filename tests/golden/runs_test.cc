// Every golden run: exactly its golden on the panel, by whatever route.
#include "tests/golden/runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "tests/golden/board_budget.h"
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
  if (GetParam().thresholds.empty()) {
    EXPECT_LT(drawn.thinning.faces_out, drawn.thinning.faces_in) << "a run that thins nothing proves nothing";
  } else {
    for (const std::uint32_t drawn_so : drawn.solids.drawn) EXPECT_GT(drawn_so, 0u) << "every member";
  }
}

TEST_P(GoldenRun, EveryFrameAndThinnedMeshIsAsInTheManifest) {
  const std::vector<Entry> drawn = draw_run(GetParam()).entries, golden = source_store().entries_of(GetParam().name);
  ASSERT_EQ(drawn.size(), golden.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    EXPECT_EQ(drawn[i].name, golden[i].name);
    EXPECT_EQ(drawn[i].width, golden[i].width) << drawn[i].name << ": width, or vertices";
    EXPECT_EQ(drawn[i].height, golden[i].height) << drawn[i].name << ": height, or indices";
    EXPECT_EQ(drawn[i].crc32, golden[i].crc32) << drawn[i].name;
    EXPECT_EQ(drawn[i].note, golden[i].note) << drawn[i].name;
  }
}

TEST_P(GoldenRun, EveryRouteGivesTheSamePicture) {
  const RunPicture first = draw_run(GetParam());
  const std::uint32_t crc = sim::picture_crc32(first.picture);
  EXPECT_EQ(first.signature_crc, crc) << "what was sent and what arrived";
  EXPECT_EQ(first.vram_crc, crc) << "VRAM and panel";
  EXPECT_EQ(sim::picture_crc32(draw_run(GetParam()).picture), crc) << "second run";
  EXPECT_EQ(sim::picture_crc32(draw_run(GetParam(), 0, 2).picture), crc) << "two threads";
  EXPECT_EQ(sim::picture_crc32(draw_run(GetParam(), GetParam().azimuths_rad.size() - 1).picture), crc)
      << "without the frames before it";
}

INSTANTIATE_TEST_SUITE_P(Runs, GoldenRun, ::testing::ValuesIn(all_runs().begin(), all_runs().end()),
                         test_name<DeviceRun>);

TEST(GoldenRuns, AreNotOnBoardsThatAreTooSmallAndOnAllOthers) {
  for (const DeviceRun& run : all_runs()) {
    const sim::Desk::Memory needed = draw_run(run).memory;
    for (const BoardBudget& budget : kBoardBudgets) {
      const bool excluded = std::any_of(run.not_on.begin(), run.not_on.end(),
                                        [&](const NotOn& n) { return n.board == budget.board; });
      const bool fits = needed.ram_peak_bytes <= budget.ram_bytes && needed.vram_bytes <= budget.vram_bytes;
      EXPECT_EQ(excluded, !fits) << run.name << " takes " << needed.ram_peak_bytes << " bytes of RAM, "
                                 << needed.vram_bytes << " of VRAM; " << budget.board << " has " << budget.ram_bytes
                                 << " and " << budget.vram_bytes;
      EXPECT_TRUE(excluded || run.board.ram_bytes <= budget.ram_bytes) << run.name << " asks for more than it needs";
    }
  }
}

TEST(GoldenRuns, BoardsHaveTheMemoryThatTheDeskGivesThem) {
  for (const BoardBudget& budget : kBoardBudgets) {
    if (budget.board == "host") continue;
    const sim::BoardDescription* board = sim::find_board(budget.board);
    ASSERT_NE(board, nullptr) << budget.board;
    EXPECT_EQ(budget.ram_bytes, board->ram_bytes) << budget.board;
    EXPECT_EQ(budget.vram_bytes, board->vram_bytes) << budget.board;
  }
}

TEST(GoldenRuns, ShortOfRamHalvesQuotas) {
  const auto runs = all_runs();
  const auto run =
      std::find_if(runs.begin(), runs.end(), [](const DeviceRun& r) { return r.board.ram_bytes <= 100'000; });
  ASSERT_NE(run, runs.end());
  EXPECT_GT(draw_run(*run).thinning.quota_halvings, 0u);
}

}  // namespace
}  // namespace usuzumi::golden
