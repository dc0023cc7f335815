#include "gfx_subsystem/engine_soft/clip.h"

#include <algorithm>

namespace usuzumi::gfx::soft {
namespace {

enum Plane { kNear, kFar, kGuardLeft, kGuardRight, kGuardBottom, kGuardTop, kPlanes };

/// Not negative inside.
float distance(const DrawSetup& d, int plane, const Vec4& p) {
  switch (plane) {
    case kNear: return p.z + p.w;
    case kFar: return p.w - p.z;
    case kGuardLeft: return d.guard[0] * p.w + p.x;
    case kGuardRight: return d.guard[0] * p.w - p.x;
    case kGuardBottom: return d.guard[1] * p.w + p.y;
    default: return d.guard[1] * p.w - p.y;
  }
}

ClipVertex cut(const ClipVertex& inside, float inside_distance, const ClipVertex& outside, float outside_distance) {
  const float t = inside_distance / (inside_distance - outside_distance);
  const auto mix = [t](float a, float b) { return a + (b - a) * t; };
  const Vec4 &a = inside.position, &b = outside.position;
  ClipVertex v{{mix(a.x, b.x), mix(a.y, b.y), mix(a.z, b.z), mix(a.w, b.w)}, {}, {}};
  for (int k = 0; k < 3; ++k) v.colour[k] = mix(inside.colour[k], outside.colour[k]);
  v.extra = {mix(inside.extra.s, outside.extra.s), mix(inside.extra.t, outside.extra.t),
             mix(inside.extra.alpha, outside.extra.alpha)};
  return v;
}

/// False where w is too small to divide by, which only a corner at the eye itself is.
bool project(const DrawSetup& d, const ClipVertex& v, PlacedVertex& placed) {
  const Vec4& p = v.position;
  if (!(p.w >= kMinClipW)) return false;
  Vertex& out = placed.vertex;
  placed.extra = {v.extra.s, v.extra.t, std::clamp(v.extra.alpha, 0.0f, d.lane_limit[1])};
  const float u = 1.0f / p.w;
  const auto window = [&](int axis, float c) { return (c * u) * d.scale[axis] + d.offset[axis]; };
  const auto channel = [&](int k) { return std::clamp(v.colour[k], 0.0f, d.lane_limit[k]); };
  out.red = channel(0);
  out.green = channel(1);
  out.blue = channel(2);
  out.depth = std::clamp(window(2, p.z), 0.0f, 1.0f) * d.depth_limit;
  out.x = round_to_int(window(0, p.x));
  out.y = round_to_int(window(1, p.y));
  out.u = u;
  out.outcode = 0;
  return true;
}

}  // namespace

ClippedPolygon clip_triangle(const DrawSetup& d, const ClipVertex (&corner)[3]) {
  ClipVertex buffer[2][kMaxClippedCorners + 1];
  std::copy(corner, corner + 3, buffer[0]);
  int count = 3, from = 0;
  for (int plane = 0; plane < kPlanes && count > 0; ++plane) {
    const ClipVertex* in = buffer[from];
    ClipVertex* out = buffer[1 - from];
    int kept = 0;
    for (int i = 0; i < count; ++i) {
      // A convex polygon crosses a plane twice. One so thin that rounding makes it cross more often has no area to
      // lose.
      if (kept + 2 > kMaxClippedCorners + 1) return {};
      const ClipVertex &a = in[i], &b = in[i + 1 < count ? i + 1 : 0];
      const float da = distance(d, plane, a.position), db = distance(d, plane, b.position);
      if (da >= 0) out[kept++] = a;
      if (da >= 0 && db < 0) out[kept++] = cut(a, da, b, db);
      if (da < 0 && db >= 0) out[kept++] = cut(b, db, a, da);
    }
    count = kept;
    from = 1 - from;
  }
  if (count > kMaxClippedCorners) return {};
  ClippedPolygon polygon;
  for (int i = 0; i < count; ++i)
    if (!project(d, buffer[from][i], polygon.corner[i])) return {};
  polygon.corners = count >= 3 ? count : 0;
  return polygon;
}

bool clip_segment(const DrawSetup& d, const ClipVertex (&end)[2], PlacedVertex (&out)[2]) {
  ClipVertex a = end[0], b = end[1];
  for (int plane = 0; plane < kPlanes; ++plane) {
    const float da = distance(d, plane, a.position), db = distance(d, plane, b.position);
    if (da < 0 && db < 0) return false;
    if (da < 0) a = cut(b, db, a, da);
    else if (db < 0) b = cut(a, da, b, db);
  }
  return project(d, a, out[0]) && project(d, b, out[1]);
}

}  // namespace usuzumi::gfx::soft
