// Meshes thinned without new vertices: drawn with those in ROM where the engine reads them, copied where it does not.
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "firmware/thinning/thinning.h"
#include "tests/support/thinning_bench.h"

namespace usuzumi {
namespace {

using firmware::kNoStream;
using testing::as_strip;
using testing::bare_rom;
using testing::container_rom;
using testing::five_materials;
using testing::hills;
using testing::mapped_hills;
using testing::TestAppearance;
using testing::TestMesh;
using testing::ThinningBench;
using testing::two_hills;

constexpr std::size_t kRam = 1 << 20;

TestMesh by_half_edge(TestMesh mesh) {
  mesh.method = firmware::format::Method::kHalfEdge;
  return mesh;
}
TestMesh with_normals(TestMesh mesh) {
  mesh.normals.assign(mesh.positions.size(), pack_normal({0, 0, 1}));
  mesh.normals[3] = pack_normal({0, 1, 0});
  return mesh;
}

/// The copy with its vertices and the one that leaves them in ROM, of the same drawing data.
struct BothWays {
  ThinningBench apart, in_place;
  explicit BothWays(const TestMesh& mesh)
      : apart(container_rom({mesh}, five_materials()), kRam, false),
        in_place(container_rom({mesh}, five_materials()), kRam, true) {
    EXPECT_TRUE(apart.update().ok());
    EXPECT_TRUE(in_place.update().ok());
    EXPECT_TRUE(apart.copy().sound());
    EXPECT_TRUE(in_place.copy().sound());
  }
};

TEST(InPlace, TheCopyHoldsIndicesAloneAndDrawsTheSameFaces) {
  const TestMesh mesh = by_half_edge(with_normals(mapped_hills(12, 3, 0)));
  const BothWays both(mesh);
  const firmware::CopyMesh &apart = both.apart.copy().mesh(0), &in_place = both.in_place.copy().mesh(0);
  EXPECT_FALSE(apart.vertices_in_rom);
  ASSERT_TRUE(in_place.vertices_in_rom);
  EXPECT_EQ(in_place.vertex_count, 169u);
  EXPECT_EQ(in_place.normal_offset, kNoStream);
  EXPECT_EQ(in_place.texture_coordinate_offset, kNoStream);
  ASSERT_LT(in_place.faces, 288u);
  EXPECT_EQ(both.in_place.copy().block_bytes(0), (2 * in_place.index_count + 3) / 4 * 4) << "two bytes an index";

  const auto indices = both.in_place.indices(0), of_apart = both.apart.indices(0);
  const auto places = both.apart.positions(0);
  const auto normals = both.apart.stream<PackedNormal>(0, apart.normal_offset);
  const auto coordinates = both.apart.stream<TexCoord>(0, apart.texture_coordinate_offset);
  ASSERT_EQ(indices.size(), of_apart.size());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    ASSERT_LT(indices[i], 169u);
    EXPECT_EQ(mesh.positions[indices[i]], places[of_apart[i]]);
    EXPECT_EQ(mesh.normals[indices[i]], normals[of_apart[i]]);
    EXPECT_EQ(mesh.texture_coordinates[indices[i]], coordinates[of_apart[i]]);
  }
}

TEST(InPlace, VertexDeletionLeavesItsVerticesInRomToo) {
  TestMesh mesh = with_normals(mapped_hills(12, 3, 0));
  mesh.method = firmware::format::Method::kVertexDeletion;
  const BothWays both(mesh);
  ASSERT_TRUE(both.in_place.copy().mesh(0).vertices_in_rom);
  ASSERT_LT(both.in_place.copy().mesh(0).faces, 288u);
  const auto indices = both.in_place.indices(0), of_apart = both.apart.indices(0);
  const auto places = both.apart.positions(0);
  const auto coordinates = both.apart.stream<TexCoord>(0, both.apart.copy().mesh(0).texture_coordinate_offset);
  ASSERT_EQ(indices.size(), of_apart.size());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    EXPECT_EQ(mesh.positions[indices[i]], places[of_apart[i]]);
    EXPECT_EQ(mesh.texture_coordinates[indices[i]], coordinates[of_apart[i]]);
  }
}

TEST(InPlace, TheReportSaysWhatStayedInRom) {
  const BothWays both(by_half_edge(with_normals(mapped_hills(12, 3, 0))));
  const auto indices = both.in_place.indices(0);
  const std::uint64_t kept = std::set<std::uint32_t>(indices.begin(), indices.end()).size();
  EXPECT_EQ(both.in_place.report.bytes_left_in_rom, kept * (12 + 4 + 8));
  EXPECT_EQ(both.apart.report.bytes_left_in_rom, 0u);
  EXPECT_EQ(both.apart.report.copy_bytes - both.in_place.report.copy_bytes, kept * (12 + 4 + 8));
}

TEST(InPlace, NormalsThatRomHasNotAreMadeInRamForTheVerticesThere) {
  TestMesh mesh = by_half_edge(hills(12, 3));
  mesh.quota_kind = firmware::format::QuotaKind::kMillionths;
  mesh.quota = 800'000;
  const BothWays both(mesh);
  const firmware::CopyMesh& in_place = both.in_place.copy().mesh(0);
  ASSERT_TRUE(in_place.vertices_in_rom);
  ASSERT_NE(in_place.normal_offset, kNoStream);
  const auto normals = both.in_place.stream<PackedNormal>(0, in_place.normal_offset);
  const auto expected = both.apart.stream<PackedNormal>(0, both.apart.copy().mesh(0).normal_offset);
  const auto indices = both.in_place.indices(0), of_apart = both.apart.indices(0);
  ASSERT_EQ(indices.size(), of_apart.size());
  for (std::size_t i = 0; i < indices.size(); ++i) EXPECT_EQ(normals[indices[i]], expected[of_apart[i]]) << i;
  EXPECT_LT(both.in_place.report.copy_bytes, both.apart.report.copy_bytes);
  EXPECT_LT(both.in_place.report.bytes_left_in_rom, 169u * 12);
}

TEST(InPlace, WhereMadeNormalsWouldTakeMoreThanTheVerticesTheseAreCopied) {
  TestMesh mesh = by_half_edge(hills(12, 3));
  mesh.quota_kind = firmware::format::QuotaKind::kFaces;
  mesh.quota = 8;  // some ten vertices of 16 bytes, against normals for 169
  const BothWays both(mesh);
  EXPECT_FALSE(both.in_place.copy().mesh(0).vertices_in_rom);
  EXPECT_EQ(both.in_place.report.copy_bytes, both.apart.report.copy_bytes);
  EXPECT_EQ(both.in_place.report.bytes_left_in_rom, 0u);
}

TEST(InPlace, GroupsKeepTheirEnds) {
  const BothWays both(by_half_edge(with_normals(two_hills(6, 3, 0, 4))));
  ASSERT_TRUE(both.in_place.copy().mesh(0).vertices_in_rom);
  const auto ends = both.in_place.copy().group_words(0), expected = both.apart.copy().group_words(0);
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_EQ(ends[0], expected[0]);
  EXPECT_EQ(ends[1], expected[1]);
  const auto indices = both.in_place.indices(0);
  for (std::size_t i = 0; i < indices.size(); ++i) EXPECT_EQ(indices[i] < 49, i < 3 * std::size_t{ends[0]});
}

TEST(InPlace, OtherMethodsAndWholeMeshesAreCopied) {
  const std::vector<TestMesh> meshes{with_normals(hills(6, 3)), by_half_edge(with_normals(hills(6, 1)))};
  ThinningBench bench(container_rom(meshes), kRam, true);
  ASSERT_TRUE(bench.update().ok());
  EXPECT_FALSE(bench.copy().mesh(0).vertices_in_rom) << "quadric errors move vertices";
  EXPECT_FALSE(bench.copy().mesh(1).vertices_in_rom);
  EXPECT_EQ(bench.positions(1), meshes[1].positions);
}

TEST(InPlace, BareDataByAMethodFromOutsideToo) {
  firmware::ThinningSettings settings;
  settings.method_override = {true, firmware::Method::kHalfEdge};
  const TestMesh strip = as_strip(hills(6, 3));
  ThinningBench bench(bare_rom({strip}), kRam, true);
  ASSERT_TRUE(bench.update(settings).ok());
  EXPECT_TRUE(bench.copy().sound());
  EXPECT_LE(bench.copy().mesh(0).faces, 36u);
  const auto places = bench.copy().mesh(0).vertices_in_rom ? strip.positions : bench.positions(0);
  for (const std::uint32_t v : bench.indices(0)) ASSERT_LT(v, places.size());
}

TEST(InPlace, TheCopyIsWordForWordTheSameAfterOthersWereDropped) {
  // The block is moved down in memory when the mesh before it goes; its indices name ROM's vertices still.
  TestMesh deletable = hills(6, 2);
  firmware::ThinningSettings kept, deleted;
  kept.delete_policy.kind = firmware::PolicyKind::kChosen;
  ThinningBench bench(container_rom({deletable, by_half_edge(with_normals(hills(8, 3)))}), kRam, true);
  ASSERT_TRUE(bench.update(kept).ok());
  ASSERT_TRUE(bench.copy().present(0));
  const auto before = bench.indices(1);
  const std::uint64_t left = bench.report.bytes_left_in_rom;
  ASSERT_TRUE(bench.update(deleted).ok());
  ASSERT_FALSE(bench.copy().present(0));
  EXPECT_EQ(bench.indices(1), before);
  EXPECT_EQ(bench.report.bytes_left_in_rom, left) << "told in every frame";
}

}  // namespace
}  // namespace usuzumi
