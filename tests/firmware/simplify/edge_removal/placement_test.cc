// Where the vertex that stays goes, worked out by hand: US 6,396,952, p. 19-22 and 27-30.
#include "firmware/simplify/edge_removal/placement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace usuzumi::testing {
namespace {

using namespace firmware;

EdgeShape shape_of(float net_a, float net_b) {
  EdgeShape shape;
  shape.a = 3;
  shape.b = 7;
  shape.length = 2;
  shape.at_a = {.volume = std::fabs(net_a), .net_volume = net_a};
  shape.at_b = {.volume = std::fabs(net_b), .net_volume = net_b};
  return shape;
}

TEST(EdgePlacement, EqualChangeDividesTheEdgeInverselyToTheEnds) {
  // t * 3 = (1 - t) * 1
  EXPECT_FLOAT_EQ(place_on_edge(shape_of(3, 1), EdgePlacement::kEqualVolume), 0.25f);
  EXPECT_FLOAT_EQ(place_on_edge(shape_of(-3, 1), EdgePlacement::kEqualVolume), 0.25f);
  EXPECT_FLOAT_EQ(place_on_edge(shape_of(0, 2), EdgePlacement::kEqualVolume), 1) << "v1's side is flat: it may move";
  EXPECT_FLOAT_EQ(place_on_edge(shape_of(0, 0), EdgePlacement::kEqualVolume), 0.5f);
}

TEST(EdgePlacement, EqualChangeWhereGainsAndLossesMakeUpGoesByAllThatMoves) {
  EdgeShape shape = shape_of(0, 0);
  shape.at_a.volume = 1;
  shape.at_b.volume = 4;
  EXPECT_FLOAT_EQ(place_on_edge(shape, EdgePlacement::kEqualVolume), 0.8f);
}

TEST(EdgePlacement, LeastChangeKeepsTheEndThatWouldSweepMore) {
  EXPECT_EQ(place_on_edge(shape_of(3, 1), EdgePlacement::kLeastVolume), 0);
  EXPECT_EQ(place_on_edge(shape_of(1, 3), EdgePlacement::kLeastVolume), 1);
  EXPECT_EQ(place_on_edge(shape_of(2, 2), EdgePlacement::kLeastVolume), 0.5f) << "both ends alike";
}

TEST(EdgePlacement, LeastChangeGoesBeyondTheEndWhereThatLosesNothing) {
  // Both ends lose: with t < 0 v1's planes gain -t * 8, v2's lose (1 - t) * 1; t = -1/7.
  EXPECT_FLOAT_EQ(place_on_edge(shape_of(-8, 1), EdgePlacement::kLeastVolume), -1.0f / 7);
  EXPECT_FLOAT_EQ(place_on_edge(shape_of(8, -1), EdgePlacement::kLeastVolume), -1.0f / 7);
  EXPECT_FLOAT_EQ(place_on_edge(shape_of(-1, 8), EdgePlacement::kLeastVolume), 8.0f / 7);
  // At 2 : 1 it would be a whole edge beyond.
  EXPECT_EQ(place_on_edge(shape_of(-2, 1), EdgePlacement::kLeastVolume), 0);
  EXPECT_EQ(place_on_edge(shape_of(-1, 2), EdgePlacement::kLeastVolume), 1);
  EXPECT_FLOAT_EQ(place_on_edge(shape_of(-5, 1), EdgePlacement::kLeastVolume), -kMostBeyond) << "just as far as may be";
}

TEST(EdgePlacement, AutomaticIsLeastOnConvexAndConcaveEqualOnS) {
  EXPECT_FLOAT_EQ(place_on_edge(shape_of(3, 1), EdgePlacement::kAutomatic), 0.25f) << "S";
  EXPECT_FLOAT_EQ(place_on_edge(shape_of(-3, -1), EdgePlacement::kAutomatic), 0.25f) << "S";
  EXPECT_EQ(place_on_edge(shape_of(-3, 1), EdgePlacement::kAutomatic), 0) << "convex";
  EXPECT_EQ(place_on_edge(shape_of(3, -1), EdgePlacement::kAutomatic), 0) << "concave";
  EXPECT_EQ(place_on_edge(shape_of(3, 1), EdgePlacement::kAutomatic, true), 0) << "the other answer";
  EXPECT_FLOAT_EQ(place_on_edge(shape_of(-3, 1), EdgePlacement::kAutomatic, true), 0.25f);
}

TEST(EdgePlacement, AnEndIsKeptAndOfEqualOnesTheLowerNumbered) {
  EXPECT_EQ(place_on_edge(shape_of(-8, 1), EdgePlacement::kKeepAnEnd), 0) << "never beyond";
  EXPECT_EQ(place_on_edge(shape_of(1, 8), EdgePlacement::kKeepAnEnd), 1);
  EdgeShape shape = shape_of(2, 2);
  EXPECT_EQ(place_on_edge(shape, EdgePlacement::kKeepAnEnd), 0);
  std::swap(shape.a, shape.b);
  EXPECT_EQ(place_on_edge(shape, EdgePlacement::kKeepAnEnd), 1);
}

TEST(EdgePlacement, MidpointIsTheMiddle) {
  EXPECT_EQ(place_on_edge(shape_of(-8, 1), EdgePlacement::kMidpoint), 0.5f);
}

TEST(EdgePlacement, OutlineCountsByTheEdgesLength) {
  EdgeShape shape = shape_of(1, 1);  // |E| = 2
  shape.border = true;
  shape.at_a.outline = 1;
  shape.at_a.net_outline = -1;
  // The outline makes 1 + 1 * 2 against 1.
  EXPECT_FLOAT_EQ(place_on_edge(shape, EdgePlacement::kEqualVolume), 0.25f);
  EXPECT_EQ(place_on_edge(shape, EdgePlacement::kLeastVolume), 0);
}

EdgeShape outlines(float a, float b) {
  EdgeShape shape = shape_of(0, 0);
  shape.border = true;
  shape.at_a.outline = a;
  shape.at_b.outline = b;
  return shape;
}

TEST(EdgePlacement, MovementIsLimitedToWhereTheOutlineAllowsIt) {
  const EdgeShape shape = outlines(1, 0.25f);  // changes by t * 1 + (1 - t) * 0.25 between the ends
  EXPECT_FLOAT_EQ(outline_change(shape, 0.5f), 0.625f);
  EXPECT_FLOAT_EQ(outline_change(shape, -1), 1 + 0.5f);
  EXPECT_FLOAT_EQ(outline_change(shape, 2), 2 + 0.25f);
  float t = 0.5f;
  EXPECT_TRUE(limit_movement(shape, 0.625f, t));
  EXPECT_EQ(t, 0.5f) << "within the limit";
  EXPECT_TRUE(limit_movement(shape, 0.5f, t));
  EXPECT_FLOAT_EQ(t, 1.0f / 3);
  t = 1.25f;
  EXPECT_TRUE(limit_movement(shape, 0.5f, t));
  EXPECT_FLOAT_EQ(t, 1.0f / 3) << "from beyond the other end";
  t = -0.25f;
  EXPECT_TRUE(limit_movement(shape, 0.5f, t));
  EXPECT_EQ(t, 0) << "the nearest place between the ends";
  EXPECT_FALSE(limit_movement(shape, 0.125f, t)) << "even the better end changes 0.25";
}

TEST(EdgePlacement, EqualOutlinesBeyondTheLimitAreBeyondItEverywhere) {
  float t = 0.5f;
  EXPECT_FALSE(limit_movement(outlines(1, 1), 0.75f, t));
  EXPECT_TRUE(limit_movement(outlines(1, 1), 1, t));
  t = 0.5f;
  EXPECT_TRUE(limit_movement(outlines(0, 4), 0, t));
  EXPECT_EQ(t, 1) << "v1 lies on a straight line and may go";
  t = 0;
  EXPECT_FALSE(limit_movement(outlines(std::nanf(""), 1), 0.5f, t));
}

}  // namespace
}  // namespace usuzumi::testing
