// What an edge's removal costs, worked out by hand: US 6,396,952, eqs. (1) and (2).
#include "firmware/simplify/edge_removal/edge_value.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <vector>

#include "firmware/simplify/initial_quadrics.h"
#include "firmware/simplify/weld.h"
#include "firmware/simplify/working_surface.h"
#include "tests/support/mesh_shapes.h"

namespace usuzumi::testing {
namespace {

using namespace firmware;

// A mesh on which single edges can be looked at. Values come out in model units.
struct Valued {
  Mesh mesh;
  std::vector<std::uint32_t> vertex_of_wedge, table, links;
  std::vector<Place> places;
  std::vector<Vertex> vertices;
  std::vector<RemovalVertex> removal;
  WorkingMesh working;
  WorkingSurface surface;
  Images images;
  EdgeRemovalSettings settings;

  explicit Valued(const Mesh& given) : mesh(given) {
    const auto count = static_cast<std::uint32_t>(mesh.positions.size()),
               faces = static_cast<std::uint32_t>(mesh.face_count());
    vertex_of_wedge.resize(count);
    table.resize(weld_table_slots(count));
    links.resize(faces * 4);
    places.resize(count);
    vertices.resize(count);
    removal.resize(count);
    working = {.positions = mesh.positions,
               .colours = mesh.colours,
               .texture_coordinates = mesh.texture_coordinates,
               .indices = mesh.indices,
               .vertex_count = count,
               .face_count = faces};
    build_surface(working, {vertex_of_wedge, table, places, vertices, links}, surface);
    set_initial_quadrics(surface.surface);
    images = {surface.attributes.texture_coordinates, surface.attributes.colours, {}};
  }
  void count_borders() {
    for (std::uint32_t v = 0; v < surface.surface.vertex_count; ++v) {
      removal[v].border_edges = 0;
      visit_border_edges(surface.surface, images, v, [&](const BorderEdge&) { ++removal[v].border_edges; });
    }
  }
  EdgeValues values() { return {surface.surface, images, removal.data(), settings}; }
  Corner edge(std::uint32_t a, std::uint32_t b) const {  // a half-edge that runs from a to b
    const Surface& s = surface.surface;
    for (std::uint32_t face = 0; face < s.face_count; ++face)
      for (Corner c = face * 4; c < face * 4 + 3; ++c)
        if (s.vertex_at(c) == a && s.vertex_at(next_in_face(c)) == b) return c;
    ADD_FAILURE() << "no half-edge from " << a << " to " << b;
    return 0;
  }
  float in_volume(float x) const { return x / (surface.scale * surface.scale * surface.scale); }
  float in_area(float x) const { return x / (surface.scale * surface.scale); }
};

// The edge E = (2, 0, 0) from vertex 0 to vertex 1, with
//   two faces on it, each of area 1, in the plane z = 0: |E| A = 2 each;
//   at vertex 0 a face of area 2 in the plane x = 0, N = (1, 0, 0): V = 2 * 2 = 4;
//   at vertex 0 a face of area sqrt(2)/2 with N = (-1, 0, -1)/sqrt(2): V = -sqrt(2) * sqrt(2)/2 = -1;
//   at vertex 1 a face of area 1 in the plane x = 2, N = (-1, 0, 0): V = -2 * 1 = -2.
Mesh edge_of_five_planes() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {1, 1, 0},  {1, -1, 0}, {0, 2, 0}, {0, 0, 2},
                    {-1, 0, 1}, {0, 1, 0}, {2, 0, 1}, {2, 2, 0}};
  mesh.indices = {0, 1, 2, 1, 0, 3, 0, 4, 5, 0, 6, 7, 1, 8, 9};
  return mesh;
}

TEST(EdgeValue, IsEquationOneByHand) {
  Valued valued(edge_of_five_planes());
  const EdgeValues values = valued.values();
  const EdgeShape shape = values.shape_of(valued.edge(0, 1));
  EXPECT_FLOAT_EQ(shape.length / valued.surface.scale, 2);
  EXPECT_FLOAT_EQ(valued.in_volume(shape.at_a.volume), 5);
  EXPECT_FLOAT_EQ(valued.in_volume(shape.at_a.net_volume), 3);
  EXPECT_FLOAT_EQ(valued.in_volume(shape.at_b.volume), 2);
  EXPECT_FLOAT_EQ(valued.in_volume(shape.at_b.net_volume), -2);
  EXPECT_FLOAT_EQ(valued.in_volume(shape.sheet), 4);
  for (const auto& [a, b] : {std::pair{1.0f, 0.0f}, {0.0f, 1.0f}, {3.0f, 0.5f}}) {
    valued.settings.a = a;
    valued.settings.b = b;
    EXPECT_FLOAT_EQ(valued.in_volume(values.computed(valued.edge(0, 1), shape)), a * 7 + b * 4);
  }
}

TEST(EdgeValue, IsTheSameFromEitherEnd) {
  Valued valued(edge_of_five_planes());
  const EdgeValues values = valued.values();
  const EdgeShape there = values.shape_of(valued.edge(0, 1)), back = values.shape_of(valued.edge(1, 0));
  EXPECT_EQ(there.at_a.volume, back.at_b.volume);
  EXPECT_EQ(there.at_a.net_volume, -back.at_b.net_volume);
  EXPECT_EQ(there.sheet, back.sheet);
}

TEST(EdgeValue, NeighboursAddTheirMeanOnce) {
  Valued valued(edge_of_five_planes());
  const EdgeValues values = valued.values();
  // Every edge that shares an end with 0-1, from the list of faces itself.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours = {{1, 2}, {2, 0}, {0, 3}, {3, 1}, {0, 4},
                                                                           {5, 0}, {0, 6}, {7, 0}, {1, 8}, {9, 1}};
  float sum = 0;
  for (const auto& [a, b] : neighbours) {
    const Corner c = valued.edge(a, b);
    sum += values.computed(c, values.shape_of(c));
  }
  ASSERT_GT(sum, 0.0f);
  const Corner edge = valued.edge(0, 1);
  ASSERT_NE(valued.links[edge] & kRepresentative, 0u);
  const EdgeShape shape = values.shape_of(edge);
  const float own = values.computed(edge, shape);
  valued.settings.neighbour_weight = 0.25f;
  EXPECT_FLOAT_EQ(values.computed(edge, shape), own + 0.25f * sum / 10);
}

TEST(EdgeValue, AuthorsValueIsTheLargerEndsInUnitsOfTheMean) {
  Valued valued(edge_of_five_planes());
  EdgeValues values = valued.values();
  const Corner edge = valued.edge(0, 1);
  const EdgeShape shape = values.shape_of(edge);
  const float computed = values.computed(edge, shape);
  values.set_unit(computed * 2);
  valued.settings.computed_weight = 0.5f;
  valued.settings.user_weight = 3;
  valued.removal[0].author_value = 0.25f;
  valued.removal[1].author_value = 4;
  EXPECT_FLOAT_EQ(values.value(edge, shape), 0.5f * computed + 3 * 4 * (computed * 2));
  valued.removal[0].author_value = std::numeric_limits<float>::max();
  EXPECT_LE(values.value(edge, shape), std::numeric_limits<float>::max()) << "never infinite";
}

TEST(EdgeValue, ALockIsMoreThanAnyValue) {
  EXPECT_EQ(larger_author_value(2, 3), 3);
  EXPECT_EQ(larger_author_value(3, 2), 3);
  EXPECT_EQ(larger_author_value(kLockedEdgeValue, 3), kLockedEdgeValue);
  EXPECT_EQ(larger_author_value(3, kLockedEdgeValue), kLockedEdgeValue);
}

// A flat sheet whose upper outline is 0 - 1 - 2 - 3:
//       1 -- 2
//      / \  / \      0 = (0,0), 1 = (1,1), 2 = (3,1), 3 = (4,-1), 4 = (2,-1)
//     0 -- 4 -- 3
// E = (2, 0). The outline before it, L = (1, 1): |N . E| |L| = |1*0 - 1*2| = 2. That after it, L = (1, -2):
// |1*0 + 2*2| = 4.
Mesh sheet_with_corners() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 1, 0}, {3, 1, 0}, {4, -1, 0}, {2, -1, 0}};
  mesh.indices = {0, 4, 1, 1, 4, 2, 2, 4, 3};
  return mesh;
}

TEST(EdgeValue, OutlineIsEquationTwoByHand) {
  Valued valued(sheet_with_corners());
  valued.count_borders();
  for (const RemovalVertex& v : valued.removal) EXPECT_EQ(v.border_edges, 2u);
  const EdgeValues values = valued.values();
  const Corner edge = valued.edge(2, 1);  // the face runs from 2 to 1
  const EdgeShape shape = values.shape_of(edge);
  ASSERT_TRUE(shape.border);
  EXPECT_FLOAT_EQ(valued.in_area(shape.at_a.outline), 4);
  EXPECT_FLOAT_EQ(valued.in_area(shape.at_b.outline), 2);
  EXPECT_LT(shape.at_a.net_outline * shape.at_b.net_outline, 0) << "the outline is convex there";
  // In the order of edges with the length and both coefficients: (4 + 2) * 2 * (a + b); eq. (1) has the sheet term
  // alone, b * 2 * 2.
  valued.settings.a = 3;
  valued.settings.b = 0.5f;
  EXPECT_FLOAT_EQ(valued.in_volume(values.computed(edge, shape)), 12 * 3.5f + 0.5f * 4);
}

TEST(EdgeValue, AnSOfTheOutlineRunsTheSameWayAtBothEnds) {
  Mesh mesh = sheet_with_corners();
  mesh.positions[3] = {4, 2, 0};  // up again: the outline after the edge is L = (1, 1)
  Valued valued(mesh);
  valued.count_borders();
  const EdgeShape shape = valued.values().shape_of(valued.edge(2, 1));
  EXPECT_GT(shape.at_a.net_outline * shape.at_b.net_outline, 0);
  EXPECT_FLOAT_EQ(valued.in_area(shape.at_a.outline), 2);
}

TEST(EdgeValue, FreedomFollowsBoundariesAndLocks) {
  // A sheet of 4 x 2 cells, the image another right of x = 2; vertex (x, y) is 5 y + x.
  const Mesh sheet = grid(4, 2);
  Mesh mesh;
  for (std::size_t f = 0; f < sheet.indices.size(); f += 3) {
    float left = 9;
    for (std::size_t k = 0; k < 3; ++k) left = std::min(left, sheet.positions[sheet.indices[f + k]].x);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = sheet.positions[sheet.indices[f + k]];
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(p);
      mesh.texture_coordinates.push_back({left < 2 ? p.x : p.x + 10, p.y});
    }
  }
  Valued valued(mesh);
  valued.count_borders();
  const Surface& s = valued.surface.surface;
  const auto vertex = [&](float x, float y) {
    std::uint32_t v = 0;
    while (!(mesh.positions[v] == Vec3{x, y, 0})) ++v;
    return s.vertex_of_wedge[v];
  };
  const auto borders = [&](float x, float y) { return valued.removal[vertex(x, y)].border_edges; };
  EXPECT_EQ(borders(1, 1), 0u);
  EXPECT_EQ(borders(2, 1), 2u) << "on the seam";
  EXPECT_EQ(borders(1, 0), 2u) << "on the outline";
  EXPECT_EQ(borders(2, 0), 3u) << "where the seam meets the outline";
  const EdgeValues values = valued.values();
  const auto freedom = [&](float ax, float ay, float bx, float by) {
    const std::uint32_t a = vertex(ax, ay), b = vertex(bx, by);
    for (std::uint32_t face = 0; face < s.face_count; ++face)
      for (Corner c = face * 4; c < face * 4 + 3; ++c) {
        if (s.vertex_at(c) == a && s.vertex_at(next_in_face(c)) == b) return values.freedom_of(values.shape_of(c));
        if (s.vertex_at(c) != b || s.vertex_at(next_in_face(c)) != a) continue;
        const Freedom f = values.freedom_of(values.shape_of(c));
        return f == Freedom::kAtA ? Freedom::kAtB : f == Freedom::kAtB ? Freedom::kAtA : f;
      }
    ADD_FAILURE() << "no such edge";
    return Freedom::kNone;
  };
  EXPECT_EQ(freedom(1, 1, 2, 1), Freedom::kAtB) << "to the seam";
  EXPECT_EQ(freedom(2, 1, 1, 1), Freedom::kAtA);
  EXPECT_EQ(freedom(2, 1, 2, 2), Freedom::kAtB) << "along the seam to its end, which is a corner";
  EXPECT_EQ(freedom(0, 0, 1, 0), Freedom::kAlong) << "along the outline";
  EXPECT_EQ(freedom(1, 0, 2, 0), Freedom::kAtB) << "along the outline to where the seam begins";
  EXPECT_EQ(freedom(1, 0, 1, 1), Freedom::kAtA) << "away from the outline";
  EXPECT_EQ(freedom(3, 0, 3, 1), Freedom::kAtA);
  valued.removal[vertex(1, 1)].author_value = kLockedEdgeValue;
  EXPECT_EQ(freedom(1, 1, 2, 1), Freedom::kNone) << "locked";
}

TEST(EdgeValue, AnEdgeBetweenTwoBoundariesStays) {
  Valued valued(sheet_with_corners());
  valued.count_borders();
  const EdgeValues values = valued.values();
  EXPECT_EQ(values.freedom_of(values.shape_of(valued.edge(1, 4))), Freedom::kNone);
}

TEST(ImageBorder, EdgesOfThreeFacesAndFacesTurnedTheOtherWayAreBoundariesOnce) {
  Mesh mesh;  // 0-1 has three faces; 2-3 two that run the same way
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {5, 5, 5}};
  mesh.indices = {0, 1, 2, 0, 1, 3, 1, 0, 4, 2, 3, 5, 2, 3, 0};
  Valued valued(mesh);
  std::map<std::uint32_t, int> met;
  visit_border_edges(valued.surface.surface, valued.images, 0, [&](const BorderEdge& b) { ++met[b.other]; });
  EXPECT_EQ(met[1], 1);
  met.clear();
  visit_border_edges(valued.surface.surface, valued.images, 3, [&](const BorderEdge& b) { ++met[b.other]; });
  EXPECT_EQ(met[2], 1);
  met.clear();
  const Mesh ball = icosphere(1);
  Valued closed(ball);
  closed.count_borders();
  for (const RemovalVertex& v : closed.removal) EXPECT_EQ(v.border_edges, 0u);
}

}  // namespace
}  // namespace usuzumi::testing
