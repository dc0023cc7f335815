// Solids against school geometry: closed, facing outwards, of the volume and the faces that they should have.
#include "firmware/solids/solid_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace usuzumi {
namespace {

using firmware::ShapeDetail;
using firmware::format::SolidKind;
constexpr double kPi = std::numbers::pi;

class Collected final : public firmware::ShapeSink {
 public:
  void vertex(Vec3 place, Vec3 normal) override {
    places.push_back(place);
    normals.push_back(normal);
  }
  void face(const std::uint32_t* corners, std::uint32_t count) override {
    faces.emplace_back(corners, corners + count);
  }

  Vec3 corner(const std::vector<std::uint32_t>& face, std::size_t i) const { return places.at(face[i % face.size()]); }
  double volume() const {
    double six = 0;
    for (const auto& f : faces)
      for (std::size_t i = 1; i + 1 < f.size(); ++i)
        six += double{dot(corner(f, 0), cross(corner(f, i), corner(f, i + 1)))};
    return six / 6;
  }
  /// Every edge is met by one the other way, by place.
  bool closed() const {
    std::map<std::array<std::array<float, 3>, 2>, int> balance;
    const auto at = [](Vec3 p) { return std::array{p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; };
    for (const auto& f : faces)
      for (std::size_t i = 0; i < f.size(); ++i) {
        ++balance[{at(corner(f, i)), at(corner(f, i + 1))}];
        --balance[{at(corner(f, i + 1)), at(corner(f, i))}];
      }
    return std::all_of(balance.begin(), balance.end(), [](const auto& e) { return e.second == 0; });
  }

  std::vector<Vec3> places, normals;
  std::vector<std::vector<std::uint32_t>> faces;
};

Collected shape(SolidKind kind, std::vector<float> size, ShapeDetail detail = {}) {
  size.resize(firmware::format::kMaxSolidSizes);
  Collected collected;
  firmware::tell_shape(kind, size.data(), detail, collected);
  return collected;
}

struct Case {
  const char* name;
  SolidKind kind;
  std::vector<float> size;
  double volume;  // of the solid itself; of flat ones exact
  std::size_t faces_of_member[3];
};

const Case kCases[] = {
    {"sphere", SolidKind::kSphere, {2}, 4 * kPi / 3, {128, 50, 32}},
    {"hemisphere", SolidKind::kHemisphere, {2}, 2 * kPi / 3, {80, 35, 24}},
    {"cone", SolidKind::kCone, {2, 3}, kPi, {17, 13, 9}},
    {"cylinder", SolidKind::kCylinder, {2, 3}, 3 * kPi, {18, 14, 10}},
    {"frustum", SolidKind::kFrustumCone, {4, 2, 3}, kPi * (4 + 2 + 1), {18, 14, 10}},
    {"cube", SolidKind::kCube, {3}, 27, {6, 6, 6}},
    {"cuboid", SolidKind::kCuboid, {2, 3, 4}, 24, {6, 6, 6}},
    {"square pyramid", SolidKind::kSquarePyramid, {3, 2}, 6, {5, 5, 5}},
    {"triangular pyramid", SolidKind::kTriangularPyramid, {4, 3, 2}, 4, {4, 4, 4}},
    {"trapezoid", SolidKind::kTrapezoid, {4, 4, 2, 2, 3}, 28, {6, 6, 6}},
};

TEST(SolidShape, IsClosedFacesOutwardsAndHasTheFacesOfTableTwo) {
  for (const Case& c : kCases) {
    double before = 0;
    for (const std::uint32_t member : {2u, 1u, 0u}) {
      SCOPED_TRACE(std::string(c.name) + ", member " + std::to_string(member));
      const Collected s = shape(c.kind, c.size, firmware::detail_of(c.kind, member, {}));
      EXPECT_EQ(s.faces.size(), c.faces_of_member[member]);
      EXPECT_TRUE(s.closed());
      EXPECT_LT(s.volume(), c.volume * 1.00001);
      EXPECT_GT(s.volume(), c.volume * (member == 0 ? 0.93 : 0.75));
      EXPECT_GE(s.volume(), before) << "finer than the member after it";
      before = s.volume() * 0.99999;
    }
  }
}

TEST(SolidShape, ALargeDetailComesNearTheVolume) {
  for (const Case& c : kCases)
    EXPECT_NEAR(shape(c.kind, c.size, {64, 32}).volume(), c.volume, c.volume * 0.005) << c.name;
}

TEST(SolidShape, NormalsHaveUnitLengthAndLookToTheFacesOutside) {
  for (const Case& c : kCases) {
    const Collected s = shape(c.kind, c.size, firmware::detail_of(c.kind, 0, {}));
    for (const auto& f : s.faces) {
      const Vec3 outside = normalized(cross(s.corner(f, 1) - s.corner(f, 0), s.corner(f, 2) - s.corner(f, 0)));
      for (const std::uint32_t v : f) {
        EXPECT_NEAR(length(s.normals[v]), 1, 1e-5) << c.name;
        EXPECT_GT(dot(s.normals[v], outside), 0.9) << c.name;
      }
    }
  }
}

TEST(SolidShape, OriginIsTheMiddleOfItsBox) {
  for (const Case& c : kCases) {
    std::vector<float> size = c.size;
    size.resize(firmware::format::kMaxSolidSizes);
    const Vec3 half = firmware::half_extent(c.kind, size.data());
    // Of as many sides as four divide, so that all four ends of both axes are there.
    const Collected s = shape(c.kind, c.size, {64, 32});
    Vec3 low = s.places[0], high = low;
    for (const Vec3 p : s.places) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    EXPECT_LT(length(high - half), 1e-5) << c.name;
    EXPECT_LT(length(low + half), 1e-5) << c.name;
  }
}

double area_from(const std::vector<Vec3>& polygon, Vec3 viewer) {
  Vec3 twice;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    twice = twice + cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return double{dot(twice, viewer)} / 2;
}

TEST(SolidSections, AreWhatIsSeenFromThatSideCounterClockwise) {
  constexpr Vec3 kSides[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  struct Areas {
    SolidKind kind;
    std::vector<float> size;
    double x, y, z;  // seen along that axis
  };
  const Areas cases[] = {
      {SolidKind::kSphere, {2}, kPi, kPi, kPi},
      {SolidKind::kHemisphere, {2}, kPi / 2, kPi, kPi / 2},
      {SolidKind::kCone, {2, 3}, 3, kPi, 3},
      {SolidKind::kCylinder, {2, 3}, 6, kPi, 6},
      {SolidKind::kFrustumCone, {4, 2, 3}, 9, 4 * kPi, 9},
      {SolidKind::kCube, {3}, 9, 9, 9},
      {SolidKind::kCuboid, {2, 3, 4}, 12, 8, 6},
      {SolidKind::kSquarePyramid, {3, 2}, 3, 9, 3},
      {SolidKind::kTriangularPyramid, {4, 3, 2}, 3, 6, 4},
      {SolidKind::kTrapezoid, {4, 4, 2, 2, 3}, 9, 16, 9},
  };
  for (const Areas& c : cases) {
    std::vector<float> size = c.size;
    size.resize(firmware::format::kMaxSolidSizes);
    for (std::uint32_t side = 0; side < firmware::kSectionCount; ++side) {
      std::vector<Vec3> places(64);
      places.resize(firmware::tell_section(c.kind, size.data(), 64, side, places.data()));
      const double area = side < 2 ? c.x : (side < 4 ? c.y : c.z);
      EXPECT_NEAR(area_from(places, kSides[side]), area, area * 0.003)
          << "kind " << static_cast<int>(c.kind) << " from side " << side;
      for (const Vec3 p : places) EXPECT_EQ(dot(p, kSides[side]), 0) << "in the plane through the origin";
    }
  }
}

TEST(SolidSizes, AreThoseOfTableOne) {
  const auto size_of = [](SolidKind kind, std::vector<float> size) {
    size.resize(firmware::format::kMaxSolidSizes);
    return firmware::identifying_size(kind, size.data());
  };
  EXPECT_EQ(size_of(SolidKind::kSphere, {2}), (Vec3{2, 2, 2}));
  EXPECT_EQ(size_of(SolidKind::kHemisphere, {2}), (Vec3{2, 2, 2}));
  EXPECT_EQ(size_of(SolidKind::kCone, {2, 3}), (Vec3{2, 1.5f, 2}));
  EXPECT_EQ(size_of(SolidKind::kCylinder, {2, 3}), (Vec3{2, 1.5f, 2}));
  EXPECT_EQ(size_of(SolidKind::kFrustumCone, {4, 2, 3}), (Vec3{4, 1.5f, 4}));
  EXPECT_EQ(size_of(SolidKind::kFrustumCone, {2, 4, 3}), (Vec3{4, 1.5f, 4}));
  EXPECT_EQ(size_of(SolidKind::kCube, {3}), (Vec3{3, 3, 3}));
  EXPECT_EQ(size_of(SolidKind::kCuboid, {2, 3, 4}), (Vec3{2, 1.5f, 4}));
  EXPECT_EQ(size_of(SolidKind::kSquarePyramid, {3, 2}), (Vec3{3, 1, 3}));
  EXPECT_EQ(size_of(SolidKind::kTriangularPyramid, {4, 3, 2}), (Vec3{4, 1, 3}));
  EXPECT_EQ(size_of(SolidKind::kTrapezoid, {4, 1, 2, 5, 3}), (Vec3{4, 1.5f, 5}));
}

}  // namespace
}  // namespace usuzumi
