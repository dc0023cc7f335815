#include "tests/support/mesh_shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace usuzumi::testing {
namespace {

using PositionKey = std::tuple<float, float, float>;
PositionKey key_of(Vec3 p) { return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; }

// Splits every edge once; `place` gives the new vertex.
template <class Place>
Mesh split_edges(const Mesh& mesh, Place place) {
  Mesh result;
  result.positions = mesh.positions;
  std::unordered_map<std::uint64_t, std::uint32_t> middles;
  middles.reserve(mesh.indices.size());
  auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
    const auto [it, added] = middles.try_emplace(key, static_cast<std::uint32_t>(result.positions.size()));
    if (added) result.positions.push_back(place(mesh.positions[a], mesh.positions[b]));
    return it->second;
  };
  for (std::size_t f = 0; f < mesh.indices.size(); f += 3) {
    const std::uint32_t a = mesh.indices[f], b = mesh.indices[f + 1], c = mesh.indices[f + 2];
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const std::uint32_t i : {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca}) result.indices.push_back(i);
  }
  return result;
}

}  // namespace

Mesh icosphere(int levels) {
  const float t = (1.0f + std::sqrt(5.0f)) / 2.0f;
  Mesh mesh;
  for (const Vec3 p : {Vec3{-1, t, 0},
                       {1, t, 0},
                       {-1, -t, 0},
                       {1, -t, 0},
                       {0, -1, t},
                       {0, 1, t},
                       {0, -1, -t},
                       {0, 1, -t},
                       {t, 0, -1},
                       {t, 0, 1},
                       {-t, 0, -1},
                       {-t, 0, 1}})
    mesh.positions.push_back(normalized(p));
  mesh.indices = {0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4, 11, 10, 2, 10, 7, 6, 7, 1, 8,
                  3, 9, 4, 3, 4, 2, 3, 2, 6, 3, 6, 8, 3, 8, 9, 4, 9, 5, 2, 4, 11, 6, 2, 10, 8, 6, 7, 9, 8, 1};
  for (int i = 0; i < levels; ++i) mesh = split_edges(mesh, [](Vec3 a, Vec3 b) { return normalized(a + b); });
  return mesh;
}

Mesh grid(std::uint32_t columns, std::uint32_t rows) {
  Mesh mesh;
  for (std::uint32_t y = 0; y <= rows; ++y)
    for (std::uint32_t x = 0; x <= columns; ++x)
      mesh.positions.push_back({static_cast<float>(x), static_cast<float>(y), 0});
  for (std::uint32_t y = 0; y < rows; ++y) {
    for (std::uint32_t x = 0; x < columns; ++x) {
      const std::uint32_t a = y * (columns + 1) + x, b = a + 1, c = b + columns + 1, d = a + columns + 1;
      for (const std::uint32_t i : {a, b, c, a, c, d}) mesh.indices.push_back(i);
    }
  }
  return mesh;
}

Mesh cube(std::uint32_t n) {
  const Mesh side = grid(n, n);
  const float s = static_cast<float>(n);
  Mesh mesh;
  // Each side's (x, y) of the grid runs so that the triangle's normal points outwards.
  const std::array<Vec3 (*)(float, float, float), 6> places = {
      [](float x, float y, float e) { return Vec3{x, y, e}; }, [](float x, float y, float) { return Vec3{y, x, 0}; },
      [](float x, float y, float e) { return Vec3{e, x, y}; }, [](float x, float y, float) { return Vec3{0, y, x}; },
      [](float x, float y, float e) { return Vec3{y, e, x}; }, [](float x, float y, float) { return Vec3{x, 0, y}; }};
  for (const auto place : places) {
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3 p : side.positions) mesh.positions.push_back(place(p.x, p.y, s));
    for (const std::uint32_t i : side.indices) mesh.indices.push_back(base + i);
  }
  return welded(mesh);
}

Mesh subdivided(const Mesh& mesh) {
  return split_edges(mesh, [](Vec3 a, Vec3 b) { return (a + b) * 0.5f; });
}

Mesh with_flat_normals(const Mesh& mesh) {
  Mesh result;
  for (std::size_t f = 0; f < mesh.indices.size(); f += 3) {
    const Vec3 a = mesh.positions[mesh.indices[f]], b = mesh.positions[mesh.indices[f + 1]],
               c = mesh.positions[mesh.indices[f + 2]];
    const PackedNormal normal = pack_normal(normalized(cross(b - a, c - a)));
    for (const Vec3 p : {a, b, c}) {
      result.indices.push_back(static_cast<std::uint32_t>(result.positions.size()));
      result.positions.push_back(p);
      result.normals.push_back(normal);
    }
  }
  return result;
}

Mesh welded(const Mesh& mesh) {
  Mesh result;
  std::map<PositionKey, std::uint32_t> numbers;
  std::vector<std::uint32_t> number(mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const auto [it, added] =
        numbers.try_emplace(key_of(mesh.positions[v]), static_cast<std::uint32_t>(result.positions.size()));
    if (added) result.positions.push_back(mesh.positions[v]);
    number[v] = it->second;
  }
  for (std::size_t f = 0; f < mesh.indices.size(); f += 3) {
    const std::uint32_t a = number[mesh.indices[f]], b = number[mesh.indices[f + 1]], c = number[mesh.indices[f + 2]];
    if (a == b || b == c || c == a) continue;
    for (const std::uint32_t i : {a, b, c}) result.indices.push_back(i);
  }
  return result;
}

MeshTopology topology_of(const Mesh& mesh) {
  MeshTopology result;
  std::map<PositionKey, std::uint32_t> numbers;
  // Per edge (lower, higher vertex): faces that run up it, faces that run down.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::size_t, std::size_t>> edges;
  auto number = [&](std::uint32_t index) {
    return numbers.try_emplace(key_of(mesh.positions[index]), static_cast<std::uint32_t>(numbers.size())).first->second;
  };
  for (std::size_t f = 0; f < mesh.indices.size(); f += 3) {
    const std::array<std::uint32_t, 3> v = {number(mesh.indices[f]), number(mesh.indices[f + 1]),
                                            number(mesh.indices[f + 2])};
    ++result.faces;
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
      ++result.degenerate_faces;
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = v[k], b = v[(k + 1) % 3];
      auto& [up, down] = edges[{std::min(a, b), std::max(a, b)}];
      ++(a < b ? up : down);
    }
  }
  result.vertices = numbers.size();
  result.edges = edges.size();
  for (const auto& [ends, faces] : edges) {
    const std::size_t total = faces.first + faces.second;
    if (total == 1) ++result.border_edges;
    if (total > 2) ++result.non_manifold_edges;
    if (total == 2 && faces.first != 1) ++result.misoriented_edges;
  }
  return result;
}

}  // namespace usuzumi::testing
