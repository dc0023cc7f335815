#include "firmware/thinning/screen_area.h"

#include <cstddef>

namespace usuzumi::firmware {
namespace {

/// A triangle clipped by six planes has at most nine corners.
constexpr std::size_t kMaxCorners = 9;

struct Polygon {
  Vec4 corner[kMaxCorners];
  std::size_t count = 0;
};

/// Signed distance to the k-th plane of the view volume, inside where >= 0: w + x, w - x, w + y, w - y, w + z, w - z.
float plane_distance(const Vec4& v, int k) {
  switch (k) {
    case 0: return v.w + v.x;
    case 1: return v.w - v.x;
    case 2: return v.w + v.y;
    case 3: return v.w - v.y;
    case 4: return v.w + v.z;
    default: return v.w - v.z;
  }
}

Vec4 between(const Vec4& a, const Vec4& b, float t) {
  return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t, a.w + (b.w - a.w) * t};
}

/// Sutherland & Hodgman, one plane.
void clip_by_plane(Polygon& polygon, int plane) {
  Polygon inside;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vec4& a = polygon.corner[i];
    const Vec4& b = polygon.corner[(i + 1) % polygon.count];
    const float da = plane_distance(a, plane), db = plane_distance(b, plane);
    if (da >= 0) inside.corner[inside.count++] = a;
    if ((da >= 0) != (db >= 0) && inside.count < kMaxCorners)
      inside.corner[inside.count++] = between(a, b, da / (da - db));
    if (inside.count == kMaxCorners) break;
  }
  polygon = inside;
}

unsigned outcode(const Vec4& v) {
  unsigned code = 0;
  for (int k = 0; k < 6; ++k) code |= plane_distance(v, k) >= 0 ? 0u : 1u << k;  // NaN counts as outside
  return code;
}

/// Twice the signed area in normalised device coordinates, counter-clockwise positive.
double doubled_area(const Polygon& polygon) {
  double sum = 0;
  double previous_x = 0, previous_y = 0;
  for (std::size_t i = 0; i <= polygon.count; ++i) {
    const Vec4& c = polygon.corner[i % polygon.count];
    const double x = double{c.x} / double{c.w}, y = double{c.y} / double{c.w};
    if (i > 0) sum += previous_x * y - x * previous_y;
    previous_x = x;
    previous_y = y;
  }
  return sum;
}

double face_doubled_area(const MeshView& mesh, std::uint32_t f, const Mat4& model_to_clip) {
  std::uint32_t v[3];
  mesh.face(f, v);
  Polygon polygon;
  polygon.count = 3;
  unsigned any = 0, all = ~0u;
  for (std::size_t k = 0; k < 3; ++k) {
    polygon.corner[k] = transform_point(model_to_clip, mesh.positions[v[k]]);
    const unsigned code = outcode(polygon.corner[k]);
    any |= code;
    all &= code;
  }
  if (all != 0) return 0;
  for (int plane = 0; plane < 6 && polygon.count > 0; ++plane)
    if ((any & 1u << plane) != 0) clip_by_plane(polygon, plane);
  // A polygon that touches the eye (w = 0) has no area that a panel could show.
  for (std::size_t i = 0; i < polygon.count; ++i)
    if (!(polygon.corner[i].w > 0)) return 0;
  return polygon.count < 3 ? 0 : doubled_area(polygon);
}

}  // namespace

float screen_area_px(const MeshView& mesh, const View& view, float stop_above, std::uint64_t& faces_measured) {
  // A normalised square of side 2 is the whole picture; doubled areas are halved.
  const double pixels = double(view.width) * double(view.height) / 8.0;
  double front = 0, back = 0;
  const std::uint32_t faces = mesh.face_count();
  for (std::uint32_t f = 0; f < faces; ++f) {
    const double area = face_doubled_area(mesh, f, view.model_to_clip) * pixels;
    ++faces_measured;
    if (area > 0) front += area; else back -= area;
    if (front > double{stop_above}) break;
  }
  return static_cast<float>(mesh.two_sided() && back > front ? back : front);
}

}  // namespace usuzumi::firmware
