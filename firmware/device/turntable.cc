#include "firmware/device/turntable.h"

#include "hal/trigonometry.h"

namespace usuzumi::firmware {
namespace {

constexpr double kAzimuth = 30 * kPi / 180, kElevation = 20 * kPi / 180;

}  // namespace

Camera turntable_camera(const Bounds& bounds, std::uint32_t frame, std::uint32_t frames, float aspect) {
  if (frames == 0) return view_of(bounds, kAzimuth, kElevation, aspect);
  return orbit(bounds, kAzimuth + 2 * kPi * frame / frames, kElevation, aspect);
}

FrameRequest lit_request(const Camera& camera, float aspect, Rgba8 background) {
  FrameRequest request;
  request.model_to_clip = model_to_clip(camera, aspect);
  const Vec3 back = normalized(camera.eye - camera.target);
  const Vec3 right = normalized(cross(camera.up, back));
  const Vec3 up = cross(back, right);
  request.lighting.to_light = normalized(back + right * 0.4f + up * 0.6f);
  request.lighting.background = background;
  return request;
}

}  // namespace usuzumi::firmware
