#include "tests/bench/simplify/error_meter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace usuzumi::bench {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;

Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Point operator*(Point a, double s) { return {a.x * s, a.y * s, a.z * s}; }
double dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Point cross(Point a, Point b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Point lowest(Point a, Point b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Point highest(Point a, Point b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }
Point as_point(Vec3 p) { return {p.x, p.y, p.z}; }

std::array<Point, 3> corners_of(const testing::Mesh& mesh, std::size_t face) {
  return {as_point(mesh.positions[mesh.indices[face * 3]]), as_point(mesh.positions[mesh.indices[face * 3 + 1]]),
          as_point(mesh.positions[mesh.indices[face * 3 + 2]])};
}
Point area_vector(const std::array<Point, 3>& t) { return cross(t[1] - t[0], t[2] - t[0]); }

double squared_distance_to_segment(Point p, Point a, Point b) {
  const Point ab = b - a, ap = p - a;
  const double squared = dot(ab, ab);
  const double t = squared > 0 ? std::clamp(dot(ap, ab) / squared, 0.0, 1.0) : 0.0;
  const Point d = ap - ab * t;
  return dot(d, d);
}

// SplitMix64 (Steele, Lea & Flood 2014): the same sequence everywhere, unlike std distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double unit() {
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

}  // namespace

double squared_distance_to_triangle(Point p, Point a, Point b, Point c) {
  const Point ab = b - a, ac = c - a, normal = cross(ab, ac);
  const double squared = dot(normal, normal);
  if (squared > 0) {
    // Inside the prism over the triangle, the plane is nearest; outside, an edge is.
    const Point ap = p - a;
    const double v = dot(cross(ap, ac), normal), w = dot(cross(ab, ap), normal);
    if (v >= 0 && w >= 0 && v + w <= squared) {
      const double height = dot(ap, normal);
      return height * height / squared;
    }
  }
  return std::min({squared_distance_to_segment(p, a, b), squared_distance_to_segment(p, b, c),
                   squared_distance_to_segment(p, c, a)});
}

SurfaceIndex::SurfaceIndex(const testing::Mesh& mesh) {
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto t = corners_of(mesh, f);
    triangles_.push_back({{t[0], t[1], t[2]}, static_cast<std::uint32_t>(f)});
  }
  nodes_.reserve(triangles_.size());
  if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(triangles_.size()));
}

void SurfaceIndex::build(std::uint32_t begin, std::uint32_t end) {
  Node node;
  node.low = node.high = triangles_[begin].corners[0];
  Point centre_low = node.low, centre_high = node.low;
  auto centre = [](const Triangle& t) { return (t.corners[0] + t.corners[1] + t.corners[2]) * (1.0 / 3); };
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const Point corner : triangles_[i].corners) {
      node.low = lowest(node.low, corner);
      node.high = highest(node.high, corner);
    }
    const Point c = centre(triangles_[i]);
    centre_low = i == begin ? c : lowest(centre_low, c);
    centre_high = i == begin ? c : highest(centre_high, c);
  }
  const std::size_t index = nodes_.size();
  if (end - begin <= kLeafTriangles) {
    node.first = begin;
    node.count = end - begin;
    nodes_.push_back(node);
    return;
  }
  nodes_.push_back(node);
  const Point size = centre_high - centre_low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  auto along = [&](const Triangle& t) {
    const Point c = centre(t);
    return axis == 0 ? c.x : (axis == 1 ? c.y : c.z);
  };
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(triangles_.begin() + begin, triangles_.begin() + middle, triangles_.begin() + end,
                   [&](const Triangle& a, const Triangle& b) { return along(a) < along(b); });
  build(begin, middle);
  nodes_[index].first = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end);
}

double SurfaceIndex::squared_distance_to_box(Point p, const Node& node) {
  const double x = std::max({node.low.x - p.x, 0.0, p.x - node.high.x});
  const double y = std::max({node.low.y - p.y, 0.0, p.y - node.high.y});
  const double z = std::max({node.low.z - p.z, 0.0, p.z - node.high.z});
  return x * x + y * y + z * z;
}

SurfaceIndex::Nearest SurfaceIndex::nearest(Point p) const {
  struct Open {
    std::uint32_t node;
    double squared_distance;
  };
  std::array<Open, 96> open;  // twice the depth of any tree of 2^32 halved faces
  std::size_t count = 0;
  Nearest best{std::numeric_limits<double>::infinity(), 0};
  open[count++] = {0, squared_distance_to_box(p, nodes_[0])};
  while (count > 0) {
    const Open top = open[--count];
    if (top.squared_distance > best.squared_distance) continue;
    const Node& node = nodes_[top.node];
    if (node.count == 0) {
      Open near{top.node + 1, squared_distance_to_box(p, nodes_[top.node + 1])};
      Open far{node.first, squared_distance_to_box(p, nodes_[node.first])};
      if (far.squared_distance < near.squared_distance) std::swap(near, far);
      if (far.squared_distance <= best.squared_distance) open[count++] = far;
      if (near.squared_distance <= best.squared_distance) open[count++] = near;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Triangle& t = triangles_[i];
      const double d = squared_distance_to_triangle(p, t.corners[0], t.corners[1], t.corners[2]);
      if (d < best.squared_distance || (d == best.squared_distance && t.face < best.face)) best = {d, t.face};
    }
  }
  return best;
}

std::vector<Point> area_uniform_samples(const testing::Mesh& mesh, std::size_t count, std::uint64_t seed) {
  std::vector<double> up_to(mesh.face_count());
  double total = 0;
  for (std::size_t f = 0; f < up_to.size(); ++f) {
    const Point area = area_vector(corners_of(mesh, f));
    up_to[f] = total += std::sqrt(dot(area, area));
  }
  std::vector<Point> samples;
  if (!(total > 0)) return samples;
  samples.reserve(count);
  Random random(seed);
  std::size_t face = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double at = (static_cast<double>(i) + random.unit()) / static_cast<double>(count) * total;
    while (face + 1 < up_to.size() && up_to[face] <= at) ++face;
    const auto t = corners_of(mesh, face);
    const double root = std::sqrt(random.unit()), v = random.unit();
    samples.push_back(t[0] * (1 - root) + t[1] * (root * (1 - v)) + t[2] * (root * v));
  }
  return samples;
}

SurfaceError measure_error(const testing::Mesh& a, const testing::Mesh& b, std::size_t samples, std::uint64_t seed) {
  SurfaceError error;
  double sum = 0, largest = 0;
  std::size_t count = 0;
  for (const auto& [from, to] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
    const SurfaceIndex index(*to);
    for (const Point p : area_uniform_samples(*from, samples, seed)) {
      const double squared = index.nearest(p).squared_distance;
      sum += squared;
      largest = std::max(largest, squared);
      ++count;
    }
    for (const std::uint32_t v : from->indices)
      largest = std::max(largest, index.nearest(as_point(from->positions[v])).squared_distance);
  }
  error.rms = count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0;
  error.hausdorff = std::sqrt(largest);
  return error;
}

void paint_parts(testing::Mesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.positions.size());
  for (std::uint32_t v = 0; v < parent.size(); ++v) parent[v] = v;
  auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::uint32_t a = root(mesh.indices[i]), b = root(mesh.indices[i / 3 * 3]);
    parent[std::max(a, b)] = std::min(a, b);
  }
  mesh.colours.resize(mesh.positions.size());
  for (std::uint32_t v = 0; v < parent.size(); ++v) mesh.colours[v].bits = root(v);
}

namespace {

// The faces of one colour, to look for neighbours in.
struct Part {
  testing::Mesh mesh;
  SurfaceIndex index;
  explicit Part(testing::Mesh part) : mesh(std::move(part)), index(mesh) {}
};

std::uint32_t colour_of(const testing::Mesh& mesh, std::size_t face) {
  return mesh.colours.empty() ? 0 : mesh.colours[mesh.indices[face * 3]].bits;
}

std::map<std::uint32_t, Part> parts_by_colour(const testing::Mesh& mesh) {
  std::map<std::uint32_t, testing::Mesh> meshes;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    testing::Mesh& part = meshes[colour_of(mesh, f)];
    for (std::size_t i = f * 3; i < f * 3 + 3; ++i) {
      part.indices.push_back(static_cast<std::uint32_t>(part.positions.size()));
      part.positions.push_back(mesh.positions[mesh.indices[i]]);
    }
  }
  std::map<std::uint32_t, Part> parts;
  for (auto& [colour, part] : meshes) parts.try_emplace(colour, std::move(part));
  return parts;
}

bool agrees_with(const Part& part, const std::array<Point, 3>& face, double tolerance) {
  const Point normal = area_vector(face), centroid = (face[0] + face[1] + face[2]) * (1.0 / 3);
  bool agrees = false;
  for (const Point p : {centroid, (centroid + face[0]) * 0.5, (centroid + face[1]) * 0.5, (centroid + face[2]) * 0.5}) {
    const double reach = std::sqrt(part.index.nearest(p).squared_distance) + tolerance;
    part.index.within(
        p, reach, [&](std::uint32_t f) { agrees = agrees || dot(area_vector(corners_of(part.mesh, f)), normal) > 0; });
  }
  return agrees;
}

}  // namespace

std::size_t count_flipped_faces(const testing::Mesh& original, const testing::Mesh& thinned, double tolerance) {
  const std::map<std::uint32_t, Part> parts = parts_by_colour(original);
  std::size_t flipped = 0;
  for (std::size_t f = 0; f < thinned.face_count(); ++f) {
    const auto face = corners_of(thinned, f);
    const Point normal = area_vector(face);
    if (dot(normal, normal) > 0 && !agrees_with(parts.at(colour_of(thinned, f)), face, tolerance)) ++flipped;
  }
  return flipped;
}

}  // namespace usuzumi::bench
