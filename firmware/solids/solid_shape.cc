#include "firmware/solids/solid_shape.h"

#include "hal/trigonometry.h"

namespace usuzumi::firmware {
namespace {

using format::SolidKind;

/// On the unit circle around the y axis, from +z towards +x: counter-clockwise as seen from above.
struct Spoke {
  float x = 0, z = 1;
};

Spoke spoke(std::uint32_t i, std::uint32_t around) {
  const SinCos turn = sin_cos(2 * kPi * i / around);
  return {static_cast<float>(turn.sin), static_cast<float>(turn.cos)};
}

/// Halfway to the next spoke.
Spoke between_spokes(std::uint32_t i, std::uint32_t around) {
  const SinCos turn = sin_cos(2 * kPi * (i + 0.5) / around);
  return {static_cast<float>(turn.sin), static_cast<float>(turn.cos)};
}

/// Numbers the vertices while it tells them.
class Walk {
 public:
  explicit Walk(ShapeSink& sink) : sink_(sink) {}

  std::uint32_t vertex(Vec3 place, Vec3 normal) {
    sink_.vertex(place, normal);
    return count_++;
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const std::uint32_t corners[] = {a, b, c};
    sink_.face(corners, 3);
  }
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    const std::uint32_t corners[] = {a, b, c, d};
    sink_.face(corners, 4);
  }
  /// A face with vertices and a normal of its own.
  void flat(const Vec3* places, std::uint32_t count) {
    const Vec3 normal = normalized(cross(places[1] - places[0], places[2] - places[0]));
    const std::uint32_t first = count_;
    std::uint32_t corners[format::kMaxAround];
    for (std::uint32_t i = 0; i < count; ++i) {
      vertex(places[i], normal);
      corners[i] = first + i;
    }
    sink_.face(corners, count);
  }

 private:
  ShapeSink& sink_;
  std::uint32_t count_ = 0;
};

/// Rows of a ball of radius `r` from its top pole down; row `rows_in_half_turn` would be the bottom pole. `down` is how
/// much lower the ball's middle is than the origin. The last ring is number `rings`.
void tell_dome(Walk& walk, float r, float down, ShapeDetail d, std::uint32_t rows_in_half_turn, std::uint32_t rings) {
  const std::uint32_t pole = walk.vertex({0, r - down, 0}, {0, 1, 0});
  const std::uint32_t first = pole + 1;
  for (std::uint32_t j = 1; j <= rings; ++j) {
    const SinCos fall = sin_cos(kPi * j / rows_in_half_turn);
    const auto ring = static_cast<float>(fall.sin), height = static_cast<float>(fall.cos);
    for (std::uint32_t i = 0; i < d.around; ++i) {
      const Spoke s = spoke(i, d.around);
      const Vec3 normal{ring * s.x, height, ring * s.z};
      walk.vertex(normal * r - Vec3{0, down, 0}, normal);
    }
  }
  const auto at = [&](std::uint32_t ring, std::uint32_t i) { return first + (ring - 1) * d.around + i % d.around; };
  for (std::uint32_t i = 0; i < d.around; ++i) {
    walk.triangle(at(1, i), at(1, i + 1), pole);
    for (std::uint32_t j = 1; j < rings; ++j) walk.quad(at(j + 1, i), at(j + 1, i + 1), at(j, i + 1), at(j, i));
  }
}

void tell_sphere(Walk& walk, float diameter, ShapeDetail d) {
  const float r = diameter * 0.5f;
  tell_dome(walk, r, 0, d, d.rows, d.rows - 1);
  const std::uint32_t last_ring = 1 + (d.rows - 2) * d.around, pole = walk.vertex({0, -r, 0}, {0, -1, 0});
  for (std::uint32_t i = 0; i < d.around; ++i)
    walk.triangle(pole, last_ring + (i + 1) % d.around, last_ring + i);
}

void tell_hemisphere(Walk& walk, float diameter, ShapeDetail d) {
  const float r = diameter * 0.5f, down = r * 0.5f;
  tell_dome(walk, r, down, d, 2 * d.rows, d.rows);
  const std::uint32_t middle = walk.vertex({0, -down, 0}, {0, -1, 0});
  for (std::uint32_t i = 0; i < d.around; ++i) {
    const Spoke s = spoke(i, d.around);
    walk.vertex({r * s.x, -down, r * s.z}, {0, -1, 0});
  }
  for (std::uint32_t i = 0; i < d.around; ++i)
    walk.triangle(middle, middle + 1 + (i + 1) % d.around, middle + 1 + i);
}

/// Cone (`top` 0), cylinder and frustum cone, by their radii.
void tell_round(Walk& walk, float bottom, float top, float height, std::uint32_t around) {
  const float half = height * 0.5f;
  const auto normal_at = [&](Spoke s) {
    return normalized({s.x * height, bottom - top, s.z * height});
  };
  for (std::uint32_t i = 0; i < around; ++i) {
    const Spoke s = spoke(i, around);
    walk.vertex({bottom * s.x, -half, bottom * s.z}, normal_at(s));
  }
  for (std::uint32_t i = 0; i < around; ++i) {  // at a cone's tip each face has a normal of its own
    const Spoke s = top > 0 ? spoke(i, around) : between_spokes(i, around);
    walk.vertex({top * s.x, half, top * s.z}, normal_at(s));
  }
  for (std::uint32_t i = 0; i < around; ++i) {
    const std::uint32_t next = (i + 1) % around;
    if (top > 0) walk.quad(i, next, around + next, around + i);
    else walk.triangle(i, next, around + i);
  }
  Vec3 rim[format::kMaxAround];
  for (std::uint32_t i = 0; i < around; ++i) {
    const Spoke s = spoke(around - 1 - i, around);
    rim[i] = {bottom * s.x, -half, bottom * s.z};
  }
  walk.flat(rim, around);
  if (!(top > 0)) return;
  for (std::uint32_t i = 0; i < around; ++i) {
    const Spoke s = spoke(i, around);
    rim[i] = {top * s.x, half, top * s.z};
  }
  walk.flat(rim, around);
}

/// Half the extents of a trapezoid's bottom and top, and of its height.
struct Trapezoid {
  float bottom_x, bottom_z, top_x, top_z, y;
};

Trapezoid trapezoid_of(SolidKind kind, const float* size) {
  switch (kind) {
    case SolidKind::kCube: return {size[0] * 0.5f, size[0] * 0.5f, size[0] * 0.5f, size[0] * 0.5f, size[0] * 0.5f};
    case SolidKind::kCuboid: return {size[0] * 0.5f, size[2] * 0.5f, size[0] * 0.5f, size[2] * 0.5f, size[1] * 0.5f};
    case SolidKind::kSquarePyramid: return {size[0] * 0.5f, size[0] * 0.5f, 0, 0, size[1] * 0.5f};
    default: return {size[0] * 0.5f, size[1] * 0.5f, size[2] * 0.5f, size[3] * 0.5f, size[4] * 0.5f};
  }
}

/// The bottom's corners and, from 4 on, the top's; each counter-clockwise as seen from above, from the front left.
void trapezoid_corners(const Trapezoid& t, Vec3 corners[8]) {
  constexpr float kX[] = {-1, 1, 1, -1}, kZ[] = {1, 1, -1, -1};
  for (std::uint32_t i = 0; i < 4; ++i) {
    corners[i] = {kX[i] * t.bottom_x, -t.y, kZ[i] * t.bottom_z};
    corners[4 + i] = {kX[i] * t.top_x, t.y, kZ[i] * t.top_z};
  }
}

/// The square pyramid too, whose top is a point.
void tell_trapezoid(Walk& walk, const Trapezoid& t) {
  Vec3 c[8];
  trapezoid_corners(t, c);
  for (std::uint32_t i = 0; i < 4; ++i) {
    const Vec3 side[] = {c[i], c[(i + 1) % 4], c[4 + (i + 1) % 4], c[4 + i]};
    walk.flat(side, t.top_x > 0 ? 4 : 3);
  }
  const Vec3 bottom[] = {c[3], c[2], c[1], c[0]};
  walk.flat(bottom, 4);
  if (t.top_x > 0) walk.flat(c + 4, 4);
}

/// The bottom's corners, then the tip, which is over the middle of the bottom.
void triangular_pyramid_corners(const float* size, Vec3 corners[4]) {
  const float x = size[0] * 0.5f, z = size[1] * 0.5f, y = size[2] * 0.5f;
  corners[0] = {-x, -y, z};
  corners[1] = {x, -y, z};
  corners[2] = {0, -y, -z};
  corners[3] = {0, y, z * (1.0f / 3)};
}

void tell_triangular_pyramid(Walk& walk, const float* size) {
  Vec3 c[4];
  triangular_pyramid_corners(size, c);
  for (std::uint32_t i = 0; i < 3; ++i) {
    const Vec3 side[] = {c[i], c[(i + 1) % 3], c[3]};
    walk.flat(side, 3);
  }
  const Vec3 bottom[] = {c[2], c[1], c[0]};
  walk.flat(bottom, 3);
}

/// Looking along the y axis: a circle of radius `r` for what is round.
std::uint32_t tell_circle(float r, std::uint32_t around, Vec3* places) {
  for (std::uint32_t i = 0; i < around; ++i) {
    const Spoke s = spoke(i, around);
    places[i] = {r * s.x, 0, r * s.z};
  }
  return around;
}

/// In the plane across a horizontal axis: width runs to the right of who looks from `to_viewer`, y up.
std::uint32_t upright(float bottom, float top, float half_height, bool top_is_point, Vec3 right, Vec3* places) {
  const Vec3 up{0, half_height, 0};
  places[0] = right * -bottom - up;
  places[1] = right * bottom - up;
  if (top_is_point) {
    places[2] = up;
    return 3;
  }
  places[2] = right * top + up;
  places[3] = right * -top + up;
  return 4;
}

Vec3 right_of_side(std::uint32_t side) {
  constexpr Vec3 kRight[kSectionCount] = {{0, 0, -1}, {0, 0, 1}, {}, {}, {1, 0, 0}, {-1, 0, 0}};
  return kRight[side];
}

/// As from +y.
std::uint32_t section_from_above(SolidKind kind, const float* size, std::uint32_t around, Vec3* places) {
  switch (kind) {
    case SolidKind::kSphere:
    case SolidKind::kHemisphere:
    case SolidKind::kCone:
    case SolidKind::kCylinder: return tell_circle(size[0] * 0.5f, around, places);
    case SolidKind::kFrustumCone:
      return tell_circle((size[0] > size[1] ? size[0] : size[1]) * 0.5f, around, places);
    case SolidKind::kTriangularPyramid: {
      Vec3 c[4];
      triangular_pyramid_corners(size, c);
      for (std::uint32_t i = 0; i < 3; ++i) places[i] = {c[i].x, 0, c[i].z};
      return 3;
    }
    default: break;
  }
  const Vec3 half = half_extent(kind, size);
  places[0] = {-half.x, 0, half.z};
  places[1] = {half.x, 0, half.z};
  places[2] = {half.x, 0, -half.z};
  places[3] = {-half.x, 0, -half.z};
  return 4;
}

std::uint32_t section_from_the_side(SolidKind kind, const float* size, std::uint32_t around, std::uint32_t side,
                                    Vec3* places) {
  const Vec3 right = right_of_side(side);
  const bool along_x = side >= 4;  // width is along x where one looks along z
  switch (kind) {
    case SolidKind::kSphere:
      for (std::uint32_t i = 0; i < around; ++i) {
        const Spoke s = spoke(i, around);
        places[i] = right * (size[0] * 0.5f * s.x) - Vec3{0, size[0] * 0.5f * s.z, 0};
      }
      return around;
    case SolidKind::kHemisphere: {  // half a circle, in as many corners
      const float r = size[0] * 0.5f;
      for (std::uint32_t i = 0; i < around; ++i) {
        const SinCos turn = sin_cos(kPi * i / (around - 1));
        places[i] = right * (r * static_cast<float>(turn.cos)) +
                    Vec3{0, r * static_cast<float>(turn.sin) - r * 0.5f, 0};
      }
      return around;
    }
    case SolidKind::kCone: return upright(size[0] * 0.5f, 0, size[1] * 0.5f, true, right, places);
    case SolidKind::kCylinder:
      return upright(size[0] * 0.5f, size[0] * 0.5f, size[1] * 0.5f, false, right, places);
    case SolidKind::kFrustumCone:
      return upright(size[0] * 0.5f, size[1] * 0.5f, size[2] * 0.5f, false, right, places);
    case SolidKind::kTriangularPyramid: {
      Vec3 c[4];
      triangular_pyramid_corners(size, c);
      if (along_x) return upright(size[0] * 0.5f, 0, size[2] * 0.5f, true, right, places);
      const Vec3 from = side == 0 ? c[0] : c[2], to = side == 0 ? c[2] : c[0];
      places[0] = {0, from.y, from.z};
      places[1] = {0, to.y, to.z};
      places[2] = c[3];
      return 3;
    }
    default: break;
  }
  const Trapezoid t = trapezoid_of(kind, size);
  const bool point = kind == SolidKind::kSquarePyramid;
  return along_x ? upright(t.bottom_x, t.top_x, t.y, point, right, places)
                 : upright(t.bottom_z, t.top_z, t.y, point, right, places);
}

float larger(float a, float b) { return a > b ? a : b; }

}  // namespace

ShapeDetail detail_of(SolidKind kind, std::uint32_t member, const format::SolidDetail& detail) {
  switch (kind) {
    case SolidKind::kSphere: return {detail.sphere_around[member], detail.sphere_rows[member]};
    case SolidKind::kHemisphere: return {detail.hemisphere_around[member], detail.hemisphere_rows[member]};
    case SolidKind::kCone:
    case SolidKind::kCylinder:
    case SolidKind::kFrustumCone: return {detail.round_sides[member], 0};
    default: return {};
  }
}

void tell_shape(SolidKind kind, const float* size, ShapeDetail detail, ShapeSink& sink) {
  Walk walk(sink);
  switch (kind) {
    case SolidKind::kSphere: return tell_sphere(walk, size[0], detail);
    case SolidKind::kHemisphere: return tell_hemisphere(walk, size[0], detail);
    case SolidKind::kCone: return tell_round(walk, size[0] * 0.5f, 0, size[1], detail.around);
    case SolidKind::kCylinder: return tell_round(walk, size[0] * 0.5f, size[0] * 0.5f, size[1], detail.around);
    case SolidKind::kFrustumCone: return tell_round(walk, size[0] * 0.5f, size[1] * 0.5f, size[2], detail.around);
    case SolidKind::kTriangularPyramid: return tell_triangular_pyramid(walk, size);
    case SolidKind::kCube:
    case SolidKind::kCuboid:
    case SolidKind::kSquarePyramid:
    case SolidKind::kTrapezoid: return tell_trapezoid(walk, trapezoid_of(kind, size));
  }
}

std::uint32_t tell_section(SolidKind kind, const float* size, std::uint32_t around, std::uint32_t side, Vec3* places) {
  if (side != 2 && side != 3) return section_from_the_side(kind, size, around, side, places);
  const std::uint32_t count = section_from_above(kind, size, around, places);
  if (side == 3)
    for (std::uint32_t i = 0; i < count / 2; ++i) {
      const Vec3 kept = places[i];
      places[i] = places[count - 1 - i];
      places[count - 1 - i] = kept;
    }
  return count;
}

Vec3 identifying_size(SolidKind kind, const float* size) {
  switch (kind) {
    case SolidKind::kSphere:
    case SolidKind::kHemisphere:
    case SolidKind::kCube: return {size[0], size[0], size[0]};
    case SolidKind::kCone:
    case SolidKind::kCylinder:
    case SolidKind::kSquarePyramid: return {size[0], size[1] * 0.5f, size[0]};
    case SolidKind::kFrustumCone: {
      const float wider = larger(size[0], size[1]);
      return {wider, size[2] * 0.5f, wider};
    }
    case SolidKind::kCuboid: return {size[0], size[1] * 0.5f, size[2]};
    case SolidKind::kTriangularPyramid: return {size[0], size[2] * 0.5f, size[1]};
    case SolidKind::kTrapezoid: return {larger(size[0], size[2]), size[4] * 0.5f, larger(size[1], size[3])};
  }
  return {};
}

Vec3 half_extent(SolidKind kind, const float* size) {
  switch (kind) {
    case SolidKind::kSphere:
    case SolidKind::kCube: return Vec3{1, 1, 1} * (size[0] * 0.5f);
    case SolidKind::kHemisphere: return {size[0] * 0.5f, size[0] * 0.25f, size[0] * 0.5f};
    case SolidKind::kCone:
    case SolidKind::kCylinder:
    case SolidKind::kSquarePyramid: return {size[0] * 0.5f, size[1] * 0.5f, size[0] * 0.5f};
    case SolidKind::kFrustumCone: {
      const float wider = larger(size[0], size[1]) * 0.5f;
      return {wider, size[2] * 0.5f, wider};
    }
    case SolidKind::kCuboid: return {size[0] * 0.5f, size[1] * 0.5f, size[2] * 0.5f};
    case SolidKind::kTriangularPyramid: return {size[0] * 0.5f, size[2] * 0.5f, size[1] * 0.5f};
    case SolidKind::kTrapezoid:
      return {larger(size[0], size[2]) * 0.5f, size[4] * 0.5f, larger(size[1], size[3]) * 0.5f};
  }
  return {};
}

}  // namespace usuzumi::firmware
