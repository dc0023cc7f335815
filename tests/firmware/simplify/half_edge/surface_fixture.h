// A test mesh as the connectivity that a method works on, with its seams found.
#pragma once

#include <cstdint>
#include <vector>

#include "firmware/simplify/half_edge/half_edge_cost.h"
#include "firmware/simplify/half_edge/seams.h"
#include "firmware/simplify/initial_quadrics.h"
#include "firmware/simplify/weld.h"
#include "firmware/simplify/working_surface.h"
#include "tests/support/mesh_shapes.h"

namespace usuzumi::testing {

struct TestSurface {
  Mesh mesh;
  std::vector<std::uint32_t> vertex_of_wedge, table, links, words;
  std::vector<firmware::Place> places;
  std::vector<firmware::Vertex> vertices;
  std::vector<float> areas;
  firmware::WorkingSurface working;
  firmware::Seams seams;
  firmware::HalfEdgeCosts costs;

  explicit TestSurface(const Mesh& given)
      : mesh(given), vertex_of_wedge(given.positions.size()),
        table(firmware::weld_table_slots(static_cast<std::uint32_t>(given.positions.size()))),
        links(given.face_count() * 4), words(given.positions.size()), places(given.positions.size()),
        vertices(given.positions.size()), areas(given.positions.size()) {
    firmware::WorkingMesh view{.positions = mesh.positions,
                               .normals = mesh.normals,
                               .colours = mesh.colours,
                               .texture_coordinates = mesh.texture_coordinates,
                               .indices = mesh.indices,
                               .vertex_count = static_cast<std::uint32_t>(mesh.positions.size()),
                               .face_count = static_cast<std::uint32_t>(mesh.face_count())};
    build_surface(view, {vertex_of_wedge, table, places, vertices, links}, working);
    set_initial_quadrics(surface());
    seams = firmware::Seams(surface(), words);
    seams.find();
    costs = firmware::HalfEdgeCosts(surface(), seams, areas);
    costs.start();
  }
  TestSurface(const TestSurface&) = delete;
  TestSurface& operator=(const TestSurface&) = delete;

  firmware::Surface& surface() { return working.surface; }
  /// The vertex at a position of the mesh as given.
  std::uint32_t at(Vec3 p) const {
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
      if (mesh.positions[v] == p) return vertex_of_wedge[v];
    return 0xFFFFFFFFu;
  }
  firmware::SeamRelation relation(Vec3 from, Vec3 to) const {
    return seams.relation(at(from), at(to), seams.look_at_edge(at(from), at(to)));
  }
  /// The collapse of the edge from one position to another, and no other.
  firmware::HalfEdge half_edge(Vec3 from, Vec3 to) {
    const firmware::Surface& s = surface();
    for (std::uint32_t face = 0; face < s.face_count; ++face) {
      for (firmware::Corner c = face * 4; c < face * 4 + 3; ++c) {
        const std::uint32_t a = s.vertex_at(c), b = s.vertex_at(firmware::next_in_face(c));
        if (a == at(from) && b == at(to)) return costs.cheapest(c, firmware::kBackwardRefused);
        if (b == at(from) && a == at(to)) return costs.cheapest(c, firmware::kForwardRefused);
      }
    }
    return {};
  }
  double model_units(float cost) const {
    const double scale = working.scale;
    return cost / (scale * scale * scale * scale);
  }
};

/// `shape` with one vertex per face corner, each face in the colour of bits `colour(centre)`: a seam lies where colours
/// meet.
template <class Colour>
Mesh coloured(const Mesh& shape, Colour colour) {
  Mesh mesh;
  for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
    const Vec3 centre = (shape.positions[shape.indices[i]] + shape.positions[shape.indices[i + 1]] +
                         shape.positions[shape.indices[i + 2]]) * (1.0f / 3);
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(shape.positions[shape.indices[i + k]]);
      mesh.colours.push_back({colour(centre)});
    }
  }
  return mesh;
}

inline constexpr Vec3 kEast{1, 0, 0}, kWest{-1, 0, 0}, kNorth{0, 1, 0}, kSouth{0, -1, 0}, kTop{0, 0, 1},
    kBottom{0, 0, -1};

/// Corners at distance 1 on the axes, facing outwards; the upper faces come first.
inline Mesh octahedron() {
  Mesh mesh;
  mesh.positions = {kEast, kWest, kNorth, kSouth, kTop, kBottom};
  mesh.indices = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
  return mesh;
}

}  // namespace usuzumi::testing
