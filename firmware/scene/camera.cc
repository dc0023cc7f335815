#include "firmware/scene/camera.h"

#include <cmath>

#include "firmware/solids/solid_placement.h"
#include "hal/trigonometry.h"

namespace usuzumi::firmware {
namespace {

constexpr double kMargin = 1.04;  // air around the model

struct Direction {
  SinCos azimuth, elevation;
};

Direction direction_of(double azimuth_rad, double elevation_rad) {
  constexpr double kSteepest = 89 * kPi / 180;
  const double elevation =
      elevation_rad > kSteepest ? kSteepest : (elevation_rad < -kSteepest ? -kSteepest : elevation_rad);
  return {sin_cos(azimuth_rad), sin_cos(elevation)};
}

/// The least distance from its middle at which a box lies inside the view. A corner at right r, height u and depth z
/// towards the eye is inside from z + |r| / tan(half width of view) and z + |u| / tan(half height) on.
double distance_to_fit(Vec3 half, const Direction& d, double tangent_x, double tangent_y) {
  double distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const double x = (corner & 1) != 0 ? double{half.x} : -double{half.x},
                 y = (corner & 2) != 0 ? double{half.y} : -double{half.y},
                 z = (corner & 4) != 0 ? double{half.z} : -double{half.z};
    const double right = x * d.azimuth.cos - z * d.azimuth.sin, ahead = x * d.azimuth.sin + z * d.azimuth.cos;
    const double up = y * d.elevation.cos - ahead * d.elevation.sin,
                 depth = ahead * d.elevation.cos + y * d.elevation.sin;
    const double needed_x = depth + std::fabs(right) / tangent_x, needed_y = depth + std::fabs(up) / tangent_y;
    if (needed_x > distance) distance = needed_x;
    if (needed_y > distance) distance = needed_y;
  }
  return distance;
}

/// Distance for a picture of `aspect`, over `sides` directions from `azimuth_rad` on.
double fitting_distance(const Bounds& bounds, double azimuth_rad, double elevation_rad, float fov_y_rad, float aspect,
                        int sides) {
  const Vec3 half = (bounds.high - bounds.low) * 0.5f;
  const SinCos half_view = sin_cos(double{fov_y_rad} * 0.5);
  const double tangent_y = half_view.sin / half_view.cos;
  double distance = 0;
  for (int i = 0; i < sides; ++i) {
    const double d = distance_to_fit(half, direction_of(azimuth_rad + 2 * kPi * i / sides, elevation_rad),
                                     tangent_y * double{aspect}, tangent_y);
    if (d > distance) distance = d;
  }
  return kMargin * distance;
}

Camera stand_off(const Bounds& bounds, double azimuth_rad, double elevation_rad, double fit) {
  Camera camera;
  const Direction d = direction_of(azimuth_rad, elevation_rad);
  const double sphere = bounds.radius() > 0 ? double{bounds.radius()} : 1.0;
  const double distance = fit > 0 ? fit : 2 * sphere;  // a model of one place
  const Vec3 towards_eye{static_cast<float>(d.azimuth.sin * d.elevation.cos), static_cast<float>(d.elevation.sin),
                         static_cast<float>(d.azimuth.cos * d.elevation.cos)};
  camera.target = bounds.centre();
  camera.eye = camera.target + towards_eye * static_cast<float>(distance);
  const double near_distance = distance - sphere * 1.01, least_near = sphere * 0.01;
  camera.near_distance = static_cast<float>(near_distance > least_near ? near_distance : least_near);
  camera.far_distance = static_cast<float>(distance + sphere * 1.01);
  return camera;
}

}  // namespace

Status check(const Camera& camera) {
  const auto refuse = [](const char* message) { return Status{StatusCode::kInvalidArgument, message, 0}; };
  if (!is_finite(camera.eye) || !is_finite(camera.target) || !is_finite(camera.up))
    return refuse("camera: eye, target and up must be finite numbers");
  const Vec3 forward = camera.target - camera.eye;
  if (!(length(forward) > 0)) return refuse("camera: eye and target are the same place");
  if (!(length(cross(normalized(forward), normalized(camera.up, {}))) > 1e-4f))
    return refuse("camera: up points along the line of sight");
  if (!(camera.fov_y_rad > 0.001f && camera.fov_y_rad < 3.1f))
    return refuse("camera: the field of view must lie between 0 and 180 degrees");
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
  const auto add = [&](Vec3 p) {
    if (first) b = {p, p};
    first = false;
    b.low = {p.x < b.low.x ? p.x : b.low.x, p.y < b.low.y ? p.y : b.low.y, p.z < b.low.z ? p.z : b.low.z};
    b.high = {p.x > b.high.x ? p.x : b.high.x, p.y > b.high.y ? p.y : b.high.y, p.z > b.high.z ? p.z : b.high.z};
  };
  data.for_each_mesh([&](const MeshView& mesh) {
    for (const Vec3 p : mesh.positions) add(p);
  });
  for (const format::Solid& solid : data.solids().solids)
    for (const Vec3 corner : corners_of(solid).of) add(corner);
  return b;
}

Camera view_of(const Bounds& bounds, double azimuth_rad, double elevation_rad, float aspect) {
  return stand_off(bounds, azimuth_rad, elevation_rad,
                   fitting_distance(bounds, azimuth_rad, elevation_rad, Camera{}.fov_y_rad, aspect, 1));
}

Camera orbit(const Bounds& bounds, double azimuth_rad, double elevation_rad, float aspect) {
  constexpr int kSides = 64;  // from a fixed first one, so that the distance is the same all the way round
  return stand_off(bounds, azimuth_rad, elevation_rad,
                   fitting_distance(bounds, 0, elevation_rad, Camera{}.fov_y_rad, aspect, kSides));
}

}  // namespace usuzumi::firmware
