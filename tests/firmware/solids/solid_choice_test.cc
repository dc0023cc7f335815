#include "firmware/solids/solid_choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "firmware/scene/camera.h"

namespace usuzumi {
namespace {

using firmware::Member;
using firmware::Thresholds;
using firmware::View;
using firmware::format::Solid;
using firmware::format::SolidKind;

TEST(Thresholds, ChooseByTheComparisonsOfChapterFive) {
  const Thresholds t{32, 24, 16};
  EXPECT_EQ(firmware::member_of(33, t), Member::kHigh);
  EXPECT_EQ(firmware::member_of(32, t), Member::kMedium) << "not larger than";
  EXPECT_EQ(firmware::member_of(24.5f, t), Member::kMedium);
  EXPECT_EQ(firmware::member_of(24, t), Member::kLow);
  EXPECT_EQ(firmware::member_of(16, t), Member::kRough);
  EXPECT_EQ(firmware::member_of(0, t), Member::kRough);
  // The tables of 7.2 and 7.3: low alone, rough alone.
  EXPECT_EQ(firmware::member_of(1000, {1024, 1024, 0}), Member::kLow);
  EXPECT_EQ(firmware::member_of(1000, {2048, 2048, 2048}), Member::kRough);
}

TEST(Thresholds, MustFall) {
  EXPECT_TRUE(firmware::thresholds_fall({1, 0, 0}));
  EXPECT_TRUE(firmware::thresholds_fall({8, 8, 8}));
  EXPECT_FALSE(firmware::thresholds_fall({8, 9, 0}));
  EXPECT_FALSE(firmware::thresholds_fall({8, 4, 6})) << "T1 of table 3 as it is printed";
  EXPECT_FALSE(firmware::thresholds_fall({8, 4, -1}));
  EXPECT_FALSE(firmware::thresholds_fall({std::nanf(""), 4, 0}));
}

/// A picture 200 wide and 100 high, looked at from 10 in front; 90 degrees from top to bottom, so that a length of 1 at
/// the origin is 5 pixels.
View view_from(Vec3 eye, Vec3 target = {}) {
  firmware::Camera camera;
  camera.eye = eye;
  camera.target = target;
  camera.fov_y_rad = 1.57079633f;
  return {firmware::model_to_clip(camera, 2), 200, 100};
}

Solid cylinder_at(Vec3 place) {
  Solid solid;
  solid.kind = SolidKind::kCylinder;
  solid.size[0] = 2;  // diameter
  solid.size[1] = 8;  // height
  solid.to_model[3] = place.x;
  solid.to_model[7] = place.y;
  solid.to_model[11] = place.z;
  return solid;
}

TEST(SolidView, SizeIsTheLongestOfTheProjectedThree) {
  const auto seen = firmware::look_at(cylinder_at({}), view_from({0, 0, 10}), 0);
  EXPECT_FALSE(seen.clipped);
  EXPECT_FALSE(seen.at_the_eye);
  EXPECT_NEAR(seen.size_px, 4 * 5, 1e-3) << "half of its height";
  Solid wide = cylinder_at({});
  wide.to_model[0] = 3;
  EXPECT_NEAR(firmware::look_at(wide, view_from({0, 0, 10}), 0).size_px, 6 * 5, 1e-3) << "its diameter, stretched";
  EXPECT_NEAR(firmware::look_at(cylinder_at({}), view_from({0, 0, 20}), 0).size_px, 4 * 2.5, 1e-3) << "twice as far";
}

TEST(SolidView, WhatIsOutsideThePictureIsClippedUnlessTheMarginReachesIt) {
  // At the origin's distance the picture is 40 wide and 20 high.
  const View view = view_from({0, 0, 10});
  EXPECT_FALSE(firmware::look_at(cylinder_at({20.5f, 0, 0}), view, 0).clipped) << "its edge is in sight";
  EXPECT_TRUE(firmware::look_at(cylinder_at({24, 0, 0}), view, 0).clipped);
  EXPECT_FALSE(firmware::look_at(cylinder_at({24, 0, 0}), view, 0.2f).clipped);
  EXPECT_TRUE(firmware::look_at(cylinder_at({0, -16, 0}), view, 0).clipped);
  EXPECT_TRUE(firmware::look_at(cylinder_at({0, 0, 30}), view, 0).clipped) << "behind";
  EXPECT_TRUE(firmware::look_at(cylinder_at({0, 0, -500}), view, 0).clipped) << "beyond the far end";
  EXPECT_TRUE(firmware::look_at(cylinder_at({0, 0, 10}), view, 0).at_the_eye);
}

TEST(Eye, IsWhereTheCameraStands) {
  for (const Vec3 place : {Vec3{0, 0, 10}, Vec3{3, 4, -5}, Vec3{-7, 0.5f, 2}}) {
    const firmware::Eye eye = firmware::eye_of(view_from(place, {1, 0, 0}).model_to_clip);
    EXPECT_FALSE(eye.parallel);
    EXPECT_LT(length(eye.place - place), 1e-3f);
    EXPECT_LT(length(eye.from({1, 1, 1}) - (place - Vec3{1, 1, 1})), 1e-3f);
  }
}

TEST(Eye, OfAParallelProjectionIsADirection) {
  Mat4 m;  // x right, y up, depth rising along -z
  m.m[10] = -1;
  const firmware::Eye eye = firmware::eye_of(m);
  EXPECT_TRUE(eye.parallel);
  EXPECT_EQ(eye.from({5, 5, 5}), (Vec3{0, 0, 1}));
}

TEST(ViewCandidates, TheNearestIsTheOneMostInLine) {
  const firmware::SolidPlacement as_it_is = firmware::SolidPlacement::of(Solid{});
  const std::span<const Vec3> all = firmware::kDefaultCandidates;
  EXPECT_EQ(firmware::nearest_candidate({10, 1, 1}, as_it_is, all), 0u);
  EXPECT_EQ(firmware::nearest_candidate({0, 0, -3}, as_it_is, all), 5u);
  EXPECT_EQ(firmware::nearest_candidate({5, 5, 0}, as_it_is, all), 6u);
  EXPECT_EQ(firmware::nearest_candidate({1, 1, 1}, as_it_is, all), 6u) << "three are as near: the first";
  // A solid turned a quarter about y: the model's +x is its own +z.
  Solid turned;
  const float m[12] = {0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0};
  std::copy(std::begin(m), std::end(m), turned.to_model);
  EXPECT_EQ(firmware::nearest_candidate({4, 0, 0}, firmware::SolidPlacement::of(turned), all), 4u);
}

TEST(ViewCandidates, HaveUnitLengthAndSixAxesFirst) {
  EXPECT_EQ(std::size(firmware::kDefaultCandidates), 18u);
  for (const Vec3 c : firmware::kDefaultCandidates) EXPECT_NEAR(length(c), 1, 1e-6f);
  Vec3 sum;
  for (const Vec3 c : firmware::kDefaultCandidates) sum = sum + c;
  EXPECT_LT(length(sum), 1e-6f);
}

}  // namespace
}  // namespace usuzumi
