// Sine and cosine that give the same bits on every processor: library trigonometry differs between C libraries.
#pragma once

namespace usuzumi {

inline constexpr double kPi = 3.14159265358979323846;

struct SinCos {
  double sin = 0, cos = 1;
};

/// For |angle_rad| <= 2^20; absolute error below 1e-11 (tested against the C library). Beyond, the angle is taken as 0.
SinCos sin_cos(double angle_rad);

}  // namespace usuzumi
