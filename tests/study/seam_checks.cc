#include "tests/study/seam_checks.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "tests/bench/simplify/error_meter.h"

namespace usuzumi::study {
namespace {

using Place = std::array<float, 3>;
using Edge = std::pair<Place, Place>;

Place place_of(Vec3 p) { return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; }  // -0 becomes 0

bench::Point point_of(Vec3 p) { return {p.x, p.y, p.z}; }

/// Edges of exactly one face.
std::vector<Edge> border_edges(const testing::Mesh& mesh) {
  std::map<Edge, int> faces;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      Place a = place_of(mesh.positions[mesh.indices[i + k]]);
      Place b = place_of(mesh.positions[mesh.indices[i + (k + 1) % 3]]);
      if (a == b) continue;
      if (b < a) std::swap(a, b);
      ++faces[{a, b}];
    }
  }
  std::vector<Edge> borders;
  for (const auto& [edge, count] : faces)
    if (count == 1) borders.push_back(edge);
  return borders;
}

}  // namespace

std::size_t count_seam_vertices(const testing::Mesh& mesh) {
  std::map<Place, std::set<std::pair<float, float>>> coordinates;
  for (const std::uint32_t v : mesh.indices)
    coordinates[place_of(mesh.positions[v])].insert(
        {mesh.texture_coordinates[v].s + 0.0f, mesh.texture_coordinates[v].t + 0.0f});
  return static_cast<std::size_t>(
      std::count_if(coordinates.begin(), coordinates.end(), [](const auto& entry) { return entry.second.size() > 1; }));
}

std::size_t count_hole_edges(const testing::Mesh& original, const testing::Mesh& thinned, double tolerance) {
  // Borders as faces without area: the distance to such a one is that to its edge.
  testing::Mesh borders;
  for (const auto& [a, b] : border_edges(original)) {
    const auto first = static_cast<std::uint32_t>(borders.positions.size());
    borders.positions.push_back({a[0], a[1], a[2]});
    borders.positions.push_back({b[0], b[1], b[2]});
    borders.indices.insert(borders.indices.end(), {first, first + 1, first + 1});
  }
  const std::vector<Edge> open = border_edges(thinned);
  if (borders.indices.empty()) return open.size();
  const bench::SurfaceIndex index(borders);
  return static_cast<std::size_t>(std::count_if(open.begin(), open.end(), [&](const Edge& edge) {
    const auto& [a, b] = edge;
    const Vec3 middle = (Vec3{a[0], a[1], a[2]} + Vec3{b[0], b[1], b[2]}) * 0.5f;
    return index.nearest(point_of(middle)).squared_distance > tolerance * tolerance;
  }));
}

}  // namespace usuzumi::study
