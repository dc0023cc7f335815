// The worked example of JP2015-22462A, [0043]-[0050] and fig. 5, to its printed digits.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "hal/crc32.h"
#include "tests/support/thinning_bench.h"

namespace usuzumi {
namespace {

using firmware::Action;
using firmware::ThinningSettings;
using testing::bare_rom;
using testing::RomImage;
using testing::TestMesh;
using testing::ThinningBench;

/// The six vertices that the figure leaves out are ours: the outline runs almost straight through the last two vertices
/// and turns sharply, along long edges, everywhere else, so that their edge is the cheapest to lose.
RomImage figure5_rom() {
  TestMesh mesh1, mesh2, mesh3;
  mesh1.level = 2;
  mesh1.positions = {{-0.9f, 0.6928f, 0}, {-0.9f, -0.6928f, 0}, {-1, 0, 0}};
  mesh2.level = 1;
  mesh2.positions = {{-0.8f, 0.6928f, 0}, {-0.8f, -0.6928f, 0}, {0.6f, 0, 0}};
  mesh3.level = 3;
  mesh3.positions = {{0.928f, -0.04754f, 0}, {0.679f, -0.17241f, 0}, {3.5f, -3, 0},        {-2.5f, -3.2f, 0},
                     {3, 0.9f, 0},           {-2.2f, 1.1f, 0},       {0.898f, 0.3586f, 0}, {0.8f, 0.35f, 0},
                     {0.948f, -0.2894f, 0},  {0.973f, -0.61348f, 0}};
  return bare_rom({mesh1, mesh2, mesh3});
}

ThinningSettings one_collapse() {
  ThinningSettings settings;
  settings.quota = {firmware::format::QuotaKind::kFaces, 7};  // mesh 3 is the only level-3 mesh: 8 faces, one to go
  settings.placement = firmware::Placement::kMidpoint;
  return settings;
}

std::string printed(float v, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, double{v});
  return text;
}

TEST(PatentFigure5, Mesh1GoesMesh2StaysMesh3LosesOneVertex) {
  ThinningBench bench(figure5_rom());
  ASSERT_TRUE(bench.begin_status.ok());
  ASSERT_TRUE(bench.update(one_collapse()).ok());

  EXPECT_EQ(bench.report.meshes_in, 3u) << "MESH_MAX";
  EXPECT_EQ(bench.copy().new_mesh_max(), 2u) << "NEW_MESH_MAX";
  EXPECT_FALSE(bench.copy().present(0));
  EXPECT_EQ(bench.positions(1), (std::vector<Vec3>{{-0.8f, 0.6928f, 0}, {-0.8f, -0.6928f, 0}, {0.6f, 0, 0}}));
  ASSERT_EQ(bench.copy().mesh(2).vertex_count, 9u);
  EXPECT_EQ(bench.copy().mesh(2).faces, 7u);
}

TEST(PatentFigure5, TheLastTwoVerticesBecomeTheirMeanAsPrinted) {
  ThinningBench bench(figure5_rom());
  ASSERT_TRUE(bench.update(one_collapse()).ok());
  const auto p = bench.positions(2);
  ASSERT_EQ(p.size(), 9u);
  EXPECT_EQ(p[0], (Vec3{0.928f, -0.04754f, 0}));
  EXPECT_EQ(p[1], (Vec3{0.679f, -0.17241f, 0}));
  EXPECT_EQ(printed(p[8].x, 2), "0.96");
  EXPECT_EQ(printed(p[8].y, 5), "-0.45144");
  EXPECT_EQ(p[8].z, 0);
}

TEST(PatentFigure5, RomIsUnchanged) {
  ThinningBench bench(figure5_rom());
  const std::uint32_t before = crc32(kCrc32Start, bench.rom().bytes());
  ASSERT_TRUE(bench.update(one_collapse()).ok());
  EXPECT_EQ(crc32(kCrc32Start, bench.rom().bytes()), before);
  EXPECT_EQ(before, crc32(kCrc32Start, figure5_rom().bytes()));
}

}  // namespace
}  // namespace usuzumi
