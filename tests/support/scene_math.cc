#include "tests/support/scene_math.h"

#include <cmath>

namespace usuzumi::scenes {

double sine(double angle_rad) {
  // To [-pi, pi], then to [-pi/2, pi/2] by symmetry, then Taylor's series to x^15: its error there is below 6e-12.
  double x = angle_rad - 2 * kPi * std::floor(angle_rad / (2 * kPi) + 0.5);
  if (x > kPi / 2) x = kPi - x;
  if (x < -kPi / 2) x = -kPi - x;
  double term = x, sum = x;
  for (int n = 2; n <= 14; n += 2) {
    term = -term * x * x / (n * (n + 1));
    sum += term;
  }
  return sum;
}

double cosine(double angle_rad) { return sine(angle_rad + kPi / 2); }

Mat4 translation(float x, float y, float z) { return {{1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1}}; }

Mat4 scaling(float x, float y, float z) { return {{x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 0, 0, 0, 1}}; }

Mat4 rotation_x(double angle_rad) {
  const auto s = static_cast<float>(sine(angle_rad)), c = static_cast<float>(cosine(angle_rad));
  return {{1, 0, 0, 0, 0, c, -s, 0, 0, s, c, 0, 0, 0, 0, 1}};
}

Mat4 rotation_y(double angle_rad) {
  const auto s = static_cast<float>(sine(angle_rad)), c = static_cast<float>(cosine(angle_rad));
  return {{c, 0, s, 0, 0, 1, 0, 0, -s, 0, c, 0, 0, 0, 0, 1}};
}

Mat4 rotation_z(double angle_rad) {
  const auto s = static_cast<float>(sine(angle_rad)), c = static_cast<float>(cosine(angle_rad));
  return {{c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
}

Mat4 perspective(double vertical_angle_rad, double aspect, double near_distance, double far_distance) {
  const double f = cosine(vertical_angle_rad / 2) / sine(vertical_angle_rad / 2);
  const double depth = near_distance - far_distance;
  Mat4 m;
  m.m[0] = static_cast<float>(f / aspect);
  m.m[5] = static_cast<float>(f);
  m.m[10] = static_cast<float>((far_distance + near_distance) / depth);
  m.m[11] = static_cast<float>(2 * far_distance * near_distance / depth);
  m.m[14] = -1;
  m.m[15] = 0;
  return m;
}

Mat4 pixels_to_clip(std::uint32_t width, std::uint32_t height) {
  return {{2.0f / static_cast<float>(width), 0, 0, -1, 0, -2.0f / static_cast<float>(height), 0, 1, 0, 0, 2, -1, 0, 0,
           0, 1}};
}

}  // namespace usuzumi::scenes
