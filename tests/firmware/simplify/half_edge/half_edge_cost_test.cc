// The cost of the claim, by hand.
#include "firmware/simplify/half_edge/half_edge_cost.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware/simplify/half_edge/surface_fixture.h"

namespace usuzumi::testing {
namespace {

using namespace firmware;

TEST(HalfEdgeCost, IsTheClaimsFormulaTermByTerm) {
  const float dist = 0.25f, alpha = 8;  // sums are exact
  for (int bits = 0; bits < 16; ++bits) {
    const float s = (bits & 1) != 0 ? 1.0f : 0.0f, t = (bits & 2) != 0 ? 1.0f : 0.0f;
    const float on = (bits & 4) != 0 ? 1.0f : 0.0f, cross = (bits & 8) != 0 ? 1.0f : 0.0f;
    const SeamRelation r{.from_seam = s > 0, .from_cross = cross > 0, .to_seam = t > 0, .edge_seam = on > 0};
    const float expected = dist + alpha * s * (1 - t) + alpha * s * t * (1 - on) + 2 * alpha * cross * t;
    EXPECT_EQ(half_edge_cost(dist, alpha, r), expected) << bits;
    EXPECT_EQ(r.is_penalised(), expected > dist) << bits;
    SeamRelation into_an_end = r;
    into_an_end.splits = true;
    EXPECT_EQ(half_edge_cost(dist, alpha, into_an_end), expected + alpha) << "not in the claim";
    EXPECT_TRUE(into_an_end.is_penalised());
  }
}

TEST(HalfEdgeCost, OfAPyramidsTopIsTheDistanceFromTheSidesThatItLeaves) {
  // Sides of twice the area 2 sqrt 2, at 45 degrees. A corner of the base lies on two of them, and at sqrt 2 from the
  // planes of the two others: 2 * (2 sqrt 2) * 2 = 8 sqrt 2.
  Mesh pyramid;
  pyramid.positions = {{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {0, 0, 1}};
  pyramid.indices = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
  TestSurface surface(pyramid);
  const HalfEdge down = surface.half_edge(kTop, {1, 1, 0});
  EXPECT_NEAR(surface.model_units(cost_of(down.key)), 8 * std::sqrt(2.0), 1e-5);
  EXPECT_LT(down.key, kPenalised) << "from inside to a border is free";
  EXPECT_EQ(surface.half_edge({1, 1, 0}, kTop).key, kEdgeKeyMax) << "a border vertex leaves its border";
}

// Of an octahedron: a face's area is sqrt(3) / 2, four meet in a corner. The box's squared diagonal is 12.
constexpr double kRoot3 = 1.7320508075688772;
constexpr double kAlpha = 2 * 12 * (2 * kRoot3 + 2 * kRoot3);
// From a corner to the next: two faces do not touch that one, whose planes are 2 / sqrt 3 away and weigh sqrt 3.
constexpr double kFaces = 2 * kRoot3 * 4 / 3;

TEST(HalfEdgeCost, OfASeamVertexIsPenalisedOffTheSeamOnly) {
  TestSurface surface(coloured(octahedron(), [](Vec3 c) { return c.z > 0 ? 1u : 2u; }));
  EXPECT_NEAR(surface.model_units(surface.costs.alpha(surface.at(kEast), surface.at(kTop))), kAlpha, 1e-3);
  // The seam's planes weigh half the squared length of an edge: 1. Seen from the east, the top is 9/6 and 1/6 (squared)
  // from the two through each seam edge there, the north 4/6 from each of the two that it does not lie in.
  const HalfEdge off = surface.half_edge(kEast, kTop), along = surface.half_edge(kEast, kNorth),
                 onto = surface.half_edge(kTop, kEast);
  EXPECT_NEAR(surface.model_units(off.dist), kFaces + 10.0 / 3, 1e-5);
  EXPECT_NEAR(surface.model_units(cost_of(off.key & ~kPenalised)), kFaces + 10.0 / 3 + kAlpha, 1e-3);
  EXPECT_GE(off.key, kPenalised);
  EXPECT_NEAR(surface.model_units(cost_of(along.key)), kFaces + 4.0 / 3, 1e-5);
  EXPECT_LT(along.key, kPenalised);
  EXPECT_NEAR(surface.model_units(cost_of(onto.key)), kFaces, 1e-5);
  EXPECT_LT(onto.key, kPenalised);
}

TEST(HalfEdgeCost, OfACornerOfSeamsIsPenalisedMostAlongASeamAndThriceAcross) {
  // The equator is a seam, and so is the arc from the east over the top to the west: east and west are crosses.
  TestSurface surface(coloured(octahedron(), [](Vec3 c) { return c.z < 0 ? 1u : (c.y > 0 ? 2u : 3u); }));
  const auto penalty = [&](Vec3 from, Vec3 to) {
    const HalfEdge h = surface.half_edge(from, to);
    return surface.model_units(cost_of(h.key & ~kPenalised)) - surface.model_units(h.dist);
  };
  EXPECT_NEAR(penalty(kEast, kTop), 2 * kAlpha, 1e-3);
  EXPECT_NEAR(penalty(kEast, kNorth), 2 * kAlpha, 1e-3);
  EXPECT_NEAR(penalty(kEast, kBottom), kAlpha, 1e-3);
  EXPECT_NEAR(penalty(kTop, kEast), 0, 1e-9) << "to a corner, along the seam";
  EXPECT_NEAR(penalty(kNorth, kTop), kAlpha, 1e-3) << "from one seam to another";
  EXPECT_NEAR(penalty(kBottom, kEast), 0, 1e-9);
  // Were the top a cross, not on the edge's seam: 1 + 2, where the source's pseudocode would say 2.
  const SeamRelation across{.from_seam = true, .from_cross = true, .to_seam = true, .edge_seam = false};
  EXPECT_EQ(half_edge_cost(0, 1, across), 3.0f);
}

TEST(HalfEdgeCost, TakesTheCheaperWayOfAnEdge) {
  TestSurface surface(coloured(octahedron(), [](Vec3 c) { return c.z > 0 ? 1u : 2u; }));
  const Surface& s = surface.surface();
  for (Corner c = 0; c < 32; ++c) {
    if ((c & 3) == 3) continue;
    const HalfEdge least = surface.costs.cheapest(c, 0);
    const HalfEdge forward = surface.costs.cheapest(c, kBackwardRefused),
                   backward = surface.costs.cheapest(c, kForwardRefused);
    EXPECT_EQ(least.key, forward.key < backward.key ? forward.key : backward.key);
    EXPECT_EQ(least.from, s.vertex_at(least.forward ? c : next_in_face(c)));
    EXPECT_EQ(surface.costs.cheapest(c, kForwardRefused | kBackwardRefused).key, kEdgeKeyMax);
  }
}

TEST(HalfEdgeCost, AreasOfBothEndsAddUp) {
  TestSurface surface(octahedron());
  const std::uint32_t east = surface.at(kEast), top = surface.at(kTop);
  const double scale = surface.working.scale;
  EXPECT_NEAR(surface.costs.area(top) / (scale * scale), 2 * kRoot3, 1e-5);
  surface.costs.merge_areas(east, top);
  EXPECT_NEAR(surface.costs.area(top) / (scale * scale), 4 * kRoot3, 1e-5);
}

}  // namespace
}  // namespace usuzumi::testing
