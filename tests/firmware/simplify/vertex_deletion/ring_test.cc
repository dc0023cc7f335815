// Which rings may be filled, how they are ordered, and where seams cut them.
#include "firmware/simplify/vertex_deletion/ring.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/firmware/simplify/vertex_deletion/ring_surface.h"

namespace usuzumi::testing {
namespace {

using firmware::Ring;

const std::vector<Vec3> kHexagon = {{2, 0, 0}, {1, 2, 0}, {-1, 2, 0}, {-2, 0, 0}, {-1, -2, 0}, {1, -2, 0}};

// The mesh with a wedge of each colour at each position; face f has colours[f].
Mesh coloured_faces(const Mesh& shape, const std::vector<std::uint32_t>& colours) {
  Mesh mesh;
  const auto vertices = static_cast<std::uint32_t>(shape.positions.size());
  for (std::uint32_t colour = 0; colour < 3; ++colour) {
    for (const Vec3 p : shape.positions) {
      mesh.positions.push_back(p);
      mesh.colours.push_back({colour});
    }
  }
  for (std::size_t i = 0; i < shape.indices.size(); ++i)
    mesh.indices.push_back(colours[i / 3] * vertices + shape.indices[i]);
  return mesh;
}

TEST(Ring, OfAnInnerVertexGoesRoundOnceWhateverTheOrderOfFaces) {
  Mesh mesh = closed_ring({0, 0, 0}, kHexagon);
  for (const std::size_t face : {1u, 3u}) std::swap_ranges(&mesh.indices[0], &mesh.indices[3], &mesh.indices[3 * face]);
  const auto ring = RingSurface(mesh).ring(0);
  ASSERT_TRUE(ring.has_value());
  EXPECT_FALSE(ring->open);
  EXPECT_EQ(ring->sector_count, 1u);
  EXPECT_EQ(ring->sectors[0].corner_count, 6u);
  for (std::uint32_t i = 0; i < 6; ++i) EXPECT_EQ(ring->vertices[(i + 1) % 6], ring->vertices[i] % 6 + 1);
}

TEST(Ring, OfABoundaryVertexRunsFromBorderToBorder) {
  Mesh mesh = open_ring({0, 0, 0}, kHexagon);
  for (const std::size_t face : {2u, 4u}) std::swap_ranges(&mesh.indices[0], &mesh.indices[3], &mesh.indices[3 * face]);
  const auto ring = RingSurface(mesh).ring(0);
  ASSERT_TRUE(ring.has_value());
  EXPECT_TRUE(ring->open);
  EXPECT_TRUE(ring->adds_closing_edge());
  ASSERT_EQ(ring->sectors[0].corner_count, 6u);
  for (std::uint32_t i = 0; i < 6; ++i) EXPECT_EQ(ring->vertices[i], i + 1);
}

TEST(Ring, IsCutInTwoWhereASeamPassesThrough) {
  const auto ring = RingSurface(coloured_faces(closed_ring({0, 0, 0}, kHexagon), {0, 0, 1, 1, 1, 1})).ring(0);
  ASSERT_TRUE(ring.has_value());
  ASSERT_TRUE(ring->has_seam());
  for (const firmware::Sector& sector : ring->sectors) {
    const std::uint32_t colour = sector.face_count == 2 ? 0 : 1;
    EXPECT_EQ(sector.face_count, colour == 0 ? 2u : 4u);
    EXPECT_EQ(sector.corner_count, sector.face_count + 1);
    for (std::uint32_t i = 0; i < sector.corner_count; ++i)
      EXPECT_EQ(ring->wedges[sector.first_corner + i] / 7, colour) << "seven wedges of each colour";
  }
  EXPECT_EQ(ring->vertices[ring->sectors[1].first_corner], ring->vertices[ring->sectors[0].corner_count - 1]);
}

TEST(Ring, WhereThreeSeamsMeetStays) {
  EXPECT_FALSE(RingSurface(coloured_faces(closed_ring({0, 0, 0}, kHexagon), {0, 0, 1, 1, 2, 2})).ring(0).has_value());
}

TEST(Ring, WhereASeamEndsStays) {
  // One wedge at the vertex; the faces on either side of its edge to corner 2 do not agree about that corner.
  Mesh mesh = closed_ring({0, 0, 0}, kHexagon);
  mesh.colours.assign(7, Rgba8{0});
  mesh.positions.push_back(mesh.positions[2]);
  mesh.colours.push_back({1});
  mesh.indices[3 * 1 + 1] = 7;  // face 1 begins at corner 2
  EXPECT_FALSE(RingSurface(mesh).ring(0).has_value());
  mesh.colours[7] = {0};  // the same wedge after all
  EXPECT_TRUE(RingSurface(mesh).ring(0).has_value());
}

TEST(Ring, WhereASeamMeetsTheBoundaryStays) {
  EXPECT_FALSE(RingSurface(coloured_faces(open_ring({0, 0, 0}, kHexagon), {0, 0, 1, 1, 1})).ring(0).has_value());
}

TEST(Ring, SideOfASingleFaceNeedsItsOwnKindBeyond) {
  // Face 0 alone has colour 0; beyond its outer edge, between corners 1 and 2, lies a face of colour `beyond`.
  Mesh shape = closed_ring({0, 0, 0}, kHexagon);
  shape.positions.push_back({3, 3, 0});
  shape.indices.insert(shape.indices.end(), {2, 1, 7});
  const auto with = [&](std::uint32_t beyond) {
    return RingSurface(coloured_faces(shape, {0, 1, 1, 1, 1, 1, beyond})).ring(0);
  };
  const auto ring = with(0);
  ASSERT_TRUE(ring.has_value()) << "the seam moves onto the outer edge";
  EXPECT_FALSE(ring->adds_closing_edge());
  EXPECT_FALSE(with(1).has_value()) << "the chart would be gone";
  shape.indices.resize(18);
  EXPECT_FALSE(RingSurface(coloured_faces(shape, {0, 1, 1, 1, 1, 1})).ring(0).has_value()) << "a border beyond";
}

// The ring around the origin whose first neighbour has a wedge for each of its two faces, `apart` on the texture.
Mesh beside_a_pole(float apart) {
  Mesh mesh = closed_ring({0, 0, 0}, kHexagon);
  for (const Vec3 p : mesh.positions) mesh.texture_coordinates.push_back({p.x, p.y});
  mesh.normals.assign(mesh.positions.size(), pack_normal({0, 0, 1}));
  mesh.positions.push_back(mesh.positions[1]);
  mesh.texture_coordinates.push_back({2, apart});
  mesh.normals.push_back(mesh.normals[1]);
  for (std::size_t i = 0; i < 3; ++i)
    if (mesh.indices[i] == 1) mesh.indices[i] = 7;
  return mesh;
}

TEST(Ring, ASeamThatComesNoFurtherThanANeighbourAndHardlyMattersIsNone) {
  const auto ring = RingSurface(beside_a_pole(1.9f)).ring(0);
  ASSERT_TRUE(ring.has_value());
  EXPECT_EQ(ring->sector_count, 1u);
  EXPECT_EQ(ring->sectors[0].corner_count, 6u);
  EXPECT_FALSE(RingSurface(beside_a_pole(2.1f)).ring(0).has_value()) << "further than the vertex is from it";
}

TEST(Ring, ASeamThatComesToANeighbourAndBendsShadingIsOne) {
  Mesh creased = beside_a_pole(1);
  creased.normals.back() = pack_normal({0, 1, 0});
  EXPECT_FALSE(RingSurface(creased).ring(0).has_value());
  Mesh painted = beside_a_pole(1);
  painted.colours.assign(painted.positions.size(), {1});
  ASSERT_TRUE(RingSurface(painted).ring(0).has_value());
  painted.colours.back() = {2};
  EXPECT_FALSE(RingSurface(painted).ring(0).has_value());
  Mesh bare = beside_a_pole(1);
  bare.texture_coordinates.clear();
  bare.normals.back() = pack_normal({0, 1, 0});
  EXPECT_FALSE(RingSurface(bare).ring(0).has_value());
}

}  // namespace
}  // namespace usuzumi::testing
