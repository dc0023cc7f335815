// Members as they lie in RAM: what is drawn of a solid, seen from where.
#include "firmware/solids/solid_members.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace usuzumi {
namespace {

using firmware::DrawnMember;
using firmware::Member;
using firmware::SolidMembers;
using firmware::SolidsView;
using firmware::format::Solid;
using firmware::format::SolidKind;

Solid solid(SolidKind kind, std::vector<float> size) {
  Solid s;
  s.kind = kind;
  std::copy(size.begin(), size.end(), s.size);
  return s;
}

/// Stretched along the model's y, turned a quarter about z, moved.
Solid placed(Solid s) {
  const float m[12] = {0, -1, 0, 5, 3, 0, 0, -2, 0, 0, 1, 1};
  std::copy(std::begin(m), std::end(m), s.to_model);
  return s;
}

Solid mirrored(Solid s) {
  const float m[12] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  std::copy(std::begin(m), std::end(m), s.to_model);
  return s;
}

class Made {
 public:
  explicit Made(std::vector<Solid> solids) : solids_(std::move(solids)) {
    view_ = {{}, firmware::kDefaultCandidates, solids_};
    memory_.resize(SolidMembers::bytes(view_) + 4096);
    Arena arena(memory_);
    EXPECT_TRUE(members.begin(view_, arena).ok());
    EXPECT_LE(arena.used(), SolidMembers::bytes(view_));
  }

  std::vector<Vec3> triangle(const DrawnMember& d, std::uint32_t t) const {
    std::vector<Vec3> corners;
    for (std::uint32_t k = 0; k < 3; ++k)
      corners.push_back(members.positions()[d.first_vertex + members.indices()[d.first_index + 3 * t + k]]);
    return corners;
  }
  double volume(const DrawnMember& d) const {
    double six = 0;
    for (std::uint32_t t = 0; t < d.index_count / 3; ++t) {
      const auto c = triangle(d, t);
      six += double{dot(c[0], cross(c[1], c[2]))};
    }
    return six / 6;
  }

  SolidMembers members;

 private:
  std::vector<Solid> solids_;
  SolidsView view_;
  std::vector<std::byte> memory_;
};

TEST(SolidMembers, StandWhereTheirSolidIsPlacedFacingOutwards) {
  Made made({placed(solid(SolidKind::kCuboid, {1, 2, 3})), mirrored(solid(SolidKind::kTrapezoid, {4, 4, 2, 2, 3}))});
  EXPECT_NEAR(made.volume(made.members.choose(0, Member::kHigh, {})), 6 * 3, 1e-4) << "stretched to three times";
  EXPECT_NEAR(made.volume(made.members.choose(1, Member::kMedium, {})), 28, 1e-4) << "mirrored, not turned inside out";
  const DrawnMember d = made.members.choose(0, Member::kHigh, {});
  for (std::uint32_t v = 0; v < d.vertex_count; ++v) {
    const Vec3 from_middle = made.members.positions()[d.first_vertex + v] - Vec3{5, -2, 1};
    EXPECT_FLOAT_EQ(std::fabs(from_middle.x), 1);
    EXPECT_FLOAT_EQ(std::fabs(from_middle.y), 1.5f);
    EXPECT_FLOAT_EQ(std::fabs(from_middle.z), 1.5f);
    const Vec3 normal = unpack(made.members.normals()[d.first_vertex + v]);
    EXPECT_NEAR(length(normal), 1, 0.003);
    EXPECT_GT(dot(normal, from_middle), 0.5f);
  }
}

TEST(SolidMembers, NormalsOfAStretchedBallAreThoseOfItsEllipsoid) {
  Solid ball = solid(SolidKind::kSphere, {2});
  ball.to_model[0] = 3;  // along x
  Made made({ball});
  const DrawnMember d = made.members.choose(0, Member::kHigh, {});
  for (std::uint32_t v = 0; v < d.vertex_count; ++v) {
    const Vec3 p = made.members.positions()[d.first_vertex + v];
    const Vec3 gradient = normalized({p.x / 9, p.y, p.z});  // of x^2 / 9 + y^2 + z^2
    EXPECT_GT(dot(normalized(unpack(made.members.normals()[d.first_vertex + v])), gradient), 0.9999f);
  }
}

TEST(SolidMembers, OfACubeLowShowsTheFacesThatTheNearestCandidateSees) {
  Made made({solid(SolidKind::kCube, {2})});
  // Straight on, the four sides are seen edge-on and count as seen: M[i] is 0, not below (eq. 5).
  EXPECT_EQ(made.members.choose(0, Member::kLow, {0, 0, 9}).faces, 5u);
  // From over an edge: the two at it, and the two at its ends.
  const DrawnMember edge = made.members.choose(0, Member::kLow, {5, 5, 0});
  EXPECT_EQ(edge.faces, 4u);
  EXPECT_EQ(edge.index_count, 4 * 6u);
  for (std::uint32_t t = 0; t < edge.index_count / 3; ++t) {
    const auto c = made.triangle(edge, t);
    const Vec3 normal = normalized(cross(c[1] - c[0], c[2] - c[0]));
    EXPECT_GE(normal.x + normal.y, 0) << "not the ones behind";
  }
  // The same again after another.
  made.members.choose(0, Member::kLow, {-5, 0, 0});
  EXPECT_EQ(made.members.choose(0, Member::kLow, {5, 5, 0}).faces, 4u);
  EXPECT_EQ(made.members.face_count(0, Member::kLow), 6u);
}

TEST(SolidMembers, LowDropsAboutHalfOfABall) {
  Made made({solid(SolidKind::kSphere, {2})});
  for (const Vec3 viewer : firmware::kDefaultCandidates) {
    const DrawnMember d = made.members.choose(0, Member::kLow, viewer * 7);
    EXPECT_GE(d.faces, 16u);
    EXPECT_LE(d.faces, 24u) << "of 32";
    for (std::uint32_t t = 0; t < d.index_count / 3; ++t) {
      const auto c = made.triangle(d, t);
      EXPECT_GT(dot(cross(c[1] - c[0], c[2] - c[0]), viewer), -1e-4f);
    }
  }
}

TEST(SolidMembers, RoughIsOneSectionTurnedToTheViewer) {
  Made made({solid(SolidKind::kCone, {2, 3}), placed(solid(SolidKind::kCone, {2, 3}))});
  const DrawnMember side = made.members.choose(0, Member::kRough, {1, 0.2f, 0});
  EXPECT_EQ(side.faces, 1u);
  EXPECT_EQ(side.vertex_count, 3u) << "a triangle from the side";
  const DrawnMember above = made.members.choose(0, Member::kRough, {0.1f, 1, 0});
  EXPECT_EQ(above.vertex_count, 8u) << "a circle of as many sides as member 2 has from above";
  for (const Vec3 viewer : std::span(firmware::kDefaultCandidates).first(6))
    for (const std::uint32_t n : {0u, 1u}) {
      const DrawnMember d = made.members.choose(n, Member::kRough, viewer);
      const auto c = made.triangle(d, 0);
      EXPECT_GT(dot(cross(c[1] - c[0], c[2] - c[0]), viewer), 0) << n;
      EXPECT_GT(dot(unpack(made.members.normals()[d.first_vertex]), viewer), 0.9f) << n;
    }
}

TEST(SolidMembers, EverySizeOfRamIsEnoughOrSaid) {
  const std::vector<Solid> solids{solid(SolidKind::kSphere, {1}), solid(SolidKind::kTrapezoid, {4, 4, 2, 2, 3})};
  const SolidsView view{{}, firmware::kDefaultCandidates, solids};
  bool was_enough = false;
  for (std::size_t bytes = 0; bytes < SolidMembers::bytes(view) + 4096; bytes += 97) {
    std::vector<std::byte> memory(bytes);
    Arena arena(memory);
    SolidMembers members;
    const Status status = members.begin(view, arena);
    EXPECT_FALSE(was_enough && !status.ok());
    if (status.ok()) {
      was_enough = true;
      EXPECT_EQ(members.count(), 2u);
    } else {
      EXPECT_EQ(status.code, StatusCode::kResourceExhausted);
      EXPECT_GE(status.where, SolidMembers::bytes(view));
      EXPECT_LT(status.where, SolidMembers::bytes(view) + 4096);
      EXPECT_GT(status.where + 64, bytes);
      EXPECT_EQ(arena.used(), 0u);
      EXPECT_EQ(members.count(), 0u);
    }
  }
  EXPECT_TRUE(was_enough);
}

}  // namespace
}  // namespace usuzumi
