// What tests ask a desk to draw: the whole model from a fixed height, on a background no model has.
#pragma once

#include "firmware/scene/camera.h"
#include "sim/desk/desk.h"

namespace usuzumi::testing {

inline constexpr double kElevationRad = 0.4;
inline constexpr Rgba8 kRequestBackground = rgba8(10, 20, 30);

inline firmware::FrameRequest request_for(const sim::Desk& desk, double azimuth_rad = 0.3) {
  firmware::FrameRequest request;
  const float aspect = static_cast<float>(desk.width()) / static_cast<float>(desk.height());
  const auto bounds = firmware::bounds_of(desk.drawing_data());
  request.model_to_clip = model_to_clip(firmware::view_of(bounds, azimuth_rad, kElevationRad, aspect), aspect);
  request.lighting.background = kRequestBackground;
  return request;
}

}  // namespace usuzumi::testing
