// What the statistics say, and what is given up when memory is short.
#include "firmware/thinning/thinning.h"

#include <gtest/gtest.h>

#include "tests/support/thinning_bench.h"

namespace usuzumi {
namespace {

using firmware::Action;
using firmware::PolicyKind;
using firmware::Reason;
using firmware::ThinningSettings;
using testing::container_rom;
using testing::hills;
using testing::square;
using testing::TestMesh;
using testing::ThinningBench;
using QuotaKind = firmware::format::QuotaKind;

TEST(Statistics, EveryMeshIsCountedOnceByWhatWasDecidedAndWhy) {
  TestMesh lamp = square(1, 2), large = square(1, 4);
  lamp.flags = firmware::format::kFlagTelltale;
  large.area_threshold_px = 1;
  const std::vector<TestMesh> meshes{square(1, 0), square(1, 0), square(1, 1), square(1, 1), square(1, 1),
                                     square(1, 2), square(1, 2), lamp,         hills(4, 3),  hills(4, 3),
                                     hills(4, 3),  hills(4, 3),  large,        square(1, 4), square(1, 5)};
  const std::uint32_t chosen[] = {8, 9, 10};
  ThinningSettings settings;
  settings.collapse_policy.kind = PolicyKind::kChosen;
  settings.collapse_policy.chosen = chosen;
  ThinningBench bench(container_rom(meshes));
  for (const bool first : {true, false}) {  // decisions are told in every frame, what was built in its own
    ASSERT_TRUE(bench.update(settings).ok());
    const auto decided = [&](Action a) { return bench.report.actions[static_cast<std::size_t>(a)]; };
    const auto kept = [&](Reason r) { return bench.report.kept_for[static_cast<std::size_t>(r)]; };
    EXPECT_EQ(decided(Action::kDelete), 2u);
    EXPECT_EQ(decided(Action::kCollapse), 3u);
    EXPECT_EQ(decided(Action::kPoint), 1u);
    EXPECT_EQ(decided(Action::kLine), 1u);
    EXPECT_EQ(decided(Action::kKeep), 8u);
    EXPECT_EQ(kept(Reason::kLevelUnset), 2u);
    EXPECT_EQ(kept(Reason::kAuthorLevel), 3u);
    EXPECT_EQ(kept(Reason::kTelltale), 1u);
    EXPECT_EQ(kept(Reason::kNotChosen), 1u);
    EXPECT_EQ(kept(Reason::kAboveArea), 1u);
    EXPECT_EQ(kept(Reason::kThinningOff), 0u);
    EXPECT_EQ(bench.report.meshes_built, first ? 13u : 0u) << "a deleted mesh is not built";
    EXPECT_EQ(bench.report.meshes_collapsed, first ? 3u : 0u);
  }
  settings.enabled = false;
  ASSERT_TRUE(bench.update(settings).ok());
  EXPECT_EQ(bench.report.kept_for[static_cast<std::size_t>(Reason::kThinningOff)], 10u) << "levels 2 to 5";
}

TEST(Statistics, AMeshBuiltSeveralTimesForWantOfRoomCountsOnce) {
  ThinningBench bench(container_rom(std::vector<TestMesh>(30, hills(6, 3))), 20000);
  ASSERT_TRUE(bench.update().ok());
  ASSERT_GT(bench.report.quota_halvings, 0u);
  EXPECT_EQ(bench.report.meshes_built, bench.copy().new_mesh_max());
}

TEST(Statistics, AMeshWithinItsQuotaIsNotCollapsed) {
  TestMesh mesh = hills(4, 3);
  mesh.quota_kind = QuotaKind::kFaces;
  mesh.quota = 32;
  ThinningBench bench(container_rom({mesh}));
  ASSERT_TRUE(bench.update().ok());
  EXPECT_EQ(bench.report.meshes_built, 1u);
  EXPECT_EQ(bench.report.meshes_collapsed, 0u);
}

TEST(Memory, MoreMeshesThanTheTableHasRoomForIsSaidAtOnce) {
  ThinningBench bench(container_rom(std::vector<TestMesh>(100, square(1, 1))), 2000);
  EXPECT_EQ(bench.begin_status.code, StatusCode::kResourceExhausted);
}

TEST(Memory, LevelTwoMeshesGoFirstAndLevelOneNever) {
  // Level-1 mesh last in the drawing data; the RAM holds the tables and about two of the three meshes.
  TestMesh deletable = hills(12, 2), kept = hills(12, 1);
  deletable.area_threshold_px = 1;  // large on the screen: would be kept
  for (std::size_t ram = 4000; ram < 40000; ram += 500) {
    ThinningBench bench(container_rom({deletable, hills(12, 3), kept}), ram);
    if (!bench.begin_status.ok()) continue;
    const Status status = bench.update();
    EXPECT_TRUE(bench.copy().sound());
    if (!bench.copy().present(2)) {
      EXPECT_EQ(status.code, StatusCode::kResourceExhausted) << ram;
      EXPECT_EQ(status.where, 2u);
      continue;
    }
    EXPECT_TRUE(status.ok()) << ram;
    EXPECT_EQ(bench.copy().mesh(2).faces, 288u) << "level 1 is whole";
    EXPECT_TRUE(!bench.copy().present(0) || bench.copy().present(1)) << "level 2 must go before level 3; " << ram;
    EXPECT_EQ(bench.report.meshes_dropped, 3 - bench.copy().new_mesh_max()) << ram;
  }
}

TEST(Memory, ATelltaleIsNotDroppedForWantOfRoom) {
  TestMesh lamp = hills(12, 2);
  lamp.flags = firmware::format::kFlagTelltale;
  TestMesh other = hills(12, 2);
  other.area_threshold_px = 1;
  ThinningBench bench(container_rom({other, lamp}), 9000);
  ASSERT_TRUE(bench.update().ok());
  EXPECT_FALSE(bench.copy().present(0));
  EXPECT_TRUE(bench.copy().present(1));
  EXPECT_EQ(bench.report.first_dropped, 0u);
}

TEST(Memory, QuotasAreHalvedBeforeACollapsibleMeshIsLeftOut) {
  // Forty meshes of 72 faces at half their faces do not fit beside the working space of the last; coarser ones do.
  std::vector<TestMesh> meshes(40, hills(6, 3));
  bool halved = false;
  for (std::size_t ram = 20000; ram < 80000 && !halved; ram += 1000) {
    ThinningBench bench(container_rom(meshes), ram);
    ASSERT_TRUE(bench.begin_status.ok());
    ASSERT_TRUE(bench.update().ok());
    EXPECT_TRUE(bench.copy().sound());
    halved = bench.report.quota_halvings > 0 && bench.report.meshes_dropped == 0 && bench.report.meshes_unthinned == 0;
  }
  EXPECT_TRUE(halved) << "no memory size led to coarser meshes that all fit";
}

TEST(Memory, LevelTwoGoesBeforeQuotasAreHalvedAndLevelThreeAfterThat) {
  TestMesh deletable = hills(6, 2);
  deletable.area_threshold_px = 1;  // large on the screen: to be drawn
  std::vector<TestMesh> meshes(30, hills(6, 3));
  meshes.push_back(deletable);
  // The largest RAM in which each happens.
  std::size_t deletable_left_out = 0, halved = 0, collapsible_left_out = 0;
  for (std::size_t ram = 100000; ram > 10000; ram -= 200) {
    ThinningBench bench(container_rom(meshes), ram);
    ASSERT_TRUE(bench.begin_status.ok());
    ASSERT_TRUE(bench.update().ok());
    const bool has_deletable = bench.copy().present(30);
    const std::uint32_t collapsible = bench.copy().new_mesh_max() - (has_deletable ? 1 : 0);
    if (!has_deletable && deletable_left_out == 0) deletable_left_out = ram;
    if (bench.report.quota_halvings > 0 && halved == 0) halved = ram;
    if (collapsible < 30) {
      if (collapsible_left_out == 0) collapsible_left_out = ram;
      EXPECT_EQ(bench.report.quota_halvings, 4u) << ram;
      EXPECT_FALSE(has_deletable) << "as large as a level-3 mesh that was left out; " << ram;
    }
  }
  EXPECT_GT(deletable_left_out, halved);
  EXPECT_GT(halved, collapsible_left_out);
  EXPECT_GT(collapsible_left_out, 0u);
}

TEST(Memory, WhereNothingIsThinnedNoQuotaIsHalvedAndNothingIsBuiltTwice) {
  // Level-3 meshes that are all kept, two of three in the RAM.
  const std::vector<TestMesh> meshes(3, hills(12, 3));
  ThinningSettings off, none_chosen;
  off.enabled = false;
  none_chosen.collapse_policy.kind = PolicyKind::kChosen;
  for (const ThinningSettings& settings : {off, none_chosen}) {
    ThinningBench bench(container_rom(meshes), 16000);
    ASSERT_TRUE(bench.update(settings).ok());
    EXPECT_EQ(bench.report.meshes_dropped, 1u);
    EXPECT_EQ(bench.report.quota_halvings, 0u);
    EXPECT_EQ(bench.clock.charged(CpuWork::kVertexCopied), 2u * 13 * 13);
  }
}

TEST(Memory, QuotasAreHalvedOnlyWhileTheyCanFall) {
  TestMesh coarse = hills(12, 3), large = hills(12, 3);
  coarse.quota_kind = QuotaKind::kFaces;
  coarse.quota = 2;
  large.area_threshold_px = 1;  // kept
  ThinningBench bench(container_rom({coarse, large, large}), 9000);
  ASSERT_TRUE(bench.update().ok());
  EXPECT_GT(bench.report.meshes_dropped, 0u);
  EXPECT_EQ(bench.report.quota_halvings, 2u) << "2, 1, 0";
}

TEST(Memory, EverySizeOfRamEndsInASoundCopyOrASentence) {
  TestMesh point = square(1, 4), line = square(1, 5);
  for (std::size_t ram = 0; ram < 30000; ram += 60) {
    ThinningBench bench(container_rom({hills(6, 3), square(1, 2), point, line, hills(3, 0)}), ram);
    if (!bench.begin_status.ok()) continue;
    const Status status = bench.update();
    EXPECT_TRUE(bench.copy().sound()) << ram;
    EXPECT_TRUE(status.ok() || status.code == StatusCode::kResourceExhausted) << ram;
    EXPECT_LE(bench.report.peak_bytes, ram);
  }
}

}  // namespace
}  // namespace usuzumi
