#include "firmware/layers/layer_choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware/layers/hand_log.h"

namespace usuzumi {
namespace {

using firmware::Attention;
using firmware::choose_layer;
using firmware::LayerChoiceSettings;
using firmware::LayerMemory;
using firmware::ScreenExtent;
using firmware::View;

constexpr std::uint32_t kQuotas[] = {1'000'000, 500'000, 250'000};

/// 320, 160 and 80 faces, or one or two fewer.
const firmware::LayerChainView& chain() {
  static const testing::Mesh mesh = testing::icosphere(2);
  static const testing::HandLog hand(mesh, testing::HandLog::Kind::kHalfEdge, 60, 2);
  static const testing::BuiltChain built = testing::build_chain(hand.input(kQuotas));
  return built.view;
}

View view() {
  View v;
  v.width = 800;
  v.height = 600;
  return v;
}

/// A mesh in the picture's middle that is worth `faces` by its size alone.
ScreenExtent worth(float faces) {
  return {400, 300, std::sqrt(faces * LayerChoiceSettings{}.pixels_per_face), false};
}

float first_layer(const ScreenExtent& extent, const Attention& attention = {}, float floor = 2) {
  LayerMemory memory;
  return choose_layer(chain(), extent, view(), attention, {}, floor, memory);
}

TEST(LayerChoice, FacesOfALayerAreThatLayerAndThoseBetweenLieBetween) {
  for (std::uint32_t n = 0; n < 3; ++n)
    EXPECT_EQ(firmware::layer_of_faces(chain(), static_cast<float>(chain().layer(n).faces)), static_cast<float>(n));
  const double side_by_side = (std::sqrt(chain().layer(1).faces) + std::sqrt(chain().layer(2).faces)) / 2;
  EXPECT_NEAR(firmware::layer_of_faces(chain(), static_cast<float>(side_by_side * side_by_side)), 1.5f, 1e-5f);
  EXPECT_EQ(firmware::layer_of_faces(chain(), 1e9f), 0);
  EXPECT_EQ(firmware::layer_of_faces(chain(), 0), 2);
}

TEST(LayerChoice, SmallerOnTheScreenIsCoarser) {
  EXPECT_EQ(first_layer(worth(320)), 0);
  EXPECT_EQ(first_layer(worth(10)), 2);
  float before = 0;
  for (float faces = 320; faces > 60; faces -= 5) {
    const float layer = first_layer(worth(faces));
    EXPECT_GE(layer, before);
    before = layer;
  }
  EXPECT_EQ(before, 2);
}

TEST(LayerChoice, FromTheMiddleToTheCornerAQuarterOfTheFacesIsLost) {
  ScreenExtent corner = worth(200);
  corner.centre_x = corner.centre_y = 0;
  EXPECT_FLOAT_EQ(first_layer(corner), first_layer(worth(150)));
  corner.centre_x = corner.centre_y = -5000;
  EXPECT_FLOAT_EQ(first_layer(corner), first_layer(worth(150))) << "no more than at the corner";
}

TEST(LayerChoice, AwayFromThePointOfAttentionHalfOfTheFacesIsLost) {
  // The attended point is half the picture's diagonal (500 pixels) away.
  EXPECT_FLOAT_EQ(first_layer(worth(200), {true, 900, 300}), first_layer(worth(100)));
  EXPECT_FLOAT_EQ(first_layer(worth(200), {true, 650, 300}), first_layer(worth(150)));
  EXPECT_FLOAT_EQ(first_layer(worth(200), {true, 400, 300}), first_layer(worth(200)));
  EXPECT_FLOAT_EQ(first_layer(worth(200), {false, 900, 300}), first_layer(worth(200)));
}

TEST(LayerChoice, AtTheSpeedOfTheSettingHalfOfTheFacesIsLost) {
  LayerChoiceSettings settings;
  settings.hysteresis = 0;
  settings.largest_change = 10;
  settings.position_weight = 0;
  LayerMemory memory;
  ScreenExtent extent = worth(200);
  const float standing = choose_layer(chain(), extent, view(), {}, settings, 2, memory);
  extent.centre_x += settings.speed_px;
  const float moving = choose_layer(chain(), extent, view(), {}, settings, 2, memory);
  EXPECT_FLOAT_EQ(moving, first_layer(worth(100)));
  EXPECT_FLOAT_EQ(choose_layer(chain(), extent, view(), {}, settings, 2, memory), standing);
}

TEST(LayerChoice, NoLayerIsCoarserThanTheFloor) {
  EXPECT_EQ(first_layer(worth(1), {}, 0.75f), 0.75f);
  EXPECT_EQ(first_layer(worth(1), {}, 0), 0);
  EXPECT_EQ(first_layer(worth(1), {}, 99), 2);
  LayerMemory memory;
  EXPECT_EQ(choose_layer(chain(), worth(1), view(), {}, {}, 2, memory), 2);
  EXPECT_EQ(choose_layer(chain(), worth(1), view(), {}, {}, 0.5f, memory), 0.5f) << "at once, whatever is held";
}

TEST(LayerChoice, WhatTremblesWithinTheHysteresisStands) {
  LayerMemory memory;
  const LayerChoiceSettings settings;
  const auto faces_of = [](float layer) {  // of layers between 0 and 1
    const float all = std::sqrt(static_cast<float>(chain().layer(0).faces));
    const float less = std::sqrt(static_cast<float>(chain().layer(1).faces));
    return (all + layer * (less - all)) * (all + layer * (less - all));
  };
  choose_layer(chain(), worth(faces_of(0.5f)), view(), {}, settings, 2, memory);
  // The first swings take up the play; after them nothing moves any more.
  for (int i = 0; i < 4; ++i)
    choose_layer(chain(), worth(faces_of(i % 2 == 0 ? 0.45f : 0.63f)), view(), {}, settings, 2, memory);
  const float held = memory.layer;
  EXPECT_NEAR(held, 0.53f, 1e-5f) << "as far from what was asked for as the play allows";
  for (int i = 0; i < 100; ++i) {
    const ScreenExtent extent = worth(faces_of(i % 2 == 0 ? 0.45f : 0.63f));
    EXPECT_EQ(choose_layer(chain(), extent, view(), {}, settings, 2, memory), held);
  }
  // Without hysteresis the same trembles.
  LayerChoiceSettings loose;
  loose.hysteresis = 0;
  loose.largest_change = 10;
  LayerMemory other;
  const float a = choose_layer(chain(), worth(faces_of(0.41f)), view(), {}, loose, 2, other);
  EXPECT_NE(a, choose_layer(chain(), worth(faces_of(0.59f)), view(), {}, loose, 2, other));
}

TEST(LayerChoice, TheEndsAreReachedWhateverTheHysteresis) {
  LayerMemory memory;
  for (int i = 0; i < 80; ++i) choose_layer(chain(), worth(10), view(), {}, {}, 2, memory);
  EXPECT_EQ(memory.layer, 2);
  for (int i = 0; i < 80; ++i) choose_layer(chain(), worth(1000), view(), {}, {}, 2, memory);
  EXPECT_EQ(memory.layer, 0);
}

TEST(LayerChoice, NoFrameChangesMoreThanTheLargestChange) {
  LayerMemory memory;
  choose_layer(chain(), worth(1000), view(), {}, {}, 2, memory);
  float before = memory.layer;
  int frames = 0;
  for (; memory.layer < 2 && frames < 100; ++frames) {
    const float layer = choose_layer(chain(), worth(1), view(), {}, {}, 2, memory);
    EXPECT_LE(layer - before, LayerChoiceSettings{}.largest_change + 1e-6f);
    before = layer;
  }
  EXPECT_EQ(frames, 64) << "two layers of 32 frames";
}

TEST(LayerChoice, ABoxIsMeasuredWhereItsCornersAre) {
  View v = view();  // clip = model: x, y in -1..1 is the picture
  const ScreenExtent extent = firmware::screen_extent({{-0.5f, 0, 0}, {0.5f, 0.5f, 0.25f}}, v);
  EXPECT_FLOAT_EQ(extent.centre_x, 400);
  EXPECT_FLOAT_EQ(extent.centre_y, 225) << "y = 0.25 is above the middle";
  EXPECT_FLOAT_EQ(extent.diameter, std::sqrt(400.0f * 400 + 150 * 150));
  EXPECT_FALSE(extent.beyond_eye);
}

TEST(LayerChoice, WhatReachesTheViewerIsDrawnWhole) {
  View v = view();
  v.model_to_clip.m[14] = -1;  // w = 1 - z
  v.model_to_clip.m[15] = 1;
  EXPECT_TRUE(firmware::screen_extent({{0, 0, 0}, {1, 1, 1}}, v).beyond_eye);
  EXPECT_FALSE(firmware::screen_extent({{0, 0, 0}, {1, 1, 0.5f}}, v).beyond_eye);
  EXPECT_EQ(first_layer({0, 0, 1, true}), 0);
}

TEST(LayerChoice, WhatIsThrownFarAboutTheEyeIsDrawnWhole) {
  View v = view();
  v.model_to_clip.m[14] = -1;  // w = 1 - z
  v.model_to_clip.m[15] = 1;
  for (const float x : {1e3f, 1e8f}) {  // w = 6e-8: corners at 1e10 pixels and beyond
    const ScreenExtent extent = firmware::screen_extent({{-x, -x, 0}, {x, x, 0.99999994f}}, v);
    EXPECT_TRUE(extent.beyond_eye);
    EXPECT_EQ(first_layer(extent), 0);
  }
}

TEST(LayerChoice, WhatComesOutFromBehindTheEyeIsNotFast) {
  LayerChoiceSettings settings;
  settings.hysteresis = 0;
  settings.largest_change = 10;
  LayerMemory memory;
  choose_layer(chain(), {0, 0, 0, true}, view(), {}, settings, 2, memory);
  EXPECT_EQ(choose_layer(chain(), worth(200), view(), {}, settings, 2, memory), first_layer(worth(200)));
}

}  // namespace
}  // namespace usuzumi
