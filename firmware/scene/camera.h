// The camera: where the viewer stands, and the matrix the 3D engine is given.
#pragma once

#include "firmware/drawing_data/drawing_data.h"
#include "hal/status.h"
#include "hal/vec.h"

namespace usuzumi::firmware {

/// Right-handed; looks from eye to target. Angles in radians, lengths in model units.
struct Camera {
  Vec3 eye{0, 0, 3};
  Vec3 target{};
  Vec3 up{0, 1, 0};
  float fov_y_rad = 0.6981317f;  // 40 degrees from the picture's lower to its upper edge
  float near_distance = 0.1f;
  float far_distance = 100;
};

/// kInvalidArgument when the camera cannot see: eye on target, up along the view, a field of view outside (0, pi), or
/// near and far not 0 < near < far.
Status check(const Camera& camera);

/// Model space to OpenGL clip space (hal/command_list.h). `aspect`: width / height. Only for a checked camera.
Mat4 model_to_clip(const Camera& camera, float aspect);

/// Axis-aligned box around every vertex of the drawing data, and around the boxes of its solids.
struct Bounds {
  Vec3 low, high;
  Vec3 centre() const { return (low + high) * 0.5f; }
  float radius() const { return length(high - low) * 0.5f; }
};
Bounds bounds_of(const DrawingData& data);

/// Looks at the middle of `bounds` from `azimuth_rad` around the y axis, from +z towards +x, and `elevation_rad` above
/// the horizon (kept within 89 degrees), from where the box just fits the picture.
Camera view_of(const Bounds& bounds, double azimuth_rad, double elevation_rad, float aspect);

/// The same, from the distance at which the box fits from every side, for a turn around it.
Camera orbit(const Bounds& bounds, double azimuth_rad, double elevation_rad, float aspect);

}  // namespace usuzumi::firmware
