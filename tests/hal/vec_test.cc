#include "hal/vec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace usuzumi {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(Vec3, CrossProductFollowsTheRightHand) {
  EXPECT_EQ(cross({1, 0, 0}, {0, 1, 0}), (Vec3{0, 0, 1}));
  EXPECT_EQ(cross({0, 1, 0}, {0, 0, 1}), (Vec3{1, 0, 0}));
  EXPECT_EQ(dot({1, 2, 3}, {4, -5, 6}), 12.0f);
  EXPECT_EQ(length({2, 3, 6}), 7.0f);
}

TEST(Vec3, NormalizedFallsBackWhereThereIsNoDirection) {
  EXPECT_EQ(normalized({0, 3, 0}), (Vec3{0, 1, 0}));
  EXPECT_EQ(normalized({0, 0, 0}, {1, 0, 0}), (Vec3{1, 0, 0}));
  EXPECT_EQ(normalized({kNan, 0, 0}, {1, 0, 0}), (Vec3{1, 0, 0}));
}

TEST(Vec3, FiniteMeansEveryComponent) {
  EXPECT_TRUE(is_finite(Vec3{1, 2, 3}));
  EXPECT_FALSE(is_finite(Vec3{1, kNan, 3}));
  EXPECT_FALSE(is_finite(Vec3{1, 2, -kInfinity}));
}

TEST(Mat4, TransformsByRowsAndComposesFromTheRight) {
  Mat4 move;  // by (10, 20, 30)
  move.m[3] = 10, move.m[7] = 20, move.m[11] = 30;
  Mat4 scale;  // by 2
  scale.m[0] = scale.m[5] = scale.m[10] = 2;
  const Vec4 p = transform_point(move * scale, {1, 2, 3});  // scaled first, then moved
  EXPECT_EQ(p.x, 12.0f);
  EXPECT_EQ(p.y, 24.0f);
  EXPECT_EQ(p.z, 36.0f);
  EXPECT_EQ(p.w, 1.0f);
}

TEST(Mat4, ProductWithAnyMatrixKeepsTheOrderOfRowAndColumn) {
  Mat4 a, b;
  for (int i = 0; i < 16; ++i) a.m[i] = static_cast<float>(i), b.m[i] = static_cast<float>(2 * i + 1);
  const Mat4 r = a * b;
  EXPECT_EQ(r.m[1], 0.0f * 3 + 1 * 11 + 2 * 19 + 3 * 27);       // row 0, column 1
  EXPECT_EQ(r.m[14], 12.0f * 5 + 13 * 13 + 14 * 21 + 15 * 29);  // row 3, column 2
}

TEST(Rgba8, KeepsRedInTheLowestByte) {
  const Rgba8 c = rgba8(0x11, 0x22, 0x33, 0x44);
  EXPECT_EQ(c.bits, 0x44332211u);
  EXPECT_EQ(c.r(), 0x11u);
  EXPECT_EQ(c.g(), 0x22u);
  EXPECT_EQ(c.b(), 0x33u);
  EXPECT_EQ(c.a(), 0x44u);
  EXPECT_EQ(rgba8(1, 2, 3).a(), 255u);
}

TEST(PackedNormal, HoldsTheAxesExactly) {
  EXPECT_EQ(pack_normal({0, 0, 1}).bits, 511u << 20);
  EXPECT_EQ(pack_normal({-1, 0, 0}).bits, 0x201u);  // -511 in ten bits of two's complement
  EXPECT_EQ(unpack(pack_normal({0, -1, 0})), (Vec3{0, -1, 0}));
}

TEST(PackedNormal, ReadsMinus512AsMinusOne) { EXPECT_EQ(unpack(PackedNormal{0x200u}), (Vec3{-1, 0, 0})); }

TEST(PackedNormal, ClampsAndTakesNanAsZero) {
  EXPECT_EQ(unpack(pack_normal({7, -7, kNan})), (Vec3{1, -1, 0}));
  EXPECT_EQ(unpack(pack_normal({kInfinity, -kInfinity, 0})), (Vec3{1, -1, 0}));
}

TEST(PackedNormal, StaysWithinATenthOfADegree) {
  std::mt19937 random(2);
  std::normal_distribution<float> bell;
  double worst_degrees = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 n = normalized({bell(random), bell(random), bell(random)});
    const Vec3 u = normalized(unpack(pack_normal(n)));
    worst_degrees = std::max(
        worst_degrees, std::asin(std::min(1.0, static_cast<double>(length(cross(n, u))))) * 180 / 3.14159265358979);
  }
  EXPECT_LT(worst_degrees, 0.1);
  EXPECT_GT(worst_degrees, 0.05) << "half a step of 1/511 in each component is about 0.1 degrees";
}

}  // namespace
}  // namespace usuzumi
