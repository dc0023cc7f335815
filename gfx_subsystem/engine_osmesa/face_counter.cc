#include "gfx_subsystem/engine_osmesa/face_counter.h"

#include <array>
#include <cmath>
#include <cstring>

namespace usuzumi::gfx {
namespace {

using namespace command;

struct ClipVertex {
  double x = 0, y = 0, z = 0, w = 0;
};

// A triangle cut by six planes has at most nine corners.
struct Polygon {
  std::array<ClipVertex, 9> corners;
  std::size_t count = 0;
  void add(const ClipVertex& v) { corners[count++] = v; }
};

// Signed distances to the planes of -w <= x, y, z <= w; inside where not negative.
double plane_distance(const ClipVertex& v, int plane) {
  switch (plane) {
    case 0: return v.w + v.z;
    case 1: return v.w - v.z;
    case 2: return v.w + v.x;
    case 3: return v.w - v.x;
    case 4: return v.w + v.y;
    default: return v.w - v.y;
  }
}

Polygon clip_to_plane(const Polygon& in, int plane) {
  Polygon out;
  for (std::size_t i = 0; i < in.count; ++i) {
    const ClipVertex &a = in.corners[i], &b = in.corners[(i + 1) % in.count];
    const double da = plane_distance(a, plane), db = plane_distance(b, plane);
    if (da >= 0) out.add(a);
    if ((da >= 0) != (db >= 0)) {
      const double t = da / (da - db);
      out.add({a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t, a.w + (b.w - a.w) * t});
    }
  }
  return out;
}

// Twice the area on the panel, positive where the corners run counter-clockwise as seen there (y runs down).
double signed_area(const Polygon& polygon, const SetViewport& viewport) {
  constexpr double kSubpixels = 256;
  std::array<double, 9> x{}, y{};
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const ClipVertex& v = polygon.corners[i];
    x[i] = std::floor(v.x / v.w * double{viewport.width} / 2 * kSubpixels + 0.5);
    y[i] = std::floor(-v.y / v.w * double{viewport.height} / 2 * kSubpixels + 0.5);
  }
  double doubled = 0;
  for (std::size_t i = 1; i + 1 < polygon.count; ++i)
    doubled += (x[i] - x[0]) * (y[i + 1] - y[0]) - (x[i + 1] - x[0]) * (y[i] - y[0]);
  return -doubled;
}

class FaceTest {
 public:
  explicit FaceTest(const EngineState& state) : state_(state) {}

  bool drawn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    Polygon polygon;
    for (std::uint32_t v : {a, b, c}) polygon.add(transform(v));
    for (int plane = 0; plane < 6 && polygon.count > 0; ++plane) polygon = clip_to_plane(polygon, plane);
    if (polygon.count < 3) return false;
    const double area = signed_area(polygon, state_.viewport);
    if (!(area > 0 || area < 0)) return false;
    const bool front = (area > 0) == (state_.raster.front_face == FrontFace::kCounterClockwise);
    return state_.raster.cull == CullMode::kNone || front == (state_.raster.cull == CullMode::kBack);
  }

 private:
  ClipVertex transform(std::uint32_t vertex) const {
    Vec3 p;
    std::memcpy(&p, state_.positions.data() + std::size_t{vertex} * state_.streams.position_stride, sizeof p);
    const auto& m = state_.transform.model_to_clip.m;
    const auto row = [&](int r) {
      return double{m[4 * r]} * double{p.x} + double{m[4 * r + 1]} * double{p.y} + double{m[4 * r + 2]} * double{p.z} +
             double{m[4 * r + 3]};
    };
    return {row(0), row(1), row(2), row(3)};
  }

  const EngineState& state_;
};

}  // namespace

std::uint64_t count_faces_drawn(const EngineState& state, const DrawCall& call) {
  const std::uint32_t faces = face_count(call.draw.topology, call.draw.count);
  const FaceTest test(state);
  std::uint64_t drawn = 0;
  for (std::uint32_t i = 0; i < faces; ++i) {
    bool counts = false;
    switch (call.draw.topology) {
      case Topology::kTriangles:
        counts = test.drawn(call.vertex(3 * i), call.vertex(3 * i + 1), call.vertex(3 * i + 2));
        break;
      case Topology::kTriangleStrip:  // every second triangle with its first two corners exchanged
        counts = test.drawn(call.vertex(i + i % 2), call.vertex(i + 1 - i % 2), call.vertex(i + 2));
        break;
      case Topology::kTriangleFan: counts = test.drawn(call.vertex(0), call.vertex(i + 1), call.vertex(i + 2)); break;
      case Topology::kPoints:
      case Topology::kLines: break;
    }
    drawn += counts ? 1 : 0;
  }
  return drawn;
}

}  // namespace usuzumi::gfx
