// Transforms for scenes. Sine and cosine are our own, so that a scene's vertices, and with them the goldens, are the
// same on every C library.
#pragma once

#include "hal/vec.h"

namespace usuzumi::scenes {

inline constexpr double kPi = 3.14159265358979323846;

/// Error below 1e-9 for |angle| < 100.
double sine(double angle_rad);
double cosine(double angle_rad);

Mat4 translation(float x, float y, float z);
Mat4 scaling(float x, float y, float z);
Mat4 rotation_x(double angle_rad);
Mat4 rotation_y(double angle_rad);
Mat4 rotation_z(double angle_rad);

/// OpenGL's: the eye at the origin looks along -z.
Mat4 perspective(double vertical_angle_rad, double aspect, double near_distance, double far_distance);

/// Model space in pixels: x right, y down from the target's top left corner, z the depth in [0, 1].
Mat4 pixels_to_clip(std::uint32_t width, std::uint32_t height);

}  // namespace usuzumi::scenes
