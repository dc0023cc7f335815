// What an edge costs: one at a time and many at once, and where its vertex goes.
#include "firmware/simplify/qem/edge_cost.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <vector>

namespace usuzumi::testing {
namespace {

using namespace firmware;

// Faces of three random vertices each, whose quadrics are sums of random planes.
struct RandomEdges {
  std::vector<Place> places;
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<Corner> edges;
  Surface surface;

  RandomEdges(std::uint32_t faces, int planes, float scale) {
    std::mt19937 random(7);
    const auto number = [&] { return (static_cast<float>(random() >> 8) * 0x1p-24f - 0.5f) * scale; };
    for (std::uint32_t v = 0; v < faces * 3; ++v) {
      places.push_back({{number(), number(), number()}, static_cast<std::uint32_t>(random())});
      Vertex vertex;
      for (int i = 0; i < planes; ++i) {
        add_plane_through_owner(vertex.quadric, {number(), number(), number()}, 1.0f);
        vertex.quadric = moved_to(vertex.quadric, Vec3{number(), number(), number()} * 0.1f);
      }
      vertices.push_back(vertex);
      indices.push_back(v);
    }
    for (std::uint32_t face = 0; face < faces; ++face)
      for (std::uint32_t k = 0; k < 3; ++k) edges.push_back(face * 4 + k);
    surface.places = places.data();
    surface.vertices = vertices.data();
    surface.indices = indices.data();
    surface.vertex_count = faces * 3;
    surface.face_count = faces;
  }
};

// The order of collapses, and that it ends, rest on this.
TEST(EdgeCost, ManyAtOnceHaveTheBitsOfEachAlone) {
  for (const float scale : {1.0f, 1e9f, 1e-9f, 1e-18f}) {  // the last one's quadrics are denormal
    for (const int planes : {0, 1, 2, 5}) {  // with one or two planes there is no minimum but for the pull
      const RandomEdges random(35, planes, scale);         // 105 edges: fours and one left over
      for (const Placement placement : {Placement::kOptimal, Placement::kMidpoint}) {
        std::vector<float> costs(random.edges.size());
        cost_edges(random.surface, random.edges, placement, costs.data());
        for (std::size_t i = 0; i < costs.size(); ++i) {
          const Corner edge = random.edges[i];
          const EdgeCost one = cost_edge(random.surface, random.surface.vertex_at(edge),
                                         random.surface.vertex_at(next_in_face(edge)), placement);
          ASSERT_EQ(std::bit_cast<std::uint32_t>(costs[i]), std::bit_cast<std::uint32_t>(one.cost))
              << i << ' ' << scale;
          ASSERT_GE(one.cost, 0.0f);
        }
      }
    }
  }
}

TEST(EdgeCost, ThreePlanesMeetWhereTheVertexGoes) {
  // The corner of a cube, seen from two vertices on its edge along x: the planes y = 0 and z = 0 at both, x = 0 at the
  // first.
  Place places[2] = {{{0.5f, 0, 0}, 0}, {{1.5f, 0, 0}, 0}};
  Vertex vertices[2];
  for (Vertex& v : vertices) {
    add_plane_through_owner(v.quadric, {0, 1, 0}, 1);
    add_plane_through_owner(v.quadric, {0, 0, 1}, 1);
  }
  Quadric wall;
  add_plane_through_owner(wall, {1, 0, 0}, 1);
  wall = moved_to(wall, {0.5f, 0, 0});  // its owner lies half a unit from it
  vertices[0].quadric.xx += wall.xx;
  vertices[0].quadric.b = vertices[0].quadric.b + wall.b;
  vertices[0].quadric.c += wall.c;
  Surface surface;
  surface.places = places;
  surface.vertices = vertices;
  const EdgeCost cost = cost_edge(surface, 0, 1, Placement::kOptimal);
  const Vec3 vertex = places[0].position + refined_offset(cost);
  EXPECT_NEAR(vertex.x, 0, 1e-5f);
  EXPECT_NEAR(vertex.y, 0, 1e-6f);
  EXPECT_NEAR(vertex.z, 0, 1e-6f);
  EXPECT_NEAR(cost.cost, 0, 1e-3f);
}

}  // namespace
}  // namespace usuzumi::testing
