// The passes between importer and ROM: normals, welding, strips, names, colours. Shapes small enough to count on
// fingers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/pack/colour.h"
#include "sim/pack/names.h"
#include "sim/pack/normals.h"
#include "sim/pack/strip.h"
#include "sim/pack/tag_values.h"
#include "sim/pack/weld.h"
#include "tests/sim/pack/support.h"

namespace usuzumi {
namespace {

using sim::Mesh;
using testing::face_corners;
using testing::faces_of;
using ::testing::HasSubstr;

/// A box of edge 1 with shared corners: 8 vertices, 12 faces.
Mesh box() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back({static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1), static_cast<float>(i >> 2)});
  mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                  2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  return mesh;
}

/// A tube of `sides` around the z axis, open at both ends.
Mesh tube(std::uint32_t sides) {
  Mesh mesh;
  for (std::uint32_t s = 0; s < sides; ++s) {
    const double a = 2 * M_PI * s / sides;
    for (float z : {0.0f, 1.0f})
      mesh.positions.push_back({static_cast<float>(std::cos(a)), static_cast<float>(std::sin(a)), z});
  }
  for (std::uint32_t s = 0; s < sides; ++s) {
    const std::uint32_t a = 2 * s, b = 2 * ((s + 1) % sides);
    mesh.indices.insert(mesh.indices.end(), {a, b, a + 1, b, b + 1, a + 1});
  }
  return mesh;
}

TEST(Normals, OfABoxAreItsSixSidesAndItsEdgesStaySharp) {
  Mesh mesh = box();
  sim::complete_normals(mesh);
  sim::weld_vertices(mesh);
  EXPECT_EQ(mesh.positions.size(), 24u);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
               c = mesh.positions[mesh.indices[i + 2]];
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(mesh.normals[mesh.indices[i + k]], normalized(cross(b - a, c - a)));
  }
}

TEST(Normals, OfARoundTubePointAwayFromItsAxis) {
  Mesh mesh = tube(24);  // 15 degrees from side to side
  sim::complete_normals(mesh);
  sim::weld_vertices(mesh);
  EXPECT_EQ(mesh.positions.size(), 48u) << "smooth: no vertex is parted";
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    EXPECT_GT(mesh.normals[v].x * mesh.positions[v].x + mesh.normals[v].y * mesh.positions[v].y,
              std::cos(3.0 * M_PI / 180))
        << v;
}

TEST(Normals, PartVerticesWhereSidesMeetAboveSixtyDegreesOnly) {
  Mesh five = tube(5), seven = tube(7);  // 72 and 51 degrees
  sim::complete_normals(five);
  sim::weld_vertices(five);
  sim::complete_normals(seven);
  sim::weld_vertices(seven);
  EXPECT_EQ(five.positions.size(), 20u);
  EXPECT_EQ(seven.positions.size(), 14u);
}

TEST(Normals, OfTheFileAreKeptAndOnlyUnusableOnesReplaced) {
  Mesh mesh = box();
  mesh.positions.resize(4);
  mesh.indices = {0, 1, 3};
  mesh.normals = {{0, 0, 2}, {NAN, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  sim::complete_normals(mesh);
  for (std::uint32_t i : mesh.indices) EXPECT_EQ(mesh.normals[i], (Vec3{0, 0, 1}));
}

TEST(Normals, OpenBorderIsSeenByPosition) {
  EXPECT_FALSE(sim::has_open_border(box()));
  EXPECT_TRUE(sim::has_open_border(tube(6)));
  Mesh parted = box();
  sim::complete_normals(parted);
  EXPECT_FALSE(sim::has_open_border(parted)) << "vertices parted for their normals are one place still";
}

TEST(Weld, JoinsVerticesOfEqualPositionNormalAndColourOnly) {
  Mesh mesh;
  mesh.positions = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0f, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals.assign(7, {0, 0, 1});
  mesh.normals[5] = {0, 1, 0};
  mesh.colours.assign(7, rgba8(1, 2, 3));
  mesh.colours[6] = rgba8(3, 2, 1);
  mesh.indices = {1, 2, 3, 4, 5, 6};
  const auto before = faces_of(mesh);
  sim::weld_vertices(mesh);
  // 1 and 4 are one (minus zero is zero); 2 and 5 differ in normal, 3 and 6 in colour; 0 is used by no face.
  EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 3, 4}));
  EXPECT_EQ(mesh.positions.size(), 5u);
  EXPECT_EQ(faces_of(mesh), before);
}

TEST(Weld, PolesAndSeamsOfASphereMadeWithSinesClose) {
  constexpr std::uint32_t kRings = 6, kSegments = 12;
  Mesh mesh;
  for (std::uint32_t j = 0; j <= kRings; ++j)
    for (std::uint32_t i = 0; i <= kSegments; ++i) {  // the seam twice, as texture coordinates ask for
      const double theta = M_PI * j / kRings, phi = 2 * M_PI * i / kSegments;
      mesh.positions.push_back({static_cast<float>(50 * std::sin(theta) * std::cos(phi)),
                                static_cast<float>(50 * std::cos(theta)),
                                static_cast<float>(50 * std::sin(theta) * std::sin(phi))});
    }
  EXPECT_GT(sim::number_positions(mesh.positions).first_vertex.size(), (kRings - 1) * kSegments + 2)
      << "sin(pi) is not 0";
  sim::drop_rounding_noise(mesh);
  EXPECT_EQ(sim::number_positions(mesh.positions).first_vertex.size(), (kRings - 1) * kSegments + 2);
}

TEST(Weld, OnlyWhatIsNothingBesideTheMeshIsDropped) {
  Mesh mesh;
  mesh.positions = {{4, 4e-9f, -3.7e-9f}, {0, -4, 5e-9f}};  // 2^-30 of 4 is 3.73e-9
  sim::drop_rounding_noise(mesh);
  EXPECT_EQ(mesh.positions[0], (Vec3{4, 4e-9f, 0}));
  EXPECT_EQ(mesh.positions[1], (Vec3{0, -4, 5e-9f}));
  Mesh tiny;
  tiny.positions = {{1e-30f, 0, 2e-30f}};
  sim::drop_rounding_noise(tiny);
  EXPECT_EQ(tiny.positions[0], (Vec3{1e-30f, 0, 2e-30f}));
}

TEST(Weld, RemovesFacesThatRepeatAPlace) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  mesh.indices = {0, 1, 2, 0, 1, 3, 2, 2, 0};
  EXPECT_EQ(sim::remove_faces_without_area(mesh), 2u);
  EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2}));
}

/// The faces that a reader finds in a strip, by the rule on the format page.
std::multiset<testing::FaceCorners> strip_faces(const std::vector<Vec3>& strip) {
  firmware::MeshView view;
  view.topology = firmware::format::Topology::kStrip;
  view.positions = strip;
  return faces_of(view);
}

TEST(Strip, DrawsEachFaceOnceWithItsWinding) {
  for (const Mesh& mesh : {box(), tube(3), tube(40)}) EXPECT_EQ(strip_faces(sim::triangle_strip(mesh)), faces_of(mesh));
}

TEST(Strip, OfASingleFaceIsItsThreeCornersAndOfATubeNearlyOneRun) {
  Mesh one = box();
  one.indices.resize(3);
  EXPECT_EQ(sim::triangle_strip(one).size(), 3u);
  EXPECT_LE(sim::triangle_strip(tube(40)).size(), 80u + 8u)
      << "80 faces in a ring need 82 vertices when they are one run";
}

TEST(Strip, SurvivesAnySoupOfFaces) {
  std::mt19937 generator(20'260'101);
  auto random = [&](std::uint32_t below) { return static_cast<std::uint32_t>(generator() % below); };
  for (int round = 0; round < 50; ++round) {
    Mesh mesh;
    const std::uint32_t vertices = 3 + random(12);
    for (std::uint32_t v = 0; v < vertices; ++v)
      mesh.positions.push_back({static_cast<float>(v), static_cast<float>(v % 3), static_cast<float>(v % 5)});
    for (std::uint32_t f = 0; f < 40; ++f) {  // faces twice, turned over, edges with many faces, all of it
      const std::uint32_t a = random(vertices), b = random(vertices), c = random(vertices);
      mesh.indices.insert(mesh.indices.end(), {a, b, c});
    }
    sim::remove_faces_without_area(mesh);
    EXPECT_EQ(strip_faces(sim::triangle_strip(mesh)), faces_of(mesh)) << "round " << round;
  }
}

TEST(Names, PatternsMatchLikeShellsDo) {
  EXPECT_TRUE(sim::matches_pattern("Wheel", "Wheel"));
  EXPECT_FALSE(sim::matches_pattern("Wheel", "Wheels"));
  EXPECT_TRUE(sim::matches_pattern("Wh*l?", "Wheels"));
  EXPECT_TRUE(sim::matches_pattern("*", ""));
  EXPECT_FALSE(sim::matches_pattern("?", ""));
  EXPECT_TRUE(sim::matches_pattern("*a*b*", "xxaxxbxx"));
  EXPECT_FALSE(sim::matches_pattern("*a*b", "xxaxxbxx"));
  EXPECT_TRUE(sim::matches_pattern("**", "x"));
  // A matcher that tries every way would not come back from this.
  EXPECT_FALSE(sim::matches_pattern("*a*a*a*a*a*a*a*a*a*a*a*a*b", std::string(5000, 'a')));
}

TEST(Names, APlainNameMeansAllOfThatNameAndANumberedOneASingleMesh) {
  const std::vector<std::string> names{"Wheel", "Wheel#2", "Wheel#10", "Wheels", "Wheel#", "A*b"};
  const auto found = [&](const char* pattern) {
    std::string all;
    for (const std::string& name : names)
      if (sim::matches_name(pattern, name)) all += name + " ";
    return all;
  };
  EXPECT_EQ(found("Wheel"), "Wheel Wheel#2 Wheel#10 ");
  EXPECT_EQ(found("Wheel#1"), "Wheel ");
  EXPECT_EQ(found("Wheel#2"), "Wheel#2 ");
  EXPECT_EQ(found("Wheel#10"), "Wheel#10 ");
  EXPECT_EQ(found("Wheel#3"), "");
  EXPECT_EQ(found("Wheel?"), "Wheels Wheel# ");
  EXPECT_EQ(found("Wh*#1"), "Wheel Wheels Wheel# ") << "the first of each";
  EXPECT_EQ(found("W*#2"), "Wheel#2 ");
  EXPECT_EQ(found("A*b"), "A*b ");
  EXPECT_EQ(found("A*b#1"), "A*b ");
}

TEST(Names, UniqueNamesNeverMeetNamesThatAreThereAlready) {
  sim::Model model;
  for (const char* name : {"a", "a#2", "a", "a", "b"}) model.meshes.emplace_back().mesh_name = name;
  sim::make_names_unique(model);
  std::vector<std::string> names;
  for (const Mesh& mesh : model.meshes) names.push_back(mesh.name);
  EXPECT_EQ(names, (std::vector<std::string>{"a", "a#2", "a#3", "a#4", "b"}));
}

TEST(Names, SuggestionsAreTheClosest) {
  const std::vector<std::string> names{"Wheel", "Wheels", "Body", "Window"};
  EXPECT_THAT(sim::suggest("Whel", names), HasSubstr("did you mean Wheel, Wheels?"));
  EXPECT_THAT(sim::suggest("quite another", names), ::testing::EndsWith("there are: Body, Wheel, Wheels, Window"));
  std::vector<std::string> many;
  for (char c = 'a'; c <= 'k'; ++c) many.emplace_back(20, c);
  const std::string ten = sim::suggest("1", many);
  EXPECT_THAT(ten, ::testing::EndsWith(many[9] + ", …"));
  EXPECT_EQ(sim::edit_distance("kitten", "sitting"), 3u);
}

TEST(Tags, QuotasAreReadExactly) {
  using firmware::format::QuotaKind;
  auto quota = [](const char* text) {
    sim::Tags tags;
    EXPECT_EQ(sim::set_tag(tags, sim::kQuotaKey, {{}, {}, text}), "") << text;
    return tags.quota.value_or(sim::FaceQuota{});
  };
  EXPECT_EQ(quota("25%"), (sim::FaceQuota{QuotaKind::kMillionths, 250'000}));
  EXPECT_EQ(quota("0.0001%"), (sim::FaceQuota{QuotaKind::kMillionths, 1}));
  EXPECT_EQ(quota("33.3333%"), (sim::FaceQuota{QuotaKind::kMillionths, 333'333}));
  EXPECT_EQ(quota("4294967295"), (sim::FaceQuota{QuotaKind::kFaces, 4'294'967'295u}));
  for (const char* bad : {"", "%", "25 %", "-1", "4294967296", "0", "1.5", "nan", "0x10", "0.00001%", "1e9%"}) {
    sim::Tags tags;
    EXPECT_NE(sim::set_tag(tags, sim::kQuotaKey, {{}, {}, bad}), "") << bad;
  }
}

TEST(Colour, FollowsTheSrgbCurve) {
  // Values of IEC 61966-2-1: 0.214041 is the linear light of code value 0.5.
  EXPECT_NEAR(sim::srgb_encoded(0.214041), 0.5, 1e-5);
  EXPECT_NEAR(sim::srgb_encoded(0.0031308), 0.04045, 1e-5);
  EXPECT_EQ(sim::from_linear({-1, 2, NAN, 1}), rgba8(0, 255, 0, 255));
  EXPECT_EQ(sim::from_display({0.5, 0.25, 0, 0.5}), rgba8(128, 64, 0, 128));
}

}  // namespace
}  // namespace usuzumi
