#include "sim/pack/normals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sim/pack/weld.h"

namespace usuzumi::sim {
namespace {

constexpr double kCreaseCosine = 0.5;  // of 60 degrees
/// At a position with more faces than this (the tip of a finely divided cone) all of them are averaged, because
/// comparing each with each would take too long. Arbitrary.
constexpr std::size_t kMostFacesCompared = 256;
/// Shorter than this a normal from a file is an accident, not a direction.
constexpr float kShortestNormal = 1e-6f;

struct Normal {
  double x = 0, y = 0, z = 0;
};
double dot(const Normal& a, const Normal& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double length(const Normal& a) { return std::sqrt(dot(a, a)); }
void add(Normal& a, const Normal& b) {
  a.x += b.x;
  a.y += b.y;
  a.z += b.z;
}
Vec3 unit(const Normal& a) {
  const double l = length(a);
  if (!(l > 0)) return {0, 0, 1};
  return {static_cast<float>(a.x / l), static_cast<float>(a.y / l), static_cast<float>(a.z / l)};
}

/// Twice the face's area along its normal.
Normal area_vector(Vec3 a, Vec3 b, Vec3 c) {
  const double ux = double{b.x} - double{a.x}, uy = double{b.y} - double{a.y}, uz = double{b.z} - double{a.z};
  const double vx = double{c.x} - double{a.x}, vy = double{c.y} - double{a.y}, vz = double{c.z} - double{a.z};
  return {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
}

/// The faces around each position, in rising order.
struct FacesAround {
  std::vector<std::uint32_t> begin;  // per position, and one more
  std::vector<std::uint32_t> faces;

  FacesAround(const Mesh& mesh, const PositionIds& ids)
      : begin(ids.first_vertex.size() + 1), faces(mesh.indices.size()) {
    for (std::uint32_t v : mesh.indices) ++begin[ids.of_vertex[v] + 1];
    for (std::size_t p = 1; p < begin.size(); ++p) begin[p] += begin[p - 1];
    std::vector<std::uint32_t> fill(begin.begin(), begin.end() - 1);
    for (std::uint32_t c = 0; c < mesh.indices.size(); ++c) faces[fill[ids.of_vertex[mesh.indices[c]]]++] = c / 3;
  }
  std::span<const std::uint32_t> at(std::uint32_t position) const {
    return std::span(faces).subspan(begin[position], begin[position + 1] - begin[position]);
  }
};

bool usable(Vec3 n) { return is_finite(n) && length(n) > kShortestNormal; }

/// The smooth normal of face `f`'s corner where the faces `around` meet.
Vec3 corner_normal(std::uint32_t f, std::span<const std::uint32_t> around, std::span<const Normal> areas) {
  const double own_length = length(areas[f]);
  const bool all = around.size() > kMostFacesCompared || !(own_length > 0);
  Normal sum;
  for (std::uint32_t g : around)
    if (all || dot(areas[f], areas[g]) >= kCreaseCosine * own_length * length(areas[g])) add(sum, areas[g]);
  return unit(sum);
}

/// `values` by corner where they were by vertex; an empty list stays empty.
template <class T>
void by_corner(std::vector<T>& values, std::span<const std::uint32_t> indices) {
  if (values.empty()) return;
  std::vector<T> parted;
  parted.reserve(indices.size());
  for (std::uint32_t v : indices) parted.push_back(values[v]);
  values = std::move(parted);
}

/// A vertex for each corner of each face, so that neighbours can differ; welding joins them again.
void part_corners(Mesh& mesh) {
  if (mesh.normals.empty()) mesh.normals.resize(mesh.positions.size(), Vec3{});
  by_corner(mesh.positions, mesh.indices);
  by_corner(mesh.colours, mesh.indices);
  by_corner(mesh.texture_coordinates, mesh.indices);
  by_corner(mesh.normals, mesh.indices);
  for (VertexGroup& group : mesh.vertex_groups) by_corner(group.members, mesh.indices);
  for (std::uint32_t c = 0; c < mesh.indices.size(); ++c) mesh.indices[c] = c;
}

}  // namespace

void complete_normals(Mesh& mesh) {
  if (!mesh.normals.empty() && std::all_of(mesh.normals.begin(), mesh.normals.end(), usable)) {
    for (Vec3& n : mesh.normals) n = normalized(n);
    return;
  }
  const PositionIds ids = number_positions(mesh.positions);
  const FacesAround around(mesh, ids);
  std::vector<Normal> areas(mesh.face_count());
  for (std::size_t f = 0; f < areas.size(); ++f)
    areas[f] = area_vector(mesh.positions[mesh.indices[3 * f]], mesh.positions[mesh.indices[3 * f + 1]],
                           mesh.positions[mesh.indices[3 * f + 2]]);
  std::vector<std::uint32_t> position_of_corner;
  for (std::uint32_t v : mesh.indices) position_of_corner.push_back(ids.of_vertex[v]);
  part_corners(mesh);
  for (std::uint32_t c = 0; c < mesh.indices.size(); ++c)
    mesh.normals[c] = usable(mesh.normals[c]) ? normalized(mesh.normals[c])
                                              : corner_normal(c / 3, around.at(position_of_corner[c]), areas);
}

bool has_open_border(const Mesh& mesh) {
  const PositionIds ids = number_positions(mesh.positions);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(mesh.indices.size());
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k)
      edges.push_back(std::minmax({ids.of_vertex[mesh.indices[i + k]], ids.of_vertex[mesh.indices[i + (k + 1) % 3]]}));
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i;
    while (j < edges.size() && edges[j] == edges[i]) ++j;
    if (j == i + 1) return true;
    i = j;
  }
  return false;
}

}  // namespace usuzumi::sim
