// Meshes drawn from their chains of layers: what is in the copy, what an update costs, and what becomes of them when
// memory or the chain itself is bad.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <cmath>
#include <vector>

#include "firmware/layers/middle_layer.h"
#include "firmware/thinning/thinning.h"
#include "tests/support/test_layers.h"
#include "tests/support/thinning_bench.h"

namespace usuzumi {
namespace {

using firmware::BuildOutcome;
using firmware::LayerChainView;
using firmware::LayerMode;
using firmware::ThinningSettings;
using firmware::UpdateCause;
using testing::container_rom;
using testing::flat_view;
using testing::hills;
using testing::RomImage;
using testing::TestMesh;
using testing::ThinningBench;
using Method = firmware::format::Method;
using QuotaKind = firmware::format::QuotaKind;

constexpr std::uint32_t kQuotas[] = {1'000'000, 600'000, 360'000, 216'000};
constexpr std::uint32_t kAll = 800;  // faces of hills(20)

TestMesh smooth_hills(Method method, std::uint32_t n = 20) {
  TestMesh mesh = testing::with_smooth_normals(hills(n, 3));
  mesh.method = method;
  return mesh;
}

TestMesh layered_hills(Method method) { return testing::with_layers(smooth_hills(method), kQuotas); }

ThinningSettings with_faces(std::uint32_t faces, LayerMode mode = LayerMode::kFaces) {
  ThinningSettings settings;
  settings.quota = {QuotaKind::kFaces, faces};
  settings.layers.mode = mode;
  return settings;
}

using Face = std::array<std::array<float, 3>, 3>;

/// The faces that are drawn, by place: the live slots of a layered block, all of any other.
std::multiset<Face> drawn_faces(const ThinningBench& bench, std::uint32_t n) {
  const auto positions = bench.positions(n);
  const auto indices = bench.indices(n);
  const std::size_t live = bench.copy().mesh(n).layered ? bench.copy().group_words(n)[0] : indices.size() / 3;
  std::multiset<Face> faces;
  for (std::size_t f = 0; f < live; ++f) {
    Face face;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = positions[indices[3 * f + k]];
      face[k] = {p.x, p.y, p.z};
    }
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    faces.insert(face);
  }
  return faces;
}

std::vector<std::byte> block_of(const ThinningBench& bench, std::uint32_t n) {
  return {bench.copy().block(n), bench.copy().block(n) + bench.copy().block_bytes(n)};
}

class LayersOfMethod : public ::testing::TestWithParam<Method> {};
/// Vertex deletion for layers fills by fans alone.
class LayersAsWithout : public ::testing::TestWithParam<Method> {};

TEST_P(LayersAsWithout, AQuotaIsReachedWithTheFacesThatTheMethodMakes) {
  ThinningBench layered(container_rom({layered_hills(GetParam())}));
  ThinningBench searched(container_rom({smooth_hills(GetParam())}));
  const std::uint32_t quota = 216 * kAll / 1000;
  ASSERT_TRUE(layered.update(with_faces(quota)).ok());
  ASSERT_TRUE(searched.update(with_faces(quota)).ok());
  ASSERT_TRUE(layered.copy().mesh(0).layered);
  EXPECT_EQ(layered.report.meshes_layered, 1u);
  EXPECT_FALSE(searched.copy().mesh(0).layered);
  EXPECT_EQ(layered.copy().mesh(0).faces, searched.copy().mesh(0).faces);
  EXPECT_EQ(drawn_faces(layered, 0), drawn_faces(searched, 0));
}

TEST_P(LayersOfMethod, AnotherQuotaReplaysWhatLiesBetweenAndBuildsNothing) {
  ThinningBench bench(container_rom({layered_hills(GetParam())}));
  ASSERT_TRUE(bench.update(with_faces(600)).ok());
  const auto before = block_of(bench, 0);
  const LayerChainView chain = bench.thinning.layers(0)->view();
  std::uint64_t between = 0;
  for (std::uint32_t s = 0; s < chain.step_count(); ++s)
    if (chain.faces_at(s) <= 600 && chain.faces_at(s) > 400) between += chain.changes(s).size();
  ASSERT_GT(between, 0u);
  for (const std::uint32_t faces : {400u, 600u}) {
    const auto replayed = bench.clock.charged(CpuWork::kCornerReplayed);
    const auto costed = bench.clock.charged(CpuWork::kEdgeCosted);
    ASSERT_TRUE(bench.update(with_faces(faces)).ok());
    EXPECT_EQ(bench.report.cause, UpdateCause::kLayers);
    EXPECT_EQ(bench.report.meshes_built, 0u);
    EXPECT_EQ(bench.report.meshes_moved, 1u);
    EXPECT_LE(bench.report.faces_out, faces);
    EXPECT_GE(bench.report.faces_out, faces - 7) << "one deletion takes six faces at most in a plane";
    EXPECT_EQ(bench.clock.charged(CpuWork::kCornerReplayed) - replayed, between);
    EXPECT_EQ(bench.clock.charged(CpuWork::kEdgeCosted), costed) << "no search";
  }
  EXPECT_EQ(block_of(bench, 0), before);
  ASSERT_TRUE(bench.update(with_faces(600)).ok());
  EXPECT_EQ(bench.report.cause, UpdateCause::kUnchanged);
  EXPECT_EQ(bench.report.meshes_moved, 0u);
}

/// How far `faces` are on the way from a layer of `above` faces to one of `below`.
float way(float above, float faces, float below) {
  return (std::sqrt(above) - std::sqrt(faces)) / (std::sqrt(above) - std::sqrt(below));
}

TEST_P(LayersOfMethod, BetweenTwoLayersVerticesStandBetweenThem) {
  ThinningBench bench(container_rom({layered_hills(GetParam())}));
  ASSERT_TRUE(bench.update(with_faces(kAll, LayerMode::kQuota)).ok());
  const auto store = bench.positions(0);
  const LayerChainView chain = bench.thinning.layers(0)->view();
  const std::uint32_t above = chain.layer(1).faces, below = chain.layer(2).faces;
  const std::uint32_t between = (above + 2 * below) / 3;
  const float w =
      way(static_cast<float>(above), static_cast<float>(between), static_cast<float>(below));
  ASSERT_TRUE(bench.update(with_faces(between, LayerMode::kQuota)).ok());
  EXPECT_FLOAT_EQ(bench.thinning.drawn_layer(0), 1 + w);
  EXPECT_EQ(bench.report.faces_out, above);
  auto expected = store;
  ASSERT_FALSE(chain.pairs(1).empty());
  for (const auto& pair : chain.pairs(1)) expected[pair.from] = store[pair.from] * (1 - w) + store[pair.vertex()] * w;
  const auto drawn = bench.positions(0);
  for (std::size_t v = 0; v < drawn.size(); ++v)
    EXPECT_LT(dot(drawn[v] - expected[v], drawn[v] - expected[v]), 1e-12f) << v;
  // In the next layer all of them stand where they were put, and others set out.
  ASSERT_TRUE(bench.update(with_faces(below, LayerMode::kQuota)).ok());
  EXPECT_EQ(bench.positions(0), store);
  EXPECT_EQ(bench.report.faces_out, below);
}

INSTANTIATE_TEST_SUITE_P(Methods, LayersAsWithout,
                         ::testing::Values(Method::kQem, Method::kEdgeRemoval, Method::kHalfEdge));
INSTANTIATE_TEST_SUITE_P(Methods, LayersOfMethod,
                         ::testing::Values(Method::kQem, Method::kEdgeRemoval, Method::kHalfEdge,
                                           Method::kVertexDeletion));

TEST(Layers, AQuotaBeyondTheLastLayerIsLeftToTheMethod) {
  ThinningBench bench(container_rom({layered_hills(Method::kQem)}));
  ASSERT_TRUE(bench.update(with_faces(100)).ok());
  EXPECT_FALSE(bench.copy().mesh(0).layered);
  EXPECT_LE(bench.report.faces_out, 100u);
  EXPECT_LT(bench.thinning.drawn_layer(0), 0);
  // Where nothing may jump the last layer is the coarsest, and the quota is missed.
  ASSERT_TRUE(bench.update(with_faces(100, LayerMode::kQuota)).ok());
  EXPECT_EQ(bench.thinning.drawn_layer(0), 3);
  EXPECT_EQ(bench.report.quotas_missed, 1u);
}

TEST(Layers, PartsOfAFaceMoveAMeshBetweenItsLayersToo) {
  const TestMesh mesh = layered_hills(Method::kQem);
  ThinningBench bench(container_rom({mesh, mesh}));
  ThinningSettings settings;
  settings.layers.mode = LayerMode::kQuota;
  const auto expect_faces = [&](firmware::Quota quota, float faces) {
    settings.quota = quota;
    ASSERT_TRUE(bench.update(settings).ok());
    for (const std::uint32_t n : {0u, 1u}) {
      const LayerChainView chain = bench.thinning.layers(n)->view();
      const auto above = static_cast<float>(chain.layer(1).faces), below = static_cast<float>(chain.layer(2).faces);
      EXPECT_FLOAT_EQ(bench.thinning.drawn_layer(n), 1 + way(above, faces, below)) << faces;
    }
  };
  expect_faces({QuotaKind::kMillionths, 500'000}, 400);
  expect_faces({QuotaKind::kMillionths, 500'600}, 400.48f);
  expect_faces({QuotaKind::kFaces, 2 * 400 + 1}, 400.5f);  // shared by both
}

TEST(Layers, AnotherMethodThanTheChainsThinsWithoutIt) {
  ThinningBench bench(container_rom({layered_hills(Method::kQem)}));
  ThinningSettings settings = with_faces(400);
  settings.method_override = {true, firmware::Method::kHalfEdge};
  ASSERT_TRUE(bench.update(settings).ok());
  EXPECT_FALSE(bench.copy().mesh(0).layered);
  settings = with_faces(400);
  settings.placement = firmware::Placement::kMidpoint;
  ASSERT_TRUE(bench.update(settings).ok());
  EXPECT_FALSE(bench.copy().mesh(0).layered);
  ASSERT_TRUE(bench.update(with_faces(400)).ok());
  EXPECT_TRUE(bench.copy().mesh(0).layered);
}

TEST(Layers, ThinningOffDrawsTheWholeMesh) {
  ThinningBench bench(container_rom({layered_hills(Method::kQem)}));
  ThinningSettings settings = with_faces(400, LayerMode::kAutomatic);
  settings.enabled = false;
  ASSERT_TRUE(bench.update(settings).ok());
  EXPECT_EQ(bench.report.faces_out, kAll);
  EXPECT_FALSE(bench.copy().mesh(0).layered);
}

/// The picture at a distance: a square of 2 / scale.
firmware::View scaled_view(float scale) {
  firmware::View view = flat_view();
  view.model_to_clip.m[0] = view.model_to_clip.m[5] = scale;
  return view;
}

TEST(Layers, TheAutomaticLayerFollowsSizeDownToTheQuota) {
  ThinningBench bench(container_rom({layered_hills(Method::kQem)}));
  ThinningSettings settings;
  settings.layers.mode = LayerMode::kAutomatic;
  // 100 pixels wide: a diagonal of 141 pixels is worth 20,000 / 16 faces, more than there are.
  ASSERT_TRUE(bench.update(settings, scaled_view(1)).ok());
  EXPECT_EQ(bench.thinning.drawn_layer(0), 0);
  // A fourteenth of that is worth less than the last layer: nobody gave a quota, so that is the end; a 32nd of a layer
  // a frame.
  ASSERT_TRUE(bench.update(settings, scaled_view(0.05f)).ok());
  EXPECT_EQ(bench.thinning.drawn_layer(0), 1.0f / 32);
  for (int i = 0; i < 96; ++i) ASSERT_TRUE(bench.update(settings, scaled_view(0.05f)).ok());
  EXPECT_EQ(bench.thinning.drawn_layer(0), 3);
  EXPECT_EQ(bench.report.faces_out, bench.thinning.layers(0)->view().layer(3).faces);
  // With a quota of 60 % that is the coarsest.
  settings.quota = {QuotaKind::kMillionths, 600'000};
  ASSERT_TRUE(bench.update(settings, scaled_view(0.05f)).ok());
  EXPECT_EQ(bench.thinning.drawn_layer(0), 1);
  EXPECT_EQ(bench.report.meshes_built, 0u);
}

TEST(Layers, AMeshDrawnWholeSetsOutFromItsFirstLayer) {
  TestMesh mesh = layered_hills(Method::kQem);
  mesh.area_threshold_px = 2000;
  ThinningBench bench(container_rom({mesh}));
  ThinningSettings settings;
  settings.layers.mode = LayerMode::kAutomatic;
  ASSERT_TRUE(bench.update(settings, scaled_view(1)).ok());
  EXPECT_FALSE(bench.copy().mesh(0).layered);
  ASSERT_TRUE(bench.update(settings, scaled_view(0.05f)).ok());
  EXPECT_EQ(bench.thinning.drawn_layer(0), 1.0f / 32);
}

TEST(Layers, VerticesStayInRomWhereTheMethodMakesNoneAndNoneMoves) {
  ThinningBench bench(container_rom({layered_hills(Method::kHalfEdge)}), 1 << 20, true);
  ASSERT_TRUE(bench.update(with_faces(400)).ok());
  EXPECT_TRUE(bench.copy().mesh(0).vertices_in_rom);
  EXPECT_EQ(bench.copy().block_bytes(0), 3 * kAll * 2 + 4u);
  EXPECT_EQ(bench.report.bytes_left_in_rom, 441u * 16);
  ASSERT_TRUE(bench.update(with_faces(400, LayerMode::kQuota)).ok());
  EXPECT_FALSE(bench.copy().mesh(0).vertices_in_rom);
  EXPECT_EQ(bench.copy().block_bytes(0), 441 * 16 + 3 * kAll * 2 + 4u);
}

/// As much RAM as the blocks of eight meshes take, none for the tables: layers must be given up, and there is room
/// enough to thin in.
class ShortOfRam : public ::testing::Test {
 protected:
  static std::size_t blocks_bytes(const RomImage& rom) {
    ThinningBench roomy(rom);
    EXPECT_TRUE(roomy.update(with_faces(8 * 400)).ok());
    EXPECT_EQ(roomy.report.meshes_layered, 8u);
    return roomy.copy().used_bytes();
  }

  RomImage rom = container_rom(std::vector<TestMesh>(8, layered_hills(Method::kQem)));
  ThinningBench bench{rom, blocks_bytes(rom)};
};

TEST_F(ShortOfRam, MeshesAreThinnedWithoutTheirLayers) {
  ASSERT_TRUE(bench.update(with_faces(8 * 400)).ok());
  EXPECT_TRUE(bench.report.layers_given_up);
  EXPECT_EQ(bench.report.meshes_layered, 0u);
  EXPECT_EQ(bench.report.quota_halvings, 0u);
  for (std::uint32_t n = 0; n < 8; ++n) EXPECT_EQ(bench.copy().mesh(n).faces, 400u);
  EXPECT_TRUE(bench.copy().sound());
  ASSERT_TRUE(bench.update(with_faces(8 * 400)).ok());
  EXPECT_EQ(bench.report.cause, UpdateCause::kUnchanged) << "no second try";
}

TEST_F(ShortOfRam, MeshesFollowTheirQuotaAllTheSame) {
  ASSERT_TRUE(bench.update(with_faces(8 * 400)).ok());
  ASSERT_TRUE(bench.update(with_faces(8 * 300)).ok());
  EXPECT_TRUE(bench.report.layers_given_up);
  EXPECT_EQ(bench.report.faces_out, 8 * 300u);
}

TEST_F(ShortOfRam, WithoutAQuotaMeshesHaveHalfOfTheirFacesAsIfTheyHadNoLayers) {
  ThinningSettings settings;
  settings.layers.mode = LayerMode::kAutomatic;
  ASSERT_TRUE(bench.update(settings, scaled_view(0.05f)).ok());
  EXPECT_TRUE(bench.report.layers_given_up);
  EXPECT_EQ(bench.report.faces_out, 8 * kAll / 2);
}

/// A change names another vertex than the corner has.
void spoil(TestMesh& mesh) {
  const auto good = LayerChainView::of_checked(std::as_bytes(std::span(mesh.layers)));
  const auto change = static_cast<std::size_t>(reinterpret_cast<const std::byte*>(good.changes(5).data()) -
                                               reinterpret_cast<const std::byte*>(mesh.layers.data()));
  mesh.layers[change / 4 + 1] ^= 1;
}

TEST(Layers, AChainThatContradictsItselfIsNotUsed) {
  TestMesh mesh = layered_hills(Method::kQem);
  spoil(mesh);
  ThinningBench bench(container_rom({mesh}));
  ASSERT_TRUE(bench.update(with_faces(400)).ok());
  EXPECT_EQ(bench.report.chains_refused, 1u);
  EXPECT_FALSE(bench.copy().mesh(0).layered);
  EXPECT_LE(bench.report.faces_out, 400u);
  EXPECT_TRUE(bench.copy().sound());
  ASSERT_TRUE(bench.update(with_faces(400)).ok());
  EXPECT_EQ(bench.report.cause, UpdateCause::kUnchanged);
}

TEST(Layers, AChainThatContradictsItselfChangesNothingInTheNextFrame) {
  TestMesh mesh = layered_hills(Method::kQem);
  spoil(mesh);
  ThinningBench bench(container_rom({mesh}));
  ThinningSettings settings;
  settings.layers.mode = LayerMode::kAutomatic;
  for (const UpdateCause cause : {UpdateCause::kFirst, UpdateCause::kUnchanged}) {
    ASSERT_TRUE(bench.update(settings, scaled_view(0.05f)).ok());
    EXPECT_EQ(bench.report.cause, cause);
    EXPECT_LE(bench.report.faces_out, kAll / 2);
    EXPECT_GT(bench.report.faces_out, kAll / 2 - 7) << "half of its faces, as of any mesh without a quota";
  }
}

TEST(BootLayers, AreMadeForMeshesThatHaveNone) {
  ThinningBench bench(container_rom({smooth_hills(Method::kHalfEdge), hills(4, 1), layered_hills(Method::kQem)}),
                      4 << 20, false, kQuotas);
  ASSERT_TRUE(bench.begin_status.ok());
  ASSERT_NE(bench.thinning.layers(0), nullptr);
  EXPECT_EQ(bench.thinning.layers(1), nullptr);
  EXPECT_EQ(bench.thinning.layers(0)->view().layer(1).faces, 480u);
  ThinningSettings settings;
  settings.quota = {QuotaKind::kMillionths, 360'000};
  ASSERT_TRUE(bench.update(settings).ok());
  EXPECT_EQ(bench.report.meshes_layered, 2u);
  EXPECT_EQ(bench.thinning.drawn_layer(0), 2);
}

TEST(BootLayers, LeaveRoomForEveryMesh) {
  // To make the chains takes less RAM than the large mesh that must be drawn: it would be there at boot, and then not.
  TestMesh large = hills(120, 1);
  large.normals.assign(large.positions.size(), pack_normal({0, 0, 1}));
  const std::vector<TestMesh> meshes{smooth_hills(Method::kQem), large, smooth_hills(Method::kQem)};
  ThinningBench roomy(container_rom(meshes), 4 << 20);
  ThinningSettings whole;
  whole.enabled = false;
  ASSERT_TRUE(roomy.update(whole).ok());
  const std::size_t bytes = roomy.copy().used_bytes();
  bool with_one = false;
  for (std::size_t ram = bytes + 1024; ram < bytes + 300'000; ram += 10'000) {
    ThinningBench bench(container_rom(meshes), ram, false, kQuotas);
    ASSERT_TRUE(bench.begin_status.ok()) << ram;
    ASSERT_TRUE(bench.update(whole).ok()) << ram;
    ASSERT_TRUE(bench.update(with_faces(800)).ok()) << ram;
    EXPECT_FALSE(bench.report.layers_given_up) << ram;
    with_one = with_one || bench.report.meshes_layered == 1;
  }
  EXPECT_TRUE(with_one) << "no size had room for one chain alone";
}

TEST(BootLayers, LeaveRoomForTheLayersInRom) {
  // So many that room for thinning one hides nothing.
  std::vector<TestMesh> meshes(200, testing::with_layers(smooth_hills(Method::kQem, 8), kQuotas));
  for (int i = 0; i < 20; ++i) meshes.push_back(smooth_hills(Method::kQem, 8));
  const RomImage rom = container_rom(meshes);
  ThinningSettings settings;
  settings.layers.mode = LayerMode::kQuota;
  bool with_all = false;
  for (std::size_t ram = 650'000; ram < 1'000'000; ram += 10'000) {
    ThinningBench without(rom, ram), bench(rom, ram, false, kQuotas);
    ASSERT_TRUE(without.update(settings).ok()) << ram;
    ASSERT_TRUE(bench.update(settings).ok()) << ram;
    EXPECT_EQ(bench.report.layers_given_up, without.report.layers_given_up) << ram;
    with_all = with_all || bench.report.meshes_layered == 220;
  }
  EXPECT_TRUE(with_all);
}

TEST(BootLayers, QuotasThatDoNotFallAreRefused) {
  constexpr std::uint32_t kRising[] = {1'000'000, 360'000, 600'000};
  ThinningBench bench(container_rom({smooth_hills(Method::kQem)}), 1 << 20, false, kRising);
  EXPECT_EQ(bench.begin_status.code, StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace usuzumi
