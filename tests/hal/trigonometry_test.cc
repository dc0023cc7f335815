#include "hal/trigonometry.h"

#include <gtest/gtest.h>

#include <cmath>

namespace usuzumi {
namespace {

TEST(SinCosTest, AgreesWithTheCLibrary) {
  for (int i = -200'000; i <= 200'000; ++i) {
    const double a = i * 0.000731;
    ASSERT_NEAR(sin_cos(a).sin, std::sin(a), 1e-11) << a;
    ASSERT_NEAR(sin_cos(a).cos, std::cos(a), 1e-11) << a;
  }
  for (double a : {1e5, -1e6, 1048575.5}) ASSERT_NEAR(sin_cos(a).sin, std::sin(a), 1e-11) << a;
}

TEST(SinCosTest, TakesWhatHasNoAngleAsZero) {
  for (double a : {2e6, -1e30, HUGE_VAL, std::nan("")}) {
    EXPECT_EQ(sin_cos(a).sin, 0);
    EXPECT_EQ(sin_cos(a).cos, 1);
  }
}

}  // namespace
}  // namespace usuzumi
