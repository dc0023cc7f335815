#include "firmware/scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hal/trigonometry.h"
#include "tests/support/rom_builder.h"

namespace usuzumi {
namespace {

using firmware::Bounds;
using firmware::Camera;

Vec3 projected(const Mat4& m, Vec3 p) {
  const Vec4 c = transform_point(m, p);
  return {c.x / c.w, c.y / c.w, c.z / c.w};
}

TEST(CameraTest, MapsNearFarAndEdgesOfTheViewToTheClipCube) {
  Camera camera;
  camera.eye = {1, 2, 10};
  camera.target = {1, 2, 0};
  camera.fov_y_rad = static_cast<float>(kPi / 2);  // half height = distance
  camera.near_distance = 1;
  camera.far_distance = 9;
  const Mat4 m = model_to_clip(camera, 2);
  EXPECT_NEAR(projected(m, {1, 2, 9}).z, -1, 1e-5);
  EXPECT_NEAR(projected(m, {1, 2, 1}).z, 1, 1e-5);
  EXPECT_NEAR(projected(m, {1, 2 + 5, 5}).y, 1, 1e-5) << "up is up, at distance 5 half a height of 5";
  EXPECT_NEAR(projected(m, {1 + 10, 2, 5}).x, 1, 1e-5) << "twice as wide as high";
}

TEST(CameraTest, OrbitKeepsTheWholeBoxInThePicture) {
  const Bounds bounds{{-3, -1, 2}, {5, 7, 4}};
  for (float aspect : {0.5f, 1.0f, 2.667f}) {
    for (int step = 0; step < 12; ++step) {
      const Camera camera = orbit(bounds, step * kPi / 6, 0.4, aspect);
      ASSERT_TRUE(check(camera).ok());
      const Mat4 m = model_to_clip(camera, aspect);
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p{corner & 1 ? bounds.high.x : bounds.low.x, corner & 2 ? bounds.high.y : bounds.low.y,
                     corner & 4 ? bounds.high.z : bounds.low.z};
        const Vec3 c = projected(m, p);
        for (float v : {c.x, c.y, c.z}) EXPECT_LE(std::abs(v), 1.0001f) << aspect << " " << step << " " << corner;
      }
    }
  }
}

TEST(CameraTest, ViewOfFillsThePictureWithALongModel) {
  // A rod along x seen from the front: its ends lie 4 % inside the picture's edges.
  const Bounds rod{{-10, -0.1f, -0.1f}, {10, 0.1f, 0.1f}};
  const Mat4 m = model_to_clip(view_of(rod, 0, 0, 2), 2);
  EXPECT_NEAR(projected(m, {10, 0, 0}).x, 1 / 1.04, 0.01);
  EXPECT_NEAR(projected(m, {-10, 0, 0}).x, -1 / 1.04, 0.01);
}

TEST(CameraTest, OrbitKeepsItsDistance) {
  const Bounds bounds{{-3, -1, 2}, {5, 7, 4}};
  const float first = length(orbit(bounds, 0, 0.4, 2).eye - bounds.centre());
  for (int step = 1; step < 12; ++step)
    EXPECT_NEAR(length(orbit(bounds, step * 0.37, 0.4, 2).eye - bounds.centre()), first, 1e-4);
  EXPECT_GE(first, length(view_of(bounds, 0.37, 0.4, 2).eye - bounds.centre()));
}

TEST(CameraTest, OrbitOfASinglePlaceStillSees) {
  const Camera camera = orbit(Bounds{{1, 2, 3}, {1, 2, 3}}, 1, 0.3, 1.5f);
  EXPECT_TRUE(check(camera).ok());
}

TEST(CameraTest, RefusesWhatCannotSee) {
  const auto refused = [](auto change) {
    Camera camera;
    change(camera);
    return !check(camera).ok();
  };
  EXPECT_TRUE(check(Camera{}).ok());
  EXPECT_TRUE(refused([](Camera& c) { c.target = c.eye; }));
  EXPECT_TRUE(refused([](Camera& c) { c.up = {0, 0, 1}; }));
  EXPECT_TRUE(refused([](Camera& c) { c.fov_y_rad = 0; }));
  EXPECT_TRUE(refused([](Camera& c) { c.fov_y_rad = std::nanf(""); }));
  EXPECT_TRUE(refused([](Camera& c) { c.near_distance = 0; }));
  EXPECT_TRUE(refused([](Camera& c) { c.far_distance = c.near_distance; }));
  EXPECT_TRUE(refused([](Camera& c) { c.eye.x = HUGE_VALF; }));
}

TEST(BoundsTest, HoldEveryVertexOfEveryMesh) {
  testing::TestMesh a, b;
  a.positions = {{1, 2, 3}, {4, 5, 6}, {0, 0, 0}};
  b.positions = {{-1, 9, 3}};
  const auto rom = testing::bare_rom({a, b});
  const auto data = firmware::DrawingData::open(rom.bytes());
  const Bounds bounds = bounds_of(*data);
  EXPECT_EQ(bounds.low, (Vec3{-1, 0, 0}));
  EXPECT_EQ(bounds.high, (Vec3{4, 9, 6}));
}

}  // namespace
}  // namespace usuzumi
