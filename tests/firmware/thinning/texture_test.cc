// What textured meshes and those of several materials become in the RAM copy, and by which method.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "firmware/thinning/thinning.h"
#include "tests/support/thinning_bench.h"

namespace usuzumi {
namespace {

using firmware::kNoStream;
using firmware::Method;
using firmware::ThinningSettings;
using testing::container_rom;
using testing::five_materials;
using testing::hills;
using testing::mapped_hills;
using testing::square;
using testing::TestMesh;
using testing::ThinningBench;
using testing::two_hills;

std::vector<TexCoord> coordinates(const ThinningBench& bench, std::uint32_t n) {
  return bench.stream<TexCoord>(n, bench.copy().mesh(n).texture_coordinate_offset);
}

TEST(Textures, AWholeMeshKeepsItsCoordinatesWordForWord) {
  ThinningSettings off;
  off.enabled = false;
  for (const auto& [level, settings] : {std::pair{1u, ThinningSettings{}}, std::pair{3u, off}}) {
    const TestMesh mesh = mapped_hills(4, level, 0);
    ThinningBench bench(container_rom({mesh}, five_materials()));
    ASSERT_TRUE(bench.update(settings).ok());
    EXPECT_EQ(coordinates(bench, 0), mesh.texture_coordinates);
    EXPECT_EQ(bench.positions(0), mesh.positions);
    EXPECT_TRUE(bench.copy().sound());
  }
}

TEST(Textures, AStripKeepsItsCoordinatesToo) {
  TestMesh strip = square(1, 1);
  strip.texture_coordinates = {{0, 1}, {1, 1}, {0, 0}, {1, 0}};
  strip.material = 0;
  ThinningBench bench(container_rom({strip}, five_materials()));
  ASSERT_TRUE(bench.update().ok());
  EXPECT_EQ(coordinates(bench, 0), strip.texture_coordinates);
}

TEST(Textures, CoordinatesWithoutATextureTakeNoRoom) {
  for (const std::uint32_t level : {1u, 3u, 4u, 5u}) {
    ThinningBench with(container_rom({mapped_hills(6, level, 1)}, five_materials()));
    ThinningBench without(container_rom({hills(6, level)}));
    ASSERT_TRUE(with.update().ok());
    ASSERT_TRUE(without.update().ok());
    EXPECT_EQ(with.copy().mesh(0).texture_coordinate_offset, kNoStream);
    EXPECT_EQ(with.copy().block_bytes(0), without.copy().block_bytes(0)) << "level " << level;
    EXPECT_EQ(with.report.peak_bytes, without.report.peak_bytes) << "level " << level;
  }
}

TEST(Textures, CoordinatesOfAThinnedMeshStayWithTheirPlaces) {
  ThinningBench bench(container_rom({mapped_hills(16, 3, 0)}, five_materials()));
  ASSERT_TRUE(bench.update().ok());
  ASSERT_LE(bench.copy().mesh(0).faces, 256u);
  const auto places = bench.positions(0);
  const auto mapped = coordinates(bench, 0);
  ASSERT_EQ(mapped.size(), places.size());
  for (std::size_t v = 0; v < places.size(); ++v) {  // within half a cell of the grid, as places are moved off edges
    EXPECT_NEAR(mapped[v].s, (places[v].x + 1) / 2, 1.0 / 32);
    EXPECT_NEAR(mapped[v].t, (1 - places[v].y) / 2, 1.0 / 32);
  }
  EXPECT_TRUE(bench.copy().sound());
}

TEST(Textures, CoordinatesAreCopiedAsPartOfTheirVertices) {
  ThinningBench with(container_rom({mapped_hills(6, 1, 0)}, five_materials()));
  ASSERT_TRUE(with.update().ok());
  EXPECT_EQ(with.clock.charged(CpuWork::kVertexCopied), 49u);
  EXPECT_EQ(with.copy().block_bytes(0), 49u * (12 + 4 + 8) + 72 * 3 * 4) << "normals are made";
}

TEST(Textures, APointAndALineKeepTheCoordinatesOfTheirVertices) {
  TestMesh rod;
  rod.positions = {{-1, 0, 0}, {-0.5f, 0.1f, 0}, {0.1f, 0, 0}, {0.5f, 0.1f, 0}, {1, 0, 0}};
  rod.texture_coordinates = {{0, 1}, {1, 1}, {2, 1}, {3, 1}, {4, 1}};
  rod.material = 0;
  rod.level = 4;
  TestMesh line = rod;
  line.level = 5;
  ThinningBench bench(container_rom({rod, line}, five_materials()));
  ASSERT_TRUE(bench.update().ok());
  EXPECT_EQ(coordinates(bench, 0), (std::vector<TexCoord>{{2, 1}}));
  EXPECT_EQ(coordinates(bench, 1), (std::vector<TexCoord>{{0, 1}, {4, 1}}));
  EXPECT_TRUE(bench.copy().sound());
}

TEST(Groups, AWholeMeshHasThoseOfTheDrawingData) {
  const TestMesh mesh = two_hills(4, 1, 0, 4);
  ThinningBench bench(container_rom({mesh}, five_materials()));
  ASSERT_TRUE(bench.update().ok());
  EXPECT_TRUE(bench.copy().group_words(0).empty());
  EXPECT_EQ(bench.indices(0), mesh.indices);
}

TEST(Groups, OfAThinnedMeshEndWhereItsFacesDo) {
  TestMesh mesh = two_hills(8, 3, 0, 4);
  for (std::size_t k = 0; k < 3; ++k) mesh.indices[k] = mesh.indices[0];  // no face: the groups lose it at once
  ThinningBench bench(container_rom({mesh}, five_materials()));
  ASSERT_TRUE(bench.update().ok());
  const auto ends = bench.copy().group_words(0);
  const auto indices = bench.indices(0);
  const auto places = bench.positions(0);
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_LT(ends[0], 127u);
  EXPECT_EQ(ends[1], bench.copy().mesh(0).faces);
  for (std::size_t i = 0; i < indices.size(); ++i)
    EXPECT_EQ(places[indices[i]].x < 1.5f, i < 3 * std::size_t{ends[0]}) << "the second hills lie 3 to the right";
  EXPECT_TRUE(bench.copy().sound());
}

TEST(Groups, APointHasTheGroupOfItsVertexAndALineThatOfItsFirst) {
  TestMesh mesh;  // an outlying vertex of the first material, three of the second
  mesh.positions = {{-9, 0, 0}, {-9, 1, 0}, {-8, 0, 0}, {2, 0, 0}, {3, 0, 0}, {2, 1, 0}, {3, 1, 0}};
  mesh.indices = {0, 1, 2, 3, 4, 5, 5, 4, 6};
  mesh.texture_coordinates = {{1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}, {6, 0}, {7, 0}};
  mesh.groups = {{1, 3, 0, 0}, {3, 7, 4, 0}};
  mesh.level = 4;
  TestMesh line = mesh;
  line.level = 5;
  ThinningBench bench(container_rom({mesh, line}, five_materials()));
  ASSERT_TRUE(bench.update().ok());
  EXPECT_EQ(bench.positions(0)[0], (Vec3{2, 0, 0})) << "nearest to the mean, (-2.3, 0.4)";
  ASSERT_EQ(bench.copy().group_words(0).size(), 1u);
  EXPECT_EQ(bench.copy().group_words(0)[0], 1u);
  EXPECT_EQ(bench.positions(1), (std::vector<Vec3>{{-9, 1, 0}, {3, 0, 0}}));
  EXPECT_EQ(bench.copy().group_words(1)[0], 0u);
  EXPECT_EQ(coordinates(bench, 1), (std::vector<TexCoord>{{2, 0}, {2, 0}})) << "the other end's is of another image";
  EXPECT_TRUE(bench.copy().sound());
}

TEST(Methods, AreTheAuthorsUnlessTheSettingsSayOtherwise) {
  std::vector<TestMesh> meshes;
  for (std::uint32_t m = 0; m < firmware::kMethodCount; ++m) {
    meshes.push_back(hills(6, 3));
    meshes.back().method = static_cast<firmware::format::Method>(m);
  }
  ThinningBench bench(container_rom(meshes));
  ASSERT_TRUE(bench.update().ok());
  for (std::uint32_t m = 0; m < firmware::kMethodCount; ++m)
    EXPECT_EQ(bench.thinning.state(m).decision.method, static_cast<Method>(m));
  ThinningSettings settings;
  settings.method_override = {true, Method::kQem};
  ASSERT_TRUE(bench.update(settings).ok());
  EXPECT_EQ(bench.report.meshes_built, 3u) << "those of other methods are thinned anew";
  ThinningBench all_qem(container_rom(std::vector<TestMesh>(4, hills(6, 3))));
  ASSERT_TRUE(all_qem.update().ok());
  for (std::uint32_t m = 0; m < firmware::kMethodCount; ++m) {
    EXPECT_EQ(bench.thinning.state(m).decision.method, Method::kQem);
    EXPECT_EQ(bench.positions(m), all_qem.positions(m));
  }
}

TEST(Memory, EverySizeOfRamEndsInASoundTexturedCopyOrASentence) {
  TestMesh point = two_hills(2, 4, 0, 4), line = two_hills(2, 5, 4, 0);
  TestMesh half_edge = mapped_hills(6, 3, 0);
  half_edge.method = firmware::format::Method::kHalfEdge;
  const std::vector<TestMesh> meshes{mapped_hills(6, 3, 0), two_hills(4, 3, 2, 3), point,
                                     line,                  mapped_hills(3, 0, 4), half_edge};
  bool thinned = false, dropped = false;
  for (const bool rom_on_bus : {false, true})
    for (std::size_t ram = 0; ram < 40000; ram += 100) {
      ThinningBench bench(container_rom(meshes, five_materials()), ram, rom_on_bus);
      if (!bench.begin_status.ok()) continue;
      const Status status = bench.update();
      EXPECT_TRUE(bench.copy().sound()) << ram;
      EXPECT_TRUE(status.ok() || status.code == StatusCode::kResourceExhausted) << ram;
      EXPECT_LE(bench.report.peak_bytes, ram);
      thinned = thinned || bench.report.meshes_collapsed >= 2;
      dropped = dropped || bench.report.meshes_dropped > 0;
      for (std::uint32_t n = 0; n < meshes.size(); ++n)
        EXPECT_TRUE(!bench.copy().present(n) || bench.copy().mesh(n).vertices_in_rom ||
                    bench.copy().mesh(n).texture_coordinate_offset != kNoStream)
            << "mesh " << n << ", RAM " << ram;
    }
  EXPECT_TRUE(thinned && dropped) << "the sizes reach from too little to enough";
}

}  // namespace
}  // namespace usuzumi
