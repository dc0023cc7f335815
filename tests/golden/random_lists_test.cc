// Random command lists: the software engine gives the same bytes by every route, and OSMesa's llvmpipe draws the same.
#include <gtest/gtest.h>

#include "gfx_subsystem/engine_osmesa/osmesa_engine.h"
#include "tests/golden/golden_check.h"
#include "tests/support/scene_engines.h"
#include "tests/support/scene_random.h"

namespace usuzumi::golden {
namespace {

constexpr std::uint64_t kLists = 300;
/// llvmpipe compiles a program for every state that textures are drawn in: a list takes it a fifth of a second.
constexpr std::uint64_t kTexturedPeerLists = 100;

using Build = void (*)(scenes::SceneBuilder&, std::uint64_t);

scenes::Scene random_scene(std::uint64_t seed, Build build) {
  return {"random", "", scenes::random_target(seed), [=](scenes::SceneBuilder& b) { build(b, seed); }};
}

scenes::SceneDrawing draw_well(std::uint64_t seed, Build build, gfx::Engine& engine,
                               Rgba8 background = scenes::kBackground) {
  scenes::SceneDrawing drawing = scenes::draw_scene(random_scene(seed, build), engine, background);
  EXPECT_TRUE(drawing.status.ok()) << "seed " << seed << ": " << drawing.status.message;
  EXPECT_FALSE(drawing.strayed) << "seed " << seed << ": the engine wrote to VRAM outside its targets";
  return drawing;
}

/// The lists' sums: on targets of 32 bits, and of 16. Each list on its own may be small and unlucky: indices that name
/// a triangle twice, its corners in another order, make two flat colours fight for one depth.
struct Sums {
  PeerComparison on_32_bits, on_16_bits;
};
Sums compare_lists(Build build, std::uint64_t lists) {
  scenes::SoftEngineKit soft;
  gfx::OsmesaEngine osmesa;
  EXPECT_TRUE(osmesa.status().ok()) << osmesa.status().message;
  // A step of 5 bits is 8 or 9 of 255; where a colour lies halfway between two, the engines may take either.
  constexpr std::uint32_t kStepOf5Bits = 9;
  Sums sums;
  for (std::uint64_t seed = 0; seed < lists; ++seed) {
    const auto over_both = [&](gfx::Engine& engine) {
      return TwoBackgrounds{draw_well(seed, build, engine).picture,
                            draw_well(seed, build, engine, scenes::kOtherBackground).picture};
    };
    const bool in_16_bits = scenes::random_target(seed).format == command::PixelFormat::kRgb565;
    const PeerComparison one =
        compare_with_peer(over_both(soft.engine()), over_both(osmesa), in_16_bits ? kStepOf5Bits : kChannelTolerance);
    EXPECT_LE(one.covered_by_one, 3 + one.covered / 1000) << "seed " << seed << ": " << one.first_coverage;
    EXPECT_LE(one.beyond_tolerance, 5 + one.compared / 4) << "seed " << seed << ": first at " << one.first_colour;
    (in_16_bits ? sums.on_16_bits : sums.on_32_bits) += one;
  }
  for (const PeerComparison& c : {sums.on_32_bits, sums.on_16_bits})
    std::printf("covered %zu, by one engine only %zu, compared %zu, beyond tolerance %zu\n", c.covered,
                c.covered_by_one, c.compared, c.beyond_tolerance);
  return sums;
}

void expect_alike(const Sums& sums) {
  for (const PeerComparison& c : {sums.on_32_bits, sums.on_16_bits}) {
    EXPECT_GT(c.covered, 100000u);
    EXPECT_TRUE(c.coverage_ok()) << c.covered_by_one << " of " << c.covered;
    EXPECT_TRUE(c.colour_ok()) << c.beyond_tolerance << " of " << c.compared;
  }
}

TEST(RandomLists, OsmesaCoversAndColoursTheSame) { expect_alike(compare_lists(scenes::build_random, kLists)); }

TEST(RandomLists, OsmesaDrawsTexturesTheSame) {
  expect_alike(compare_lists(scenes::build_random_textured, kTexturedPeerLists));
}

TEST(RandomLists, EveryRouteGivesTheSameBytes) {
  scenes::SoftEngineKit plain, threads(2);
  for (const Build build : {scenes::build_random, scenes::build_random_textured})
    for (std::uint64_t seed = 0; seed < kLists; ++seed) {
      const scenes::SceneDrawing first = draw_well(seed, build, plain.engine());
      const auto target = scenes::random_target(seed);
      scenes::SoftEngineKit cramped(1, nullptr, gfx::SoftEngine::minimum_work_bytes(target.width, target.height));
      for (gfx::SoftEngine* engine : {&threads.engine(), &cramped.engine()}) {
        const scenes::SceneDrawing again = draw_well(seed, build, *engine);
        EXPECT_TRUE(first.colour_plane == again.colour_plane) << "seed " << seed << ": colours differ";
        EXPECT_TRUE(first.depth_plane == again.depth_plane) << "seed " << seed << ": depths differ";
      }
    }
}

}  // namespace
}  // namespace usuzumi::golden
