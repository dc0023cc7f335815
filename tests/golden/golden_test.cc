// Every golden scene: exactly its golden on the software engine, by whatever route; and close to OSMesa's llvmpipe.
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <ostream>

#include "gfx_subsystem/engine_osmesa/osmesa_engine.h"
#include "sim/image/compare.h"
#include "sim/image/png.h"
#include "tests/golden/golden_check.h"
#include "tests/golden/golden_fixture.h"
#include "tests/golden/panel_route.h"
#include "tests/golden/subjects.h"
#include "tests/support/scene.h"
#include "tests/support/scene_engines.h"

namespace usuzumi::scenes {

// GoogleTest would print bytes.
static void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

}  // namespace usuzumi::scenes

namespace usuzumi::golden {
namespace {

using scenes::Scene;
using scenes::SceneDrawing;

gfx::SoftEngine& soft_engine() {
  static scenes::SoftEngineKit kit;
  return kit.engine();
}

gfx::OsmesaEngine& osmesa_engine() {
  static gfx::OsmesaEngine engine;
  return engine;
}

SceneDrawing draw_well(const Scene& scene, gfx::Engine& engine, Rgba8 background = scenes::kBackground) {
  SceneDrawing drawing = scenes::draw_scene(scene, engine, background);
  EXPECT_TRUE(drawing.status.ok()) << drawing.status.message << " at word " << drawing.status.where;
  EXPECT_FALSE(drawing.strayed) << "the engine wrote to VRAM outside its targets";
  return drawing;
}

void expect_same_bytes(const SceneDrawing& first, const SceneDrawing& second, const char* route) {
  EXPECT_EQ(sim::picture_crc32(first.picture), sim::picture_crc32(second.picture)) << route;
  EXPECT_TRUE(first.colour_plane == second.colour_plane) << route << ": colour planes in VRAM differ";
  EXPECT_TRUE(first.depth_plane == second.depth_plane) << route << ": depth planes in VRAM differ";
}

class GoldenScene : public testing::TestWithParam<Scene> {};

TEST_P(GoldenScene, SoftEngineGivesTheGoldenExactly) {
  const Verdict verdict =
      check_golden(source_store(), GetParam().name, draw_well(GetParam(), soft_engine()).picture, kFailures);
  EXPECT_TRUE(verdict.ok) << verdict.report;
}

TEST_P(GoldenScene, EveryRouteGivesTheSameBytes) {
  const SceneDrawing first = draw_well(GetParam(), soft_engine());
  expect_same_bytes(first, draw_well(GetParam(), soft_engine()), "second run");
  for (const std::uint32_t threads : {2u, 3u}) {
    scenes::SoftEngineKit kit(threads);
    expect_same_bytes(first, draw_well(GetParam(), kit.engine()), "threads");
  }
  for (const gfx::soft::Kernels* kernels : gfx::soft::all_kernels()) {
    if (!kernels->supported()) continue;
    scenes::SoftEngineKit kit(1, kernels);
    expect_same_bytes(first, draw_well(GetParam(), kit.engine()), kernels->name);
  }
  scenes::SoftEngineKit cramped(1, nullptr,
                                gfx::SoftEngine::minimum_work_bytes(GetParam().target.width, GetParam().target.height));
  expect_same_bytes(first, draw_well(GetParam(), cramped.engine()), "least working memory");
}

TEST_P(GoldenScene, PanelShowsTheGolden) {
  const PanelShot shot = show_on_panel(GetParam().target, draw_well(GetParam(), soft_engine()));
  ASSERT_TRUE(shot.status.ok()) << shot.status.message;
  EXPECT_FALSE(shot.faults);
  const Entry* entry = source_store().find(GetParam().name);
  ASSERT_NE(entry, nullptr);
  EXPECT_EQ(sim::picture_crc32(shot.picture), entry->crc32);
  EXPECT_EQ(shot.signature_crc, shot.panel_crc) << "what was sent and what arrived";
}

TEST_P(GoldenScene, OsmesaCoversAndColoursTheSame) {
  ASSERT_TRUE(osmesa_engine().status().ok()) << osmesa_engine().status().message;
  const auto over_both = [&](gfx::Engine& engine) {
    return TwoBackgrounds{draw_well(GetParam(), engine).picture,
                          draw_well(GetParam(), engine, scenes::kOtherBackground).picture};
  };
  const TwoBackgrounds ours = over_both(soft_engine()), peers = over_both(osmesa_engine());
  const PeerComparison c = compare_with_peer(ours, peers, GetParam().peer.channel);
  EXPECT_GT(c.covered, 0u) << "a scene that draws nothing proves nothing";
  RecordProperty("covered", static_cast<int>(c.covered));
  RecordProperty("covered_by_one", static_cast<int>(c.covered_by_one));
  RecordProperty("beyond_tolerance", static_cast<int>(c.beyond_tolerance));
  RecordProperty("worst", static_cast<int>(c.worst));
  EXPECT_TRUE(c.coverage_ok()) << c.covered_by_one << " of " << c.covered
                               << " pixels are covered by one engine only; first at " << c.first_coverage;
  const bool colour_ok = c.colour_ok(GetParam().peer.per_mille);
  EXPECT_TRUE(colour_ok) << c.beyond_tolerance << " of " << c.compared << " pixels differ by more than "
                             << GetParam().peer.channel << ", by up to " << c.worst << "; first at " << c.first_colour;
  if (c.coverage_ok() && colour_ok) return;
  const std::string name = GetParam().name;
  std::filesystem::create_directories(kFailures);
  sim::write_png(kFailures / (name + ".soft.png"), ours.first);
  sim::write_png(kFailures / (name + ".osmesa.png"), peers.first);
  sim::write_png(kFailures / (name + ".engines-differ.png"), sim::difference_image(peers.first, ours.first));
  ADD_FAILURE() << "pictures: " << (kFailures / name).string() << ".soft.png, .osmesa.png, .engines-differ.png";
}

TEST_P(GoldenScene, EnginesCountTheSameWork) {
  const gfx::EngineCounters soft = draw_well(GetParam(), soft_engine()).counters,
                            osmesa = draw_well(GetParam(), osmesa_engine()).counters;
  EXPECT_EQ(soft.command_words, osmesa.command_words);
  EXPECT_EQ(soft.vertices_transformed, osmesa.vertices_transformed);
  EXPECT_EQ(soft.primitives_in, osmesa.primitives_in);
  EXPECT_EQ(soft.faces_in, osmesa.faces_in);
  EXPECT_EQ(soft.pixels_cleared, osmesa.pixels_cleared);
  EXPECT_NEAR(static_cast<double>(soft.texels_fetched), static_cast<double>(osmesa.texels_fetched),
              static_cast<double>(osmesa.texels_fetched) * 0.001);
  EXPECT_NEAR(static_cast<double>(soft.pixels_blended), static_cast<double>(osmesa.pixels_blended),
              static_cast<double>(osmesa.pixels_blended) * 0.001);
  EXPECT_NEAR(static_cast<double>(soft.faces_drawn), static_cast<double>(osmesa.faces_drawn),
              static_cast<double>(osmesa.faces_drawn) * 0.01);
  EXPECT_NEAR(static_cast<double>(soft.pixels_tested), static_cast<double>(osmesa.pixels_tested),
              static_cast<double>(osmesa.pixels_tested) * 0.001);
}

INSTANTIATE_TEST_SUITE_P(Scenes, GoldenScene,
                         testing::ValuesIn(scenes::all_scenes().begin(), scenes::all_scenes().end()),
                         test_name<Scene>);

TEST(GoldenManifest, NamesEverySceneAndRunAndNothingElse) {
  std::map<std::string, int> found;
  for (const Subject& subject : all_subjects()) {
    EXPECT_EQ(found[subject.name]++, 0) << subject.name << " is there twice";
    const Entry* entry = source_store().find(subject.name);
    ASSERT_NE(entry, nullptr) << subject.name
                              << " has no golden; if its picture is right: bash tests/golden/approve.sh "
                              << subject.name;
    EXPECT_EQ(entry->note, subject.note) << subject.name << ": approve.sh brings the manifest's note up to date";
    EXPECT_EQ(source_store().exclusions_of(subject.name), subject.exclusions)
        << subject.name << ": approve.sh brings the boards that it is not on up to date";
  }
  for (const Entry& entry : source_store().entries())
    EXPECT_EQ(found.count(std::string(case_of(entry.name))), 1u)
        << entry.name << " is a golden of nothing; approve.sh without names takes it away";
  for (const std::string& picture : source_store().pictures_on_disk())
    EXPECT_NE(source_store().find(picture), nullptr) << picture << ".png is no golden of the manifest";
}

TEST(GoldenManifest, ScenesAreNumberedInOrder) {
  int number = 0;
  for (const Scene& scene : scenes::all_scenes()) EXPECT_EQ(std::atoi(scene.name), ++number) << scene.name;
}

}  // namespace
}  // namespace usuzumi::golden
