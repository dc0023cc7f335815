// Random command lists: the software engine gives the same bytes by every route, and OSMesa's llvmpipe draws the same.
#include <gtest/gtest.h>

#include "gfx_subsystem/engine_osmesa/osmesa_engine.h"
#include "tests/golden/golden_check.h"
#include "tests/support/scene_engines.h"
#include "tests/support/scene_random.h"

namespace usuzumi::golden {
namespace {

constexpr std::uint64_t kLists = 300;

scenes::Scene random_scene(std::uint64_t seed) {
  return {"random", "", scenes::random_target(seed),
          [seed](scenes::SceneBuilder& b) { scenes::build_random(b, seed); }};
}

scenes::SceneDrawing draw_well(std::uint64_t seed, gfx::Engine& engine, Rgba8 background = scenes::kBackground) {
  scenes::SceneDrawing drawing = scenes::draw_scene(random_scene(seed), engine, background);
  EXPECT_TRUE(drawing.status.ok()) << "seed " << seed << ": " << drawing.status.message;
  EXPECT_FALSE(drawing.strayed) << "seed " << seed << ": the engine wrote to VRAM outside its targets";
  return drawing;
}

TEST(RandomLists, OsmesaCoversAndColoursTheSame) {
  scenes::SoftEngineKit soft;
  gfx::OsmesaEngine osmesa;
  ASSERT_TRUE(osmesa.status().ok()) << osmesa.status().message;
  // A step of 5 bits is 8 or 9 of 255; where a colour lies halfway between two, the engines may take either.
  constexpr std::uint32_t kStepOf5Bits = 9;
  PeerComparison sum[2];
  for (std::uint64_t seed = 0; seed < kLists; ++seed) {
    const auto over_both = [&](gfx::Engine& engine) {
      return TwoBackgrounds{draw_well(seed, engine).picture, draw_well(seed, engine, scenes::kOtherBackground).picture};
    };
    const bool in_16_bits = scenes::random_target(seed).format == command::PixelFormat::kRgb565;
    const PeerComparison one =
        compare_with_peer(over_both(soft.engine()), over_both(osmesa), in_16_bits ? kStepOf5Bits : kChannelTolerance);
    // Each list on its own may be small and unlucky: indices that name a triangle twice, its corners in another order,
    // make two flat colours fight for one depth.
    EXPECT_LE(one.covered_by_one, 3 + one.covered / 1000) << "seed " << seed << ": first at " << one.first_coverage;
    EXPECT_LE(one.beyond_tolerance, 5 + one.compared / 4) << "seed " << seed << ": first at " << one.first_colour;
    sum[in_16_bits ? 1 : 0] += one;
  }
  for (const PeerComparison& c : sum) {
    EXPECT_GT(c.covered, 100000u);
    EXPECT_TRUE(c.coverage_ok()) << c.covered_by_one << " of " << c.covered;
    EXPECT_TRUE(c.colour_ok()) << c.beyond_tolerance << " of " << c.compared;
    std::printf("covered %zu, by one engine only %zu, compared %zu, beyond tolerance %zu\n", c.covered,
                c.covered_by_one, c.compared, c.beyond_tolerance);
  }
}

TEST(RandomLists, EveryRouteGivesTheSameBytes) {
  scenes::SoftEngineKit plain, threads(2);
  for (std::uint64_t seed = 0; seed < kLists; ++seed) {
    const scenes::SceneDrawing first = draw_well(seed, plain.engine());
    const auto target = scenes::random_target(seed);
    scenes::SoftEngineKit cramped(1, nullptr, gfx::SoftEngine::minimum_work_bytes(target.width, target.height));
    for (gfx::SoftEngine* engine : {&threads.engine(), &cramped.engine()}) {
      const scenes::SceneDrawing again = draw_well(seed, *engine);
      EXPECT_TRUE(first.colour_plane == again.colour_plane) << "seed " << seed << ": colours differ";
      EXPECT_TRUE(first.depth_plane == again.depth_plane) << "seed " << seed << ": depths differ";
    }
  }
}

}  // namespace
}  // namespace usuzumi::golden
