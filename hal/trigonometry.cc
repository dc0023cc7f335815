#include "hal/trigonometry.h"

#include <cstdint>

namespace usuzumi {
namespace {

/// Taylor series on [-pi/4, pi/4]. The first term left out is below (pi/4)^15 / 15! = 2e-14 and (pi/4)^16 / 16! =
/// 1e-15.
double sin_series(double x) {
  const double s = x * x;
  return x *
         (1 + s * (-1.0 / 6 + s * (1.0 / 120 +
                                   s * (-1.0 / 5040 + s * (1.0 / 362880 + s * (-1.0 / 39916800 + s / 6227020800.0))))));
}
double cos_series(double x) {
  const double s = x * x;
  return 1 + s * (-0.5 + s * (1.0 / 24 +
                              s * (-1.0 / 720 + s * (1.0 / 40320 + s * (-1.0 / 3628800 +
                                                                        s * (1.0 / 479001600 - s / 87178291200.0))))));
}

}  // namespace

SinCos sin_cos(double angle_rad) {
  constexpr double kLimit = 1048576;
  if (!(angle_rad >= -kLimit && angle_rad <= kLimit)) return {};
  const double quarters = angle_rad * (2 / kPi);
  const auto quadrant = static_cast<std::int64_t>(quarters + (quarters < 0 ? -0.5 : 0.5));
  // pi/2 in two parts, the first with 33 significant bits: their products with the quadrant (21 bits) are exact.
  constexpr double kHalfPiHigh = 1.57079632673412561417, kHalfPiLow = 6.07710050650619224932e-11;
  const auto q = static_cast<double>(quadrant);
  const double x = (angle_rad - q * kHalfPiHigh) - q * kHalfPiLow;
  const double s = sin_series(x), c = cos_series(x);
  switch (quadrant & 3) {
    case 0: return {s, c};
    case 1: return {c, -s};
    case 2: return {-s, -c};
    default: return {-c, s};
  }
}

}  // namespace usuzumi
