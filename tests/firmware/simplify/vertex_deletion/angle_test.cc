#include "firmware/simplify/vertex_deletion/angle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace usuzumi::testing {
namespace {

using firmware::angle_between;
using firmware::angle_rad;

TEST(Angle, IsWithinItsBoundOfTheLibrarys) {
  double most = 0;
  for (int i = 0; i <= 400000; ++i) {
    const double angle = 3.141592653589793 * i / 400000;
    for (const double radius : {1.0, 3e-9, 7e12}) {
      const auto x = static_cast<float>(radius * std::cos(angle)), y = static_cast<float>(radius * std::sin(angle));
      const double expected = std::atan2(static_cast<double>(y), static_cast<double>(x));
      most = std::max(most, std::abs(static_cast<double>(angle_rad(x, std::max(y, 0.0f))) - expected));
    }
  }
  EXPECT_LT(most, 3e-6);
}

TEST(Angle, OfTheOriginAndOfAxesIsDefined) {
  EXPECT_EQ(angle_rad(0, 0), 0.0f);
  EXPECT_EQ(angle_rad(5, 0), 0.0f);
  EXPECT_FLOAT_EQ(angle_rad(0, 2), 1.57079633f);
  EXPECT_FLOAT_EQ(angle_rad(-3, 0), 3.14159265f);
}

TEST(Angle, BetweenVectorsDoesNotDependOnTheirLengths) {
  EXPECT_NEAR(angle_between({2, 0, 0}, {0, 0, 7}), 1.5707963f, 3e-6f);
  EXPECT_NEAR(angle_between({1, 1, 0}, {0, 3, 0}), 0.7853982f, 3e-6f);
  EXPECT_NEAR(angle_between({1, 0, 0}, {-1, 1e-4f, 0}), 3.1415927f - 1e-4f, 3e-6f);
  EXPECT_EQ(angle_between({0, 0, 0}, {1, 2, 3}), 0.0f);
}

}  // namespace
}  // namespace usuzumi::testing
