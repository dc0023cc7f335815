// The engine's cost table restated: one item of each kind costs what the page says.
#include "gfx_subsystem/engine/cost_model.h"

#include <gtest/gtest.h>

namespace usuzumi::gfx {
namespace {

TEST(EngineCostModel, AnEmptyListCostsItsOverheadAlone) { EXPECT_EQ(engine_cycles({}), 200u); }

TEST(EngineCostModel, EachCounterHasItsPrice) {
  EXPECT_EQ(engine_cycles({.command_words = 1}), 201u);
  EXPECT_EQ(engine_cycles({.vertices_transformed = 1}), 216u);
  EXPECT_EQ(engine_cycles({.primitives_in = 1}), 204u);
  EXPECT_EQ(engine_cycles({.faces_in = 1}), 200u) << "faces are priced among the primitives";
  EXPECT_EQ(engine_cycles({.faces_drawn = 1}), 224u);
  EXPECT_EQ(engine_cycles({.pixels_tested = 1}), 201u);
}

TEST(EngineCostModel, ClearsFillFourPixelsAClockRoundedUpOnce) {
  EXPECT_EQ(engine_cycles({.pixels_cleared = 1}), 201u);
  EXPECT_EQ(engine_cycles({.pixels_cleared = 4}), 201u);
  EXPECT_EQ(engine_cycles({.pixels_cleared = 5}), 202u);
}

TEST(EngineCostModel, TexelsCostHalfAClockRoundedUpOnceAndBlendingOne) {
  EXPECT_EQ(engine_cycles({.texels_fetched = 1}), 201u);
  EXPECT_EQ(engine_cycles({.texels_fetched = 2}), 201u);
  EXPECT_EQ(engine_cycles({.texels_fetched = 401}), 401u);
  EXPECT_EQ(engine_cycles({.pixels_blended = 3}), 203u);
}

TEST(EngineCostModel, AFrameOfTheTruckAddsUp) {
  // 800x480 cleared, 2000 vertices, 3000 triangles of which 1400 show 60000 pixels, 300 words:
  // 200 + 300 + 32000 + 12000 + 33600 + 60000 + 96000
  EXPECT_EQ(engine_cycles({.command_words = 300,
                           .vertices_transformed = 2000,
                           .primitives_in = 3000,
                           .faces_in = 3000,
                           .faces_drawn = 1400,
                           .pixels_tested = 60000,
                           .pixels_cleared = 384000}),
            234100u);
}

}  // namespace
}  // namespace usuzumi::gfx
