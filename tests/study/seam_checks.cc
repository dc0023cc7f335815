#include "tests/study/seam_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/bench/simplify/error_meter.h"

namespace usuzumi::study {
namespace {

using Place = std::array<float, 3>;
using Edge = std::pair<Place, Place>;

Place place_of(Vec3 p) { return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; }  // -0 becomes 0

std::uint32_t colour_at(const testing::Mesh& mesh, std::uint32_t vertex) {
  return mesh.colours.empty() ? 0 : mesh.colours[vertex].bits;
}

struct Borders {
  std::size_t count = 0;
  double length = 0;
};

Borders borders_of(const std::vector<Edge>& edges) {
  Borders borders;
  std::map<Place, Place> parent;
  const auto root = [&](Place p) {
    for (Place up = parent.try_emplace(p, p).first->second; up != p; up = parent.at(p)) p = up;
    return p;
  };
  for (const auto& [a, b] : edges) {
    parent[root(a)] = root(b);
    borders.length += std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  }
  for (const auto& [place, up] : parent) borders.count += place == up ? 1u : 0u;
  return borders;
}

// Of each part that has any: edges of exactly one face of the part.
std::map<std::uint32_t, Borders> borders_by_part(const testing::Mesh& mesh) {
  std::map<std::uint32_t, std::map<Edge, int>> faces;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      Place a = place_of(mesh.positions[mesh.indices[i + k]]);
      Place b = place_of(mesh.positions[mesh.indices[i + (k + 1) % 3]]);
      if (a == b) continue;
      if (b < a) std::swap(a, b);
      ++faces[colour_at(mesh, mesh.indices[i])][{a, b}];
    }
  }
  std::map<std::uint32_t, Borders> borders;
  for (const auto& [part, edges] : faces) {
    std::vector<Edge> open;
    for (const auto& [edge, count] : edges)
      if (count == 1) open.push_back(edge);
    borders[part] = borders_of(open);
  }
  return borders;
}

// The faces of each part, with all of the mesh's vertices.
std::map<std::uint32_t, testing::Mesh> by_part(const testing::Mesh& mesh) {
  std::map<std::uint32_t, testing::Mesh> parts;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    testing::Mesh& part = parts[colour_at(mesh, mesh.indices[i])];
    for (std::size_t k = 0; k < 3; ++k) {
      part.indices.push_back(static_cast<std::uint32_t>(part.positions.size()));
      part.positions.push_back(mesh.positions[mesh.indices[i + k]]);
    }
  }
  return parts;
}

}  // namespace

std::size_t count_seam_vertices(const testing::Mesh& mesh) {
  std::map<Place, std::set<std::tuple<float, float, std::uint32_t>>> images;
  for (const std::uint32_t v : mesh.indices)
    images[place_of(mesh.positions[v])].insert(
        {mesh.texture_coordinates[v].s + 0.0f, mesh.texture_coordinates[v].t + 0.0f, colour_at(mesh, v)});
  return static_cast<std::size_t>(
      std::count_if(images.begin(), images.end(), [](const auto& entry) { return entry.second.size() > 1; }));
}

std::size_t count_holes(const testing::Mesh& original, const testing::Mesh& thinned) {
  constexpr double kLonger = 1.3;  // a triangle of the area of a disc has a border 1.29 times as long
  std::map<std::uint32_t, Borders> before = borders_by_part(original);
  std::size_t holes = 0;
  for (const auto& [part, borders] : borders_by_part(thinned)) {
    const Borders& whole = before[part];
    if (borders.count > whole.count) holes += borders.count - whole.count;
    else if (borders.length > whole.length * kLonger) ++holes;
  }
  return holes;
}

std::size_t count_flipped(const testing::Mesh& original, const testing::Mesh& thinned) {
  constexpr std::size_t kSamples = 2000;  // beside the vertices, where distances mostly are largest
  const std::map<std::uint32_t, testing::Mesh> whole = by_part(original);
  std::size_t flipped = 0;
  for (const auto& [part, mesh] : by_part(thinned)) {
    const testing::Mesh& from = whole.at(part);
    flipped += bench::count_flipped_faces(from, mesh, bench::measure_error(from, mesh, kSamples).hausdorff);
  }
  return flipped;
}

}  // namespace usuzumi::study
