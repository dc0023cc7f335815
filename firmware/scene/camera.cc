#include "firmware/scene/camera.h"

#include <cmath>

#include "firmware/scene/trigonometry.h"

namespace usuzumi::firmware {

Status check(const Camera& camera) {
  const auto refuse = [](const char* message) { return Status{StatusCode::kInvalidArgument, message, 0}; };
  if (!is_finite(camera.eye) || !is_finite(camera.target) || !is_finite(camera.up)) return refuse("camera: eye, target and up must be finite numbers");
  const Vec3 forward = camera.target - camera.eye;
  if (!(length(forward) > 0)) return refuse("camera: eye and target are the same place");
  if (!(length(cross(normalized(forward), normalized(camera.up, {}))) > 1e-4f)) return refuse("camera: up points along the line of sight");
  if (!(camera.fov_y_rad > 0.001f && camera.fov_y_rad < 3.1f)) return refuse("camera: the field of view must lie between 0 and 180 degrees");
  if (!(camera.near_distance > 0 && camera.far_distance > camera.near_distance && std::isfinite(camera.far_distance)))
    return refuse("camera: near and far must be 0 < near < far");
  return ok_status();
}

Mat4 model_to_clip(const Camera& camera, float aspect) {
  const Vec3 back = normalized(camera.eye - camera.target);
  const Vec3 right = normalized(cross(camera.up, back));
  const Vec3 up = cross(back, right);
  const Mat4 view{{right.x, right.y, right.z, -dot(right, camera.eye), up.x, up.y, up.z, -dot(up, camera.eye),
                   back.x, back.y, back.z, -dot(back, camera.eye), 0, 0, 0, 1}};
  const SinCos half = sin_cos(double{camera.fov_y_rad} * 0.5);
  const auto f = static_cast<float>(half.cos / half.sin);
  const float n = camera.near_distance, d = camera.far_distance;
  const Mat4 projection{{f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (d + n) / (n - d), 2 * d * n / (n - d), 0, 0, -1, 0}};
  return projection * view;
}

Bounds bounds_of(const DrawingData& data) {
  Bounds b;
  bool first = true;
  std::uint32_t record = data.first_record();
  for (std::uint32_t n = 0; n < data.mesh_max(); ++n, record = data.next_record(record)) {
    for (const Vec3& p : data.mesh_at(n, record).positions) {
      if (first) b = {p, p};
      first = false;
      b.low = {p.x < b.low.x ? p.x : b.low.x, p.y < b.low.y ? p.y : b.low.y, p.z < b.low.z ? p.z : b.low.z};
      b.high = {p.x > b.high.x ? p.x : b.high.x, p.y > b.high.y ? p.y : b.high.y, p.z > b.high.z ? p.z : b.high.z};
    }
  }
  return b;
}

Camera orbit(const Bounds& bounds, double azimuth_rad, double elevation_rad, float aspect) {
  constexpr double kSteepest = 89 * kPi / 180;
  const double elevation = elevation_rad > kSteepest ? kSteepest : (elevation_rad < -kSteepest ? -kSteepest : elevation_rad);
  Camera camera;
  const float radius = bounds.radius() > 0 ? bounds.radius() : 1.0f;
  // A sphere of radius r fits a cone of half angle a from r / sin(a); across a narrow picture the cone is narrower.
  const SinCos half = sin_cos(double{camera.fov_y_rad} * 0.5);
  const double tangent = half.sin / half.cos * (aspect < 1 ? double{aspect} : 1.0);
  const double distance = double{radius} * std::sqrt(1 + tangent * tangent) / tangent;
  const SinCos around = sin_cos(azimuth_rad), above = sin_cos(elevation);
  const Vec3 direction{static_cast<float>(around.sin * above.cos), static_cast<float>(above.sin), static_cast<float>(around.cos * above.cos)};
  camera.target = bounds.centre();
  camera.eye = camera.target + direction * static_cast<float>(distance);
  camera.near_distance = static_cast<float>(distance) - radius * 1.01f;
  const float least_near = radius * 0.01f;
  if (camera.near_distance < least_near) camera.near_distance = least_near;
  camera.far_distance = static_cast<float>(distance) + radius * 1.01f;
  return camera;
}

}  // namespace usuzumi::firmware
