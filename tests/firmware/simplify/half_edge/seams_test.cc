#include "firmware/simplify/half_edge/seams.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "firmware/simplify/half_edge/wedge_matching.h"
#include "tests/firmware/simplify/half_edge/surface_fixture.h"

namespace usuzumi::testing {
namespace {

using namespace firmware;

TEST(Seams, ASmoothClosedSurfaceHasNone) {
  TestSurface surface(octahedron());
  for (std::uint32_t v = 0; v < 6; ++v) {
    EXPECT_FALSE(surface.seams.is_seam(v));
    EXPECT_FALSE(surface.seams.is_cross(v));
  }
}

TEST(Seams, EveryKindOfAttributeMakesOne) {
  const Mesh shape = coloured(octahedron(), [](Vec3 c) { return c.z > 0 ? 1u : 2u; });
  for (int kind = 0; kind < 3; ++kind) {
    Mesh mesh = shape;
    mesh.colours.clear();
    for (const Rgba8 colour : shape.colours) {
      if (kind == 0) mesh.colours.push_back(colour);
      if (kind == 1) mesh.normals.push_back(pack_normal({0, 0, colour.bits == 1 ? 1.0f : -1.0f}));
      if (kind == 2) mesh.texture_coordinates.push_back({static_cast<float>(colour.bits), 0});
    }
    TestSurface surface(mesh);
    EXPECT_TRUE(surface.seams.is_seam(surface.at(kEast))) << kind;
    EXPECT_FALSE(surface.seams.is_cross(surface.at(kEast))) << kind;
    EXPECT_FALSE(surface.seams.is_seam(surface.at(kTop))) << kind;
    EXPECT_TRUE(surface.relation(kEast, kNorth).edge_seam) << kind;
    EXPECT_FALSE(surface.relation(kEast, kTop).edge_seam) << kind;
  }
}

TEST(Seams, MeetInACross) {
  TestSurface surface(coloured(octahedron(), [](Vec3 c) { return c.z < 0 ? 1u : (c.y > 0 ? 2u : 3u); }));
  EXPECT_TRUE(surface.seams.is_cross(surface.at(kEast)));
  EXPECT_TRUE(surface.seams.is_cross(surface.at(kWest)));
  for (const Vec3 p : {kTop, kNorth, kSouth}) {
    EXPECT_TRUE(surface.seams.is_seam(surface.at(p)));
    EXPECT_FALSE(surface.seams.is_cross(surface.at(p)));
  }
  EXPECT_FALSE(surface.seams.is_seam(surface.at(kBottom)));
}

TEST(Seams, EndInACrossOfSeveralWedgesBeyondWhichThereIsNone) {
  // A cut along y = 2 in a sheet: two wedges each at (2, 2), (3, 2) and (4, 2), one at (1, 2) and (5, 2).
  Mesh sheet = grid(6, 4);
  sheet.texture_coordinates.resize(sheet.positions.size());
  for (const float x : {2.0f, 3.0f, 4.0f}) {
    const auto cut = static_cast<std::uint32_t>(sheet.positions.size());
    std::uint32_t at_cut = 0;
    while (!(sheet.positions[at_cut] == Vec3{x, 2, 0})) ++at_cut;
    sheet.positions.push_back(sheet.positions[at_cut]);
    sheet.texture_coordinates.push_back({1, 1});
    for (std::size_t i = 0; i < sheet.indices.size(); i += 3) {
      float top = 0;
      for (std::size_t k = 0; k < 3; ++k) top = std::max(top, sheet.positions[sheet.indices[i + k]].y);
      for (std::size_t k = 0; k < 3; ++k)
        if (top > 2 && sheet.indices[i + k] == at_cut) sheet.indices[i + k] = cut;
    }
  }
  TestSurface surface(sheet);
  EXPECT_TRUE(surface.seams.is_cross(surface.at({2, 2, 0}))) << "the cut's end";
  EXPECT_TRUE(surface.seams.is_seam(surface.at({3, 2, 0})));
  EXPECT_FALSE(surface.seams.is_cross(surface.at({3, 2, 0})));
  EXPECT_TRUE(surface.relation({3, 2, 0}, {2, 2, 0}).edge_seam);
  EXPECT_FALSE(surface.seams.is_seam(surface.at({1, 2, 0})));
  EXPECT_FALSE(surface.relation({2, 2, 0}, {1, 2, 0}).edge_seam);
  // Into the end no wedge continues both sides; from anywhere else beside the cut one does.
  EXPECT_TRUE(surface.relation({1, 2, 0}, {2, 2, 0}).splits);
  EXPECT_TRUE(surface.relation({1, 2, 0}, {2, 2, 0}).is_penalised());
  EXPECT_FALSE(surface.relation({2, 2, 0}, {1, 2, 0}).splits);
  EXPECT_FALSE(surface.relation({2, 1, 0}, {2, 2, 0}).is_penalised());
  EXPECT_FALSE(surface.relation({1, 2, 0}, {1, 1, 0}).is_penalised());
}

TEST(Seams, APolesFacesHaveWedgesOfTheirOwnAndItsNeighboursLieInside) {
  // The octahedron's top as the pole of a globe: a texture coordinate for each of its faces, one for every other place.
  Mesh globe = octahedron();
  globe.texture_coordinates.resize(globe.positions.size());
  for (std::size_t i = 0; i < globe.indices.size(); ++i) {
    const Vec3 p = globe.positions[globe.indices[i]];
    if (!(p == kTop)) continue;
    globe.indices[i] = static_cast<std::uint32_t>(globe.positions.size());
    globe.positions.push_back(p);
    globe.texture_coordinates.push_back({static_cast<float>(i), 0});
  }
  TestSurface surface(globe);
  EXPECT_TRUE(surface.seams.is_cross(surface.at(kTop)));
  for (const Vec3 p : {kEast, kNorth, kWest, kSouth}) {
    EXPECT_FALSE(surface.seams.is_seam(surface.at(p)));
    EXPECT_TRUE(surface.relation(p, kTop).is_penalised());
  }
  EXPECT_FALSE(surface.relation(kEast, kNorth).is_penalised());
}

TEST(Seams, AnOpenBorderIsOneThatIsNotLeft) {
  TestSurface surface(grid(4, 4));
  EXPECT_TRUE(surface.seams.is_seam(surface.at({0, 0, 0})));
  EXPECT_FALSE(surface.seams.is_cross(surface.at({0, 0, 0}))) << "a corner in shape alone";
  EXPECT_TRUE(surface.relation({1, 0, 0}, {2, 0, 0}).edge_seam);
  EXPECT_FALSE(surface.relation({1, 0, 0}, {2, 0, 0}).leaves_border);
  EXPECT_TRUE(surface.relation({1, 0, 0}, {1, 1, 0}).leaves_border);
  EXPECT_FALSE(surface.relation({1, 1, 0}, {1, 0, 0}).leaves_border);
}

TEST(Seams, AnIslandOfOneFaceIsNotFolded) {
  // One face of the octahedron has a colour of its own: going along an edge of it would fold its border.
  TestSurface surface(coloured(octahedron(), [](Vec3 c) { return c.x > 0 && c.y > 0 && c.z > 0 ? 1u : 2u; }));
  EXPECT_FALSE(surface.seams.is_cross(surface.at(kEast)));
  EXPECT_FALSE(surface.relation(kEast, kNorth).edge_seam);
  EXPECT_TRUE(surface.relation(kEast, kNorth).is_penalised());
  EXPECT_TRUE(surface.relation(kEast, kSouth).is_penalised());
  EXPECT_FALSE(surface.relation(kSouth, kEast).is_penalised());
}

TEST(WedgeMatching, FollowsTheFacesOfTheEdgeOnBothSidesOfASeam) {
  TestSurface surface(coloured(octahedron(), [](Vec3 c) { return c.z > 0 ? 1u : 2u; }));
  const Surface& s = surface.surface();
  const std::uint32_t east = surface.at(kEast), north = surface.at(kNorth);
  const WedgeMatching matching(s, {}, {}, east, north);
  for (Corner c = s.first_corner(east); c != kNoCorner; c = s.next_corner_of(c)) {
    const std::uint32_t wedge = s.indices[corner_index(c)], next = matching.successor(wedge);
    EXPECT_EQ(surface.vertex_of_wedge[next], north);
    EXPECT_EQ(surface.mesh.colours[next], surface.mesh.colours[wedge]) << "the seam was crossed";
  }
}

TEST(WedgeMatching, FromInsideTakesTheSideThatItComesFrom) {
  TestSurface surface(coloured(octahedron(), [](Vec3 c) { return c.z > 0 ? 1u : 2u; }));
  const Surface& s = surface.surface();
  const std::uint32_t top = surface.at(kTop), bottom = surface.at(kBottom), east = surface.at(kEast);
  const std::uint32_t from_top = WedgeMatching(s, {}, {}, top, east).successor(top);
  const std::uint32_t from_bottom = WedgeMatching(s, {}, {}, bottom, east).successor(bottom);
  EXPECT_EQ(surface.mesh.colours[from_top].bits, 1u);
  EXPECT_EQ(surface.mesh.colours[from_bottom].bits, 2u);
}

TEST(WedgeMatching, WithoutAContinuousOneAndWithoutTextureTakesTheLowest) {
  // From the east, where three colours meet, down to the bottom, which has the one below.
  TestSurface surface(coloured(octahedron(), [](Vec3 c) { return c.z < 0 ? 1u : (c.y > 0 ? 2u : 3u); }));
  const Surface& s = surface.surface();
  const std::uint32_t east = surface.at(kEast), bottom = surface.at(kBottom), north = surface.at(kNorth);
  const WedgeMatching down(s, {}, {}, east, bottom), aside(s, {}, {}, east, north);
  std::uint32_t lowest = 0xFFFFFFFFu;
  for (Corner c = s.first_corner(north); c != kNoCorner; c = s.next_corner_of(c))
    lowest = std::min(lowest, s.indices[corner_index(c)]);
  for (Corner c = s.first_corner(east); c != kNoCorner; c = s.next_corner_of(c)) {
    const std::uint32_t wedge = s.indices[corner_index(c)];
    EXPECT_EQ(down.successor(wedge), bottom);
    const std::uint32_t colour = surface.mesh.colours[wedge].bits;
    if (colour == 3) { EXPECT_EQ(aside.successor(wedge), lowest) << "no face of the edge has that colour"; }
    else EXPECT_EQ(surface.mesh.colours[aside.successor(wedge)].bits, colour);
  }
}

TEST(WedgeMatching, WithoutAContinuousOneTakesTheNearestOnTheTexture) {
  const Mesh shape = coloured(octahedron(), [](Vec3 c) { return c.z < 0 ? 1u : (c.y > 0 ? 2u : 3u); });
  const auto textured = [&](float of_first, float of_second, float of_third) {
    Mesh mesh = shape;
    mesh.colours.clear();
    for (const Rgba8 colour : shape.colours)
      mesh.texture_coordinates.push_back({colour.bits == 1 ? of_first : colour.bits == 2 ? of_second : of_third, 0});
    return mesh;
  };
  // From the east to the north, which has the first and the second; the third goes to the nearer of them.
  for (const bool first_is_nearer : {true, false}) {
    TestSurface surface(textured(first_is_nearer ? 0.7f : 0.1f, first_is_nearer ? 0.1f : 0.7f, 0.6f));
    const Surface& s = surface.surface();
    const std::uint32_t east = surface.at(kEast), north = surface.at(kNorth);
    const WedgeAttributes attributes{.texture_coordinates = surface.mesh.texture_coordinates.data()};
    const WedgeMatching matching(s, attributes, {}, east, north);
    for (Corner c = s.first_corner(east); c != kNoCorner; c = s.next_corner_of(c)) {
      const std::uint32_t wedge = s.indices[corner_index(c)];
      if (surface.mesh.texture_coordinates[wedge].s != 0.6f) continue;
      EXPECT_EQ(surface.mesh.texture_coordinates[matching.successor(wedge)].s, 0.7f);
    }
  }
}

TEST(WedgeMatching, KeepsToTheMaterialGroup) {
  TestSurface surface(coloured(octahedron(), [](Vec3 c) { return c.z < 0 ? 1u : (c.y > 0 ? 2u : 3u); }));
  const Surface& s = surface.surface();
  const std::uint32_t east = surface.at(kEast), bottom = surface.at(kBottom);
  // Faces 0-3 are the upper ones: their twelve vertices are one group, the lower ones another, which the bottom has
  // alone.
  const MaterialGroup groups[] = {{4, 12}, {8, 24}};
  const WedgeMatching down(s, {}, groups, east, bottom);
  for (Corner c = s.first_corner(east); c != kNoCorner; c = s.next_corner_of(c)) {
    const std::uint32_t wedge = s.indices[corner_index(c)];
    EXPECT_EQ(down.successor(wedge), wedge < 12 ? WedgeMatching::kNone : bottom);
  }
}

}  // namespace
}  // namespace usuzumi::testing
