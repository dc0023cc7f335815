#include "tests/bench/simplify/texture_meter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/bench/simplify/error_meter.h"

namespace usuzumi::bench {
namespace {

using testing::Mesh;
using Weights = std::array<double, 3>;

Point minus(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

struct Corners {
  Point p[3];
  double s[3], t[3];
};

Corners corners_of(const Mesh& mesh, std::size_t face) {
  Corners c;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t v = mesh.indices[face * 3 + k];
    c.p[k] = {mesh.positions[v].x, mesh.positions[v].y, mesh.positions[v].z};
    c.s[k] = mesh.texture_coordinates[v].s;
    c.t[k] = mesh.texture_coordinates[v].t;
  }
  return c;
}

// Of the point of segment (a, b) nearest to `p`: how far along, 0 to 1.
double along_segment(Point p, Point a, Point b) {
  const Point edge = minus(b, a);
  const double squared = dot(edge, edge);
  return squared > 0 ? std::clamp(dot(minus(p, a), edge) / squared, 0.0, 1.0) : 0;
}

// Barycentric weights of the triangle's point nearest to `p`: within, or on the nearest side.
Weights nearest_weights(Point p, const Point (&t)[3]) {
  const Point u = minus(t[1], t[0]), v = minus(t[2], t[0]), w = minus(p, t[0]);
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
  const double det = uu * vv - uv * uv;
  if (det > 0) {
    const double b = (vv * wu - uv * wv) / det, c = (uu * wv - uv * wu) / det;
    if (b >= 0 && c >= 0 && b + c <= 1) return {1 - b - c, b, c};
  }
  Weights best{};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const double x = along_segment(p, t[k], t[next]);
    const Point edge = minus(t[next], t[k]), from = minus(p, t[k]);
    const Point off = {from.x - edge.x * x, from.y - edge.y * x, from.z - edge.z * x};
    if (dot(off, off) >= least) continue;
    least = dot(off, off);
    best = {};
    best[k] = 1 - x;
    best[next] = x;
  }
  return best;
}

}  // namespace

TextureDrift measure_texture_drift(const Mesh& original, const Mesh& thinned, double tolerance, double limit,
                                   std::size_t samples, std::uint64_t seed) {
  // The samples are spread over a face by its area alone, so each tells its face: ask which of `thinned` it lies on.
  const SurfaceIndex index(original), own(thinned);
  TextureDrift drift;
  double sum = 0;
  std::size_t count = 0, beyond = 0;
  for (const Point p : area_uniform_samples(thinned, samples, seed)) {
    const Corners here = corners_of(thinned, own.nearest(p).face);
    const Weights w = nearest_weights(p, here.p);
    const double s = w[0] * here.s[0] + w[1] * here.s[1] + w[2] * here.s[2];
    const double t = w[0] * here.t[0] + w[1] * here.t[1] + w[2] * here.t[2];
    const double reach = std::sqrt(index.nearest(p).squared_distance) + tolerance;
    double least = std::numeric_limits<double>::infinity();
    index.within(p, reach * (1 + 1e-9) + 1e-12, [&](std::uint32_t face) {
      const Corners there = corners_of(original, face);
      const Weights x = nearest_weights(p, there.p);
      const double ds = s - (x[0] * there.s[0] + x[1] * there.s[1] + x[2] * there.s[2]);
      const double dt = t - (x[0] * there.t[0] + x[1] * there.t[1] + x[2] * there.t[2]);
      least = std::min(least, ds * ds + dt * dt);
    });
    sum += least;
    drift.largest = std::max(drift.largest, std::sqrt(least));
    beyond += std::sqrt(least) > limit ? 1u : 0u;
    ++count;
  }
  if (count == 0) return drift;
  drift.rms = std::sqrt(sum / static_cast<double>(count));
  drift.beyond = static_cast<double>(beyond) / static_cast<double>(count);
  return drift;
}

}  // namespace usuzumi::bench
