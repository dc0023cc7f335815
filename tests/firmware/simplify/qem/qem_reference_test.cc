// Against a plain implementation of Garland & Heckbert's method: double precision, absolute 4x4 quadrics, every cost
// worked out anew before every collapse, no queue, no shared code. The two may choose differently among nearly equal
// costs, so their errors are compared, not their faces.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "tests/bench/simplify/error_meter.h"
#include "tests/firmware/simplify/simplify_fixture.h"

namespace usuzumi::testing {
namespace {

using bench::Point;

struct PlainQuadric {
  double m[4][4] = {};
  void add_plane(Point n, double d, double weight) {
    const double p[4] = {n.x, n.y, n.z, d};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) m[i][j] += weight * p[i] * p[j];
  }
  void add(const PlainQuadric& q) {
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) m[i][j] += q.m[i][j];
  }
  double at(Point x) const {
    const double p[4] = {x.x, x.y, x.z, 1};
    double sum = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) sum += p[i] * m[i][j] * p[j];
    return sum;
  }
  // Cramer's rule; false where the matrix is near singular.
  bool minimum(Point& x) const {
    auto det = [](const double a[3][3]) {
      return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
             a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
    };
    double a[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) a[i][j] = m[i][j];
    const double d = det(a), trace = a[0][0] + a[1][1] + a[2][2];
    if (!(d > 1e-4 * trace * trace * trace)) return false;
    double result[3];
    for (int k = 0; k < 3; ++k) {
      double b[3][3];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) b[i][j] = j == k ? -m[i][3] : a[i][j];
      result[k] = det(b) / d;
    }
    x = {result[0], result[1], result[2]};
    return true;
  }
};

// Only for closed manifolds.
class PlainSimplifier {
 public:
  explicit PlainSimplifier(const Mesh& mesh) {
    for (const Vec3 p : mesh.positions) positions_.push_back({p.x, p.y, p.z});
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
      faces_.push_back({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
    quadrics_.resize(positions_.size());
    for (const Face& f : faces_) {
      const Point n = normal(f);
      const double area = std::sqrt(dot(n, n));
      const Point unit = {n.x / area, n.y / area, n.z / area};
      for (const std::uint32_t v : f) quadrics_[v].add_plane(unit, -dot(unit, positions_[f[0]]), area);
    }
  }

  Mesh run(std::size_t target) {
    while (faces_.size() > target) {
      double least = std::numeric_limits<double>::infinity();
      std::uint32_t from = 0, to = 0;
      Point place;
      for (const Face& f : faces_) {
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t a = f[k], b = f[(k + 1) % 3];
          if (a > b) continue;
          Point x;
          const double cost = best_place(a, b, x);
          if (cost >= least || !allowed(a, b, x)) continue;
          least = cost;
          from = b;
          to = a;
          place = x;
        }
      }
      if (from == to) break;
      positions_[to] = place;
      quadrics_[to].add(quadrics_[from]);
      std::erase_if(faces_, [&](const Face& f) { return has(f, from) && has(f, to); });
      for (Face& f : faces_) std::replace(f.begin(), f.end(), from, to);
    }
    Mesh result;
    for (const Point p : positions_)
      result.positions.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    for (const Face& f : faces_) result.indices.insert(result.indices.end(), f.begin(), f.end());
    return result;
  }

 private:
  using Face = std::array<std::uint32_t, 3>;
  static double dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  static bool has(const Face& f, std::uint32_t v) { return f[0] == v || f[1] == v || f[2] == v; }
  Point normal(const Face& f) const { return normal_of(positions_[f[0]], positions_[f[1]], positions_[f[2]]); }
  static Point normal_of(Point a, Point b, Point c) {
    const Point u = {b.x - a.x, b.y - a.y, b.z - a.z}, v = {c.x - a.x, c.y - a.y, c.z - a.z};
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  }

  double best_place(std::uint32_t a, std::uint32_t b, Point& x) const {
    PlainQuadric q = quadrics_[a];
    q.add(quadrics_[b]);
    if (q.minimum(x)) return q.at(x);
    const Point pa = positions_[a], pb = positions_[b];
    double least = std::numeric_limits<double>::infinity();
    for (const Point p : {Point{(pa.x + pb.x) / 2, (pa.y + pb.y) / 2, (pa.z + pb.z) / 2}, pa, pb}) {
      if (q.at(p) >= least) continue;
      least = q.at(p);
      x = p;
    }
    return least;
  }

  bool allowed(std::uint32_t a, std::uint32_t b, Point x) const {
    std::set<std::uint32_t> near_a, near_b, both;
    for (const Face& f : faces_) {
      for (const std::uint32_t v : f) {
        if (has(f, a) && v != a) near_a.insert(v);
        if (has(f, b) && v != b) near_b.insert(v);
      }
      if (has(f, a) == has(f, b)) continue;
      Point p[3];
      for (std::size_t k = 0; k < 3; ++k) p[k] = f[k] == a || f[k] == b ? x : positions_[f[k]];
      if (dot(normal(f), normal_of(p[0], p[1], p[2])) <= 0) return false;
    }
    std::set_intersection(near_a.begin(), near_a.end(), near_b.begin(), near_b.end(), std::inserter(both, both.end()));
    return both.size() == 2 && faces_.size() > 4;
  }

  std::vector<Point> positions_;
  std::vector<Face> faces_;
  std::vector<PlainQuadric> quadrics_;
};

// An egg with a dent: no two costs alike, curved and nearly flat places.
Mesh dented_egg() {
  Mesh mesh = icosphere(3);
  for (Vec3& p : mesh.positions) {
    const float dent = std::max(0.0f, p.z - 0.6f);
    p = {p.x * 1.4f + 0.05f * p.y * p.y, p.y + 0.07f * p.x * p.z, p.z - 1.2f * dent};
  }
  return mesh;
}

TEST(QemReference, ErrorIsThatOfThePlainMethodOrBetter) {
  for (const Mesh& mesh : {dented_egg(), icosphere(3), cube(6)}) {
    for (const std::uint32_t target : {600u, 200u, 60u}) {
      const Mesh plain = PlainSimplifier(mesh).run(target);
      const Mesh ours = thin(mesh, target).mesh;
      EXPECT_EQ(ours.face_count(), plain.face_count());
      const bench::SurfaceError e = bench::measure_error(mesh, ours, 20000),
                                e0 = bench::measure_error(mesh, plain, 20000);
      EXPECT_LE(e.rms, e0.rms * 1.05 + 1e-3) << mesh.face_count() << " to " << target;
      EXPECT_LE(e.hausdorff, e0.hausdorff * 1.3 + 5e-3) << mesh.face_count() << " to " << target;
    }
  }
}

}  // namespace
}  // namespace usuzumi::testing
