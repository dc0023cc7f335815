// How far a thinned surface lies from the original: exact point-triangle distances from area-uniform samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/support/mesh_shapes.h"

namespace usuzumi::bench {

struct Point {
  double x = 0, y = 0, z = 0;
};

/// Squared distance from `p` to the nearest point of the triangle; a degenerate one counts as the segment or point it
/// is.
double squared_distance_to_triangle(Point p, Point a, Point b, Point c);

/// Nearest faces of a mesh by a tree of boxes.
class SurfaceIndex {
 public:
  explicit SurfaceIndex(const testing::Mesh& mesh);

  struct Nearest {
    double squared_distance = 0;
    std::uint32_t face = 0;  // the lowest of the nearest
  };
  /// The mesh has at least one face.
  Nearest nearest(Point p) const;
  /// Calls visit(face) for every face within `distance` of `p`.
  template <class Visit>
  void within(Point p, double distance, Visit visit) const;

  std::size_t face_count() const { return triangles_.size(); }

 private:
  struct Triangle {
    Point corners[3];
    std::uint32_t face = 0;
  };
  struct Node {
    Point low, high;
    std::uint32_t first = 0;  // a leaf's first triangle, or an inner node's second child (the first follows it)
    std::uint32_t count = 0;  // triangles of a leaf; 0 for an inner node
  };
  static double squared_distance_to_box(Point p, const Node& node);
  void build(std::uint32_t begin, std::uint32_t end);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

template <class Visit>
void SurfaceIndex::within(Point p, double distance, Visit visit) const {
  std::vector<std::uint32_t> open = {0};
  while (!open.empty()) {
    const std::uint32_t index = open.back();
    open.pop_back();
    const Node& node = nodes_[index];
    if (squared_distance_to_box(p, node) > distance * distance) continue;
    if (node.count == 0) {
      open.push_back(node.first);
      open.push_back(index + 1);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Triangle& t = triangles_[i];
      if (squared_distance_to_triangle(p, t.corners[0], t.corners[1], t.corners[2]) <= distance * distance)
        visit(t.face);
    }
  }
}

/// `count` points spread evenly over the surface's area (one at random in each of `count` equal shares), fixed by
/// `seed`.
std::vector<Point> area_uniform_samples(const testing::Mesh& mesh, std::size_t count, std::uint64_t seed);

struct SurfaceError {
  double rms = 0;        // over the samples of both surfaces together
  double hausdorff = 0;  // largest distance, both ways, over samples and vertices
};
/// Distances from `samples` points on each surface to the other.
SurfaceError measure_error(const testing::Mesh& a, const testing::Mesh& b, std::size_t samples = 200000,
                           std::uint64_t seed = 1);

/// Gives every part its own colour; a part is what shared vertices hold together. Thinning carries colours along, and
/// joins no parts, so that the colour still tells which part a thinned face is of.
void paint_parts(testing::Mesh& mesh);

/// Faces of `thinned` that look the wrong way: at its centroid and at three points half-way from there to its corners,
/// every face of `original` that is no further than the nearest plus `tolerance` has a normal more than 90 degrees from
/// its own. Only faces of the same colour are looked at: a shaft says nothing about the bore that it turns in. Faces
/// without area are not counted.
std::size_t count_flipped_faces(const testing::Mesh& original, const testing::Mesh& thinned, double tolerance);

}  // namespace usuzumi::bench
