#include "firmware/thinning/thinning.h"

#include <gtest/gtest.h>

#include "tests/support/thinning_bench.h"

namespace usuzumi {
namespace {

using firmware::Action;
using firmware::PolicyKind;
using firmware::Quota;
using firmware::Reason;
using firmware::ThinningSettings;
using firmware::UpdateCause;
using testing::as_strip;
using testing::bare_rom;
using testing::container_rom;
using testing::flat_view;
using testing::hills;
using testing::square;
using testing::TestMesh;
using testing::ThinningBench;
using QuotaKind = firmware::format::QuotaKind;

TEST(Levels, UnsetAndOneAreKeptWordForWord) {
  for (std::uint32_t level : {0u, 1u}) {
    ThinningBench bench(container_rom({hills(4, level)}));
    ASSERT_TRUE(bench.update().ok());
    EXPECT_EQ(bench.positions(0), hills(4, level).positions);
    EXPECT_EQ(bench.copy().mesh(0).faces, 32u);
    EXPECT_EQ(bench.thinning.state(0).decision.reason, level == 0 ? Reason::kLevelUnset : Reason::kAuthorLevel);
  }
}

TEST(Levels, TwoIsDeletedAndTheOthersAreDrawn) {
  ThinningBench bench(container_rom({square(1, 1), square(1, 2), square(1, 1)}));
  ASSERT_TRUE(bench.update().ok());
  EXPECT_TRUE(bench.copy().present(0));
  EXPECT_FALSE(bench.copy().present(1));
  EXPECT_TRUE(bench.copy().present(2));
  EXPECT_EQ(bench.copy().new_mesh_max(), 2u);
}

TEST(Levels, ThreeIsCollapsedToItsQuota) {
  TestMesh mesh = hills(20, 3);
  mesh.quota_kind = QuotaKind::kMillionths;
  mesh.quota = 250'000;
  ThinningBench bench(container_rom({mesh}));
  ASSERT_TRUE(bench.update().ok());
  EXPECT_LE(bench.copy().mesh(0).faces, 200u);
  EXPECT_GE(bench.copy().mesh(0).faces, 198u) << "one collapse takes at most two faces";
  EXPECT_EQ(bench.report.faces_in, 800u);
  EXPECT_EQ(bench.report.faces_out, bench.copy().mesh(0).faces);
  EXPECT_TRUE(bench.copy().sound());
}

TEST(Levels, FourKeepsOneVertexAndFiveTwo) {
  TestMesh rod;
  rod.positions = {{-1, 0, 0}, {-0.5f, 0.1f, 0}, {0.1f, 0, 0}, {0.5f, 0.1f, 0}, {1, 0, 0}};
  rod.level = 4;
  TestMesh line = rod;
  line.level = 5;
  ThinningBench bench(container_rom({rod, line}));
  ASSERT_TRUE(bench.update().ok());
  EXPECT_EQ(bench.copy().mesh(0).topology, command::Topology::kPoints);
  EXPECT_EQ(bench.positions(0), (std::vector<Vec3>{{0.1f, 0, 0}})) << "nearest to the mean, (0.02, 0.04)";
  EXPECT_EQ(bench.copy().mesh(1).topology, command::Topology::kLines);
  EXPECT_EQ(bench.positions(1), (std::vector<Vec3>{{-1, 0, 0}, {1, 0, 0}}));
}

TEST(Levels, PointsAndLinesKeepTheirColourAndTakeNoLight) {
  for (const std::uint32_t level : {4u, 5u}) {
    TestMesh mesh = square(1, level);
    mesh.normals.assign(4, pack_normal({0, 0, -1}));
    mesh.colours = {rgba8(1, 0, 0), rgba8(2, 0, 0), rgba8(3, 0, 0), rgba8(4, 0, 0)};
    ThinningBench bench(container_rom({mesh}));
    ASSERT_TRUE(bench.update().ok());
    const auto& mark = bench.copy().mesh(0);
    EXPECT_EQ(mark.normal_offset, 0xFFFFFFFFu) << "a stream that is absent";
    ASSERT_NE(mark.colour_offset, 0xFFFFFFFFu);
    Rgba8 colour;
    std::memcpy(&colour.bits, bench.copy().block(0) + mark.colour_offset, 4);
    EXPECT_EQ(colour, rgba8(1, 0, 0)) << "of the first of equally near or far vertices";
  }
}

TEST(Levels, ThinningOffKeepsEverything) {
  ThinningBench bench(container_rom({square(1, 2), hills(8, 3), square(1, 4)}));
  ThinningSettings off;
  off.enabled = false;
  ASSERT_TRUE(bench.update(off).ok());
  EXPECT_EQ(bench.copy().new_mesh_max(), 3u);
  EXPECT_EQ(bench.report.faces_out, bench.report.faces_in);
}

TEST(Levels, ATelltaleIsNeverDeleted) {
  TestMesh lamp = square(1, 2);
  lamp.flags = firmware::format::kFlagTelltale;
  ThinningBench bench(container_rom({lamp}));
  ASSERT_TRUE(bench.update().ok());
  EXPECT_TRUE(bench.copy().present(0));
  EXPECT_EQ(bench.thinning.state(0).decision.reason, Reason::kTelltale);
}

TEST(AreaThreshold, DeletesAtTheThresholdAndKeepsAboveIt) {
  // A square of side 0.4 in a 100 x 100 picture that spans 2 x 2: 20 x 20 = 400 pixels.
  TestMesh small = square(0.2f, 2), large = square(0.2f, 2);
  small.area_threshold_px = 400.01f;
  large.area_threshold_px = 399.9f;
  ThinningBench bench(container_rom({small, large}));
  ASSERT_TRUE(bench.update().ok());
  EXPECT_FALSE(bench.copy().present(0));
  EXPECT_TRUE(bench.copy().present(1));
  EXPECT_EQ(bench.thinning.state(1).decision.reason, Reason::kAboveArea);
}

TEST(AreaThreshold, BelowAreaPolicyServesMeshesWithoutTheirOwn) {
  ThinningBench bench(container_rom({square(0.2f, 2), square(0.4f, 2), square(0.2f, 3), square(0.4f, 3)}));
  ThinningSettings settings;
  settings.delete_policy = {PolicyKind::kBelowArea, 500, {}, 0, 1};
  settings.collapse_policy = {PolicyKind::kBelowArea, 500, {}, 0, 1};
  ASSERT_TRUE(bench.update(settings).ok());
  EXPECT_EQ(bench.thinning.state(0).decision.action, Action::kDelete);
  EXPECT_EQ(bench.thinning.state(1).decision.action, Action::kKeep);
  EXPECT_EQ(bench.thinning.state(2).decision.action, Action::kCollapse);
  EXPECT_EQ(bench.thinning.state(3).decision.action, Action::kKeep);
}

TEST(ScreenArea, CountsOnlyWhatFacesTheViewerInsideThePicture) {
  std::uint64_t measured = 0;
  const auto area = [&](const TestMesh& mesh) {
    const auto rom = container_rom({mesh});
    const auto data = firmware::DrawingData::open(rom.bytes());
    EXPECT_TRUE(data.ok());
    return firmware::screen_area_px(data->mesh(0), flat_view(), 1e9f, measured);
  };
  EXPECT_NEAR(area(square(0.5f, 1)), 2500, 0.01);
  EXPECT_NEAR(area(square(5, 1)), 10000, 0.01) << "clipped to the picture";
  EXPECT_NEAR(area(square(0.5f, 1, 2)), 0, 0) << "beyond the far plane";
  TestMesh away = square(0.5f, 1);
  std::swap(away.positions[0], away.positions[1]);
  std::swap(away.positions[2], away.positions[3]);
  EXPECT_EQ(area(away), 0) << "turned away";
  away.flags = firmware::format::kFlagTwoSided;
  EXPECT_NEAR(area(away), 2500, 0.01) << "two-sided: the facing with the larger sum";
  TestMesh half_out = square(0.5f, 1);
  for (Vec3& p : half_out.positions) p.x += 1;
  EXPECT_NEAR(area(half_out), 1250, 0.01);
}

TEST(ScreenArea, ClipsAtTheEyeInPerspective) {
  // w = -z: a floor at y = -1 from z = -1 to z = +9 (behind the eye); only what lies before the eye and in the picture
  // counts.
  firmware::View view{Mat4{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.0002f, -0.20002f, 0, 0, -1, 0}}, 100, 100};
  TestMesh floor;
  floor.positions = {{-1, -1, -4}, {1, -1, -4}, {-1, -1, 9}, {1, -1, 9}};
  floor.flags = firmware::format::kFlagTwoSided;
  const auto rom = container_rom({floor});
  const auto data = firmware::DrawingData::open(rom.bytes());
  std::uint64_t measured = 0;
  // At depth d the floor's edge stands at x = +-1/d, y = -1/d; from d = 4 to d = 1 (the picture's lower edge) this is a
  // trapezoid of heights 0.75 and widths 0.5 and 2: 0.9375 of the 4 square units that are 10000 pixels.
  EXPECT_NEAR(firmware::screen_area_px(data->mesh(0), view, 1e9f, measured), 0.9375 / 4 * 10000, 0.5);
}

TEST(Policies, ChosenThinsTheNamedMeshesAlone) {
  ThinningBench bench(container_rom({square(1, 2), square(1, 2), square(1, 2), square(1, 2)}));
  const std::uint32_t chosen[] = {1, 3};
  ThinningSettings settings;
  settings.delete_policy.kind = PolicyKind::kChosen;
  settings.delete_policy.chosen = chosen;
  ASSERT_TRUE(bench.update(settings).ok());
  EXPECT_TRUE(bench.copy().present(0));
  EXPECT_FALSE(bench.copy().present(1));
  EXPECT_TRUE(bench.copy().present(2));
  EXPECT_FALSE(bench.copy().present(3));
  EXPECT_EQ(bench.thinning.state(0).decision.reason, Reason::kNotChosen);
}

std::vector<bool> random_subset(std::uint32_t seed, std::uint32_t millionths) {
  ThinningBench bench(container_rom(std::vector<TestMesh>(40, square(1, 2))));
  ThinningSettings settings;
  settings.delete_policy.kind = PolicyKind::kRandom;
  settings.delete_policy.random_millionths = millionths;
  settings.delete_policy.seed = seed;
  EXPECT_TRUE(bench.update(settings).ok());
  std::vector<bool> present;
  for (std::uint32_t n = 0; n < 40; ++n) present.push_back(bench.copy().present(n));
  return present;
}

TEST(Policies, RandomTakesExactlyItsShareAndRepeatsForASeed) {
  for (std::uint32_t percent : {0u, 25u, 50u, 100u}) {
    const auto present = random_subset(7, percent * 10'000);
    EXPECT_EQ(std::count(present.begin(), present.end(), false), 40 * percent / 100) << percent;
    EXPECT_EQ(present, random_subset(7, percent * 10'000));
  }
  EXPECT_NE(random_subset(7, 500'000), random_subset(8, 500'000));
}

TEST(Policies, RandomIsFairOverSeeds) {
  std::vector<int> deleted(40);
  constexpr int kSeeds = 400;
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    const auto present = random_subset(seed, 250'000);
    for (std::size_t n = 0; n < 40; ++n) deleted[n] += present[n] ? 0 : 1;
  }
  // Each mesh is deleted with probability 1/4: 100 of 400, standard deviation 8.7; five of them either way.
  for (int count : deleted) {
    EXPECT_GT(count, 100 - 44);
    EXPECT_LT(count, 100 + 44);
  }
}

TEST(Quotas, OneBudgetIsSharedByFaceCounts) {
  ThinningBench bench(container_rom({hills(20, 3), hills(10, 3), hills(10, 1)}));
  ThinningSettings settings;
  settings.quota = {QuotaKind::kFaces, 500};  // over 800 + 200 faces: half of each
  ASSERT_TRUE(bench.update(settings).ok());
  EXPECT_EQ(bench.thinning.state(0).decision.target_faces, 400u);
  EXPECT_EQ(bench.thinning.state(1).decision.target_faces, 100u);
  EXPECT_LE(bench.copy().mesh(0).faces + bench.copy().mesh(1).faces, 500u);
  EXPECT_EQ(bench.copy().mesh(2).faces, 200u) << "level 1 is not touched";
}

TEST(Quotas, AMeshThatThePolicyPassesOverKeepsItsShareOfTheBudget) {
  ThinningBench bench(container_rom({hills(20, 3), hills(10, 3)}));
  const std::uint32_t chosen[] = {1};
  ThinningSettings settings;
  settings.quota = {QuotaKind::kFaces, 500};
  settings.collapse_policy.kind = PolicyKind::kChosen;
  settings.collapse_policy.chosen = chosen;
  ASSERT_TRUE(bench.update(settings).ok());
  EXPECT_EQ(bench.copy().mesh(0).faces, 800u);
  EXPECT_EQ(bench.thinning.state(1).decision.target_faces, 100u) << "as if the other were thinned";
}

TEST(Quotas, AnAuthorsCountHolds) {
  TestMesh mesh = hills(10, 3);
  mesh.quota_kind = QuotaKind::kFaces;
  mesh.quota = 60;
  ThinningBench bench(container_rom({mesh}));
  ASSERT_TRUE(bench.update().ok());
  EXPECT_LE(bench.copy().mesh(0).faces, 60u);
}

TEST(Quotas, WhatCannotBeReachedIsReported) {
  // A closed tetrahedron cannot lose a face.
  TestMesh mesh;
  mesh.level = 3;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  mesh.quota_kind = QuotaKind::kFaces;
  mesh.quota = 2;
  ThinningBench bench(container_rom({mesh}));
  ASSERT_TRUE(bench.update().ok());
  EXPECT_EQ(bench.copy().mesh(0).faces, 4u);
  EXPECT_EQ(bench.report.quotas_missed, 1u);
}

TEST(Quotas, TheJoinsOfAStripAreNoFaces) {
  const TestMesh indexed = hills(10, 3), strip = as_strip(indexed);  // 200 faces; as a strip 1198 with the joins
  for (const Quota quota : {Quota{}, Quota{QuotaKind::kMillionths, 250'000}, Quota{QuotaKind::kFaces, 50}}) {
    const std::uint32_t target = quota.kind == QuotaKind::kNone ? 100 : 50;
    ThinningSettings settings;
    settings.quota = quota;
    ThinningBench container(container_rom({indexed})), bare(bare_rom({strip}));
    ASSERT_TRUE(container.update(settings).ok());
    ASSERT_TRUE(bare.update(settings).ok());
    EXPECT_EQ(container.thinning.state(0).decision.target_faces, target);
    EXPECT_EQ(bare.thinning.state(0).decision.target_faces, target);
    EXPECT_EQ(bare.report.faces_in, 200u);
    EXPECT_EQ(bare.report.faces_out, container.report.faces_out);
    EXPECT_LE(bare.report.faces_out, target);
  }
}

TEST(Quotas, AStripThatIsKeptHasAsManyFacesAsInRom) {
  TestMesh strip = as_strip(hills(4, 3));
  strip.level = 1;
  ThinningBench bench(bare_rom({strip}));
  ASSERT_TRUE(bench.update().ok());
  EXPECT_EQ(bench.report.faces_in, 32u);
  EXPECT_EQ(bench.report.faces_out, 32u);
  EXPECT_EQ(bench.positions(0), strip.positions) << "the joins are drawn all the same";
}

TEST(Reuse, WhatNothingChangedIsNotThinnedAgain) {
  ThinningBench bench(container_rom({hills(10, 3), square(0.2f, 2)}));
  ASSERT_TRUE(bench.update().ok());
  EXPECT_EQ(bench.report.cause, UpdateCause::kFirst);
  EXPECT_EQ(bench.report.meshes_collapsed, 1u);
  const auto collapses = bench.clock.charged(CpuWork::kEdgeCollapsed);
  EXPECT_GT(collapses, 0u);
  ASSERT_TRUE(bench.update().ok());
  EXPECT_EQ(bench.report.cause, UpdateCause::kUnchanged);
  EXPECT_EQ(bench.report.meshes_built, 0u);
  EXPECT_EQ(bench.clock.charged(CpuWork::kEdgeCollapsed), collapses);
}

TEST(Reuse, OnlyTheMeshWhoseDecisionChangedIsBuiltAgain) {
  TestMesh near_threshold = square(0.2f, 2);
  near_threshold.area_threshold_px = 500;
  ThinningBench bench(container_rom({hills(10, 3), near_threshold, square(1, 1)}));
  ASSERT_TRUE(bench.update().ok());
  EXPECT_FALSE(bench.copy().present(1));
  const auto hills_before = bench.positions(0);
  firmware::View closer = flat_view();
  closer.model_to_clip.m[0] = closer.model_to_clip.m[5] = 2;  // four times the area: 1600 pixels
  ASSERT_TRUE(bench.update({}, closer).ok());
  EXPECT_EQ(bench.report.cause, UpdateCause::kDecisions);
  EXPECT_EQ(bench.report.meshes_built, 1u);
  EXPECT_EQ(bench.report.meshes_collapsed, 0u);
  EXPECT_TRUE(bench.copy().present(1));
  EXPECT_EQ(bench.positions(0), hills_before);
  EXPECT_EQ(bench.positions(1), near_threshold.positions);
  ASSERT_TRUE(bench.update().ok());
  EXPECT_FALSE(bench.copy().present(1)) << "and back";
  EXPECT_EQ(bench.positions(2), square(1, 1).positions);
  EXPECT_TRUE(bench.copy().sound());
}

TEST(Reuse, ANewQuotaBuildsTheCollapsedMeshesFromRomAgain) {
  ThinningBench bench(container_rom({hills(10, 3), square(1, 1)}));
  ThinningSettings settings;
  settings.quota = {QuotaKind::kMillionths, 100'000};
  ASSERT_TRUE(bench.update(settings).ok());
  EXPECT_LE(bench.copy().mesh(0).faces, 20u);
  settings.quota.value = 500'000;
  ASSERT_TRUE(bench.update(settings).ok());
  EXPECT_GE(bench.copy().mesh(0).faces, 98u) << "finer than what stood in RAM: from ROM";
  EXPECT_EQ(bench.report.meshes_built, 1u);
}

TEST(RamCopyTest, NormalsAreMadeForMeshesWithoutThem) {
  ThinningBench bench(container_rom({square(1, 1), hills(8, 3)}));
  ASSERT_TRUE(bench.update().ok());
  for (std::uint32_t n : {0u, 1u}) {
    const auto& mesh = bench.copy().mesh(n);
    ASSERT_NE(mesh.normal_offset, 0xFFFFFFFFu);
    for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
      PackedNormal normal;
      std::memcpy(&normal.bits, bench.copy().block(n) + mesh.normal_offset + 4 * v, 4);
      EXPECT_GT(unpack(normal).z, n == 0 ? 0.999f : 0.8f);  // the hills' steepest slope is 0.5
    }
  }
}

TEST(RamCopyTest, ColoursAndNormalsFollowTheCollapse) {
  TestMesh mesh = hills(10, 3);
  mesh.normals.assign(mesh.positions.size(), pack_normal({0, 0, 1}));
  mesh.colours.assign(mesh.positions.size(), rgba8(10, 20, 30));
  ThinningBench bench(container_rom({mesh}));
  ASSERT_TRUE(bench.update().ok());
  const auto& copy = bench.copy().mesh(0);
  for (std::uint32_t v = 0; v < copy.vertex_count; ++v) {
    Rgba8 colour;
    std::memcpy(&colour.bits, bench.copy().block(0) + copy.colour_offset + 4 * v, 4);
    EXPECT_EQ(colour, rgba8(10, 20, 30));
    PackedNormal normal;
    std::memcpy(&normal.bits, bench.copy().block(0) + copy.normal_offset + 4 * v, 4);
    EXPECT_EQ(normal, pack_normal({0, 0, 1}));
  }
}

}  // namespace
}  // namespace usuzumi
