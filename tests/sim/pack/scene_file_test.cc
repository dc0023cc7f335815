// Scene files into drawing data, and section SOLD as the firmware reads it.
#include "sim/pack/scene_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>

#include "firmware/drawing_data/drawing_data.h"
#include "firmware/solids/solid_members.h"
#include "firmware/solids/solid_placement.h"
#include "sim/common/error.h"
#include "sim/pack/rom_writer.h"
#include "tests/sim/pack/support.h"
#include "tests/support/rom_builder.h"

namespace usuzumi {
namespace {

namespace format = firmware::format;
using firmware::DrawingData;
using testing::RomImage;
using testing::TempFolder;
using testing::run_usuzumi;

constexpr const char* kThree = R"({"solids": [
  {"name": "ball", "kind": "sphere", "diameter": 2, "colour": "#ff8000", "position": [1, 2, 3]},
  {"kind": "frustum-cone", "bottom_diameter": 3, "top_diameter": 2, "height": 4, "rotation_deg": [0, 0, 90],
   "scale": [1, 2, 1]},
  {"name": "gem", "kind": "trapezoid", "bottom_width": 4, "bottom_depth": 3, "top_width": 2, "top_depth": 1,
   "height": 5, "transform": [0, 0, 1, 7, 0, 1, 0, 8, -1, 0, 0, 9]}]})";

RomImage rom_of(const std::string& scene) {
  const TempFolder folder;
  return RomImage::of(sim::write_container(sim::read_scene_file(folder.write("scene.json", scene)).model));
}

TEST(SceneFile, SolidsAreInTheDrawingDataAsTheirAuthorPlacedThem) {
  const RomImage rom = rom_of(kThree);
  const auto data = DrawingData::open(rom.bytes());
  ASSERT_TRUE(data.ok()) << data.status().message;
  EXPECT_EQ(data->mesh_max(), 0u);
  const firmware::SolidsView& view = data->solids();
  ASSERT_EQ(view.solids.size(), 3u);
  EXPECT_EQ(view.candidates.size(), 18u);
  EXPECT_EQ(view.detail.sphere_around[0], 16u);
  EXPECT_EQ(view.solids[0].kind, format::SolidKind::kSphere);
  EXPECT_EQ(view.solids[0].size[0], 2);
  EXPECT_EQ(view.solids[0].colour, rgba8(255, 128, 0).bits);
  EXPECT_EQ(data->name_of(view.solids[0]), "ball");
  EXPECT_EQ(data->name_of(view.solids[1]), "");
  EXPECT_EQ(data->name_of(view.solids[2]), "gem");
  // Stretched along its axis to twice its height, then laid on its side: +y goes to -x.
  const auto lying = firmware::SolidPlacement::of(view.solids[1]);
  EXPECT_LT(length(lying.point({0, 2, 0}) - Vec3{-4, 0, 0}), 1e-5f);
  EXPECT_LT(length(lying.point({1, 0, 0}) - Vec3{0, 1, 0}), 1e-5f);
  EXPECT_EQ(firmware::SolidPlacement::of(view.solids[2]).point({1, 2, 3}), (Vec3{10, 10, 8}));
}

TEST(SceneFile, TurnsAboutXThenYThenZ) {
  const RomImage rom = rom_of(
      R"({"solids": [{"kind": "cube", "edge": 1, "rotation_deg": [90, 90, 0]}]})");
  const auto data = DrawingData::open(rom.bytes());
  ASSERT_TRUE(data.ok());
  // About x: y to z, z to -y. About y: z to x, x to -z.
  const auto placement = firmware::SolidPlacement::of(data->solids().solids[0]);
  EXPECT_LT(length(placement.point({0, 1, 0}) - Vec3{1, 0, 0}), 1e-6f);
  EXPECT_LT(length(placement.point({1, 0, 0}) - Vec3{0, 0, -1}), 1e-6f);
}

TEST(SceneFile, CandidatesAndDetailAreTheAuthors) {
  const RomImage rom = rom_of(R"({"solids": [{"kind": "sphere", "diameter": 1}],
    "view_candidates": [[0, 0, 5], [3, 0, 4]],
    "detail": {"sphere": [[24, 12], [12, 6], [6, 3]], "round": [20, 10, 5]}})");
  const auto data = DrawingData::open(rom.bytes());
  ASSERT_TRUE(data.ok()) << data.status().message;
  ASSERT_EQ(data->solids().candidates.size(), 2u);
  EXPECT_LT(length(data->solids().candidates[1] - Vec3{0.6f, 0, 0.8f}), 1e-6f);
  EXPECT_EQ(data->solids().detail.sphere_rows[1], 6u);
  EXPECT_EQ(data->solids().detail.round_sides[2], 5u);
  EXPECT_EQ(data->solids().detail.hemisphere_around[0], 16u) << "not named: the default";
  std::vector<std::byte> memory(100'000);
  Arena arena(memory);
  firmware::SolidMembers members;
  ASSERT_TRUE(members.begin(data->solids(), arena).ok());
  EXPECT_EQ(members.face_count(0, firmware::Member::kHigh), 24u * 12);
}

TEST(SceneFile, WhatIsWrongIsOneLineWithTheSolidsName) {
  struct Case {
    const char* scene;
    const char* told;
  };
  const Case cases[] = {
      {"[]", "must be an object"},
      {"{}", "\"solids\""},
      {R"({"solids": []})", "at least one solid"},
      {R"({"solids": [{"kind": "sphere", "diameter": 1}], "lights": []})", "\"lights\" is none of"},
      {R"({"solids": [{"diameter": 1}]})", "solid 1: there is no \"kind\""},
      {R"({"solids": [{"kind": "egg"}]})", "\"egg\" is none of sphere, hemisphere"},
      {R"({"solids": [{"name": "a", "kind": "sphere"}]})", "solid 1 (a): there is no \"diameter\""},
      {R"({"solids": [{"kind": "sphere", "diameter": 0}]})", "\"diameter\" must be above 0"},
      {R"({"solids": [{"kind": "cone", "diameter": 1, "height": -2}]})", "\"height\" must be above 0"},
      {R"({"solids": [{"kind": "sphere", "diameter": 1, "height": 2}]})", "\"height\" is none of"},
      {R"({"solids": [{"kind": "cube", "edge": "big"}]})", "\"edge\" must be a number"},
      {R"({"solids": [{"kind": "cube", "edge": 1, "colour": "red"}]})", "#rrggbb"},
      {R"({"solids": [{"kind": "cube", "edge": 1, "position": [1, 2]}]})", "\"position\" must be 3 numbers"},
      {R"({"solids": [{"kind": "cube", "edge": 1, "transform": [1]}]})", "\"transform\" must be 12 numbers"},
      {R"({"solids": [{"kind": "cube", "edge": 1, "scale": 2, "transform": [1,0,0,0,0,1,0,0,0,0,1,0]}]})",
       "or the other"},
      {R"({"solids": [{"kind": "cube", "edge": 1.5e8}]})", "\"edge\" must be"},
      {R"({"solids": [{"kind": "cube", "edge": 1e9, "scale": 0.01}]})", "\"edge\" must be"},
      {R"({"solids": [{"kind": "cube", "edge": 1, "scale": 1e-7}]})", "shrunk"},
      {R"({"solids": [{"kind": "cube", "edge": 1, "rotation_deg": [0, 1e9, 0]}]})", "million degrees"},
      {R"({"solids": [{"name": "a\nb", "kind": "egg"}]})", "solid 1 (a_b)"},
      {R"({"solids": [{"kind": "cube", "edge": 1, "scale": [1, 0, 1]}]})", "placed flat"},
      {R"({"solids": [{"kind": "cube", "edge": 1, "position": [1e9, 0, 0]}]})", "beyond"},
      {R"({"solids": [{"kind": "cube", "edge": 1}], "view_candidates": []})", "1 to 32 directions"},
      {R"({"solids": [{"kind": "cube", "edge": 1}], "view_candidates": [[0, 0, 0]]})", "no length"},
      {R"({"solids": [{"kind": "cube", "edge": 1}], "detail": {"round": [16, 12, 2]}})", "from 3 to 64"},
      {R"({"solids": [{"kind": "cube", "edge": 1}], "detail": {"sphere": [[8, 8]]}})", "three pairs"},
      {R"({"solids": [{"kind": "cube", "edge": 1}], "models": ["gone.glb"]})", "gone.glb"},
  };
  const TempFolder folder;
  for (const Case& c : cases) {
    const auto ran = run_usuzumi({"pack", folder.write("scene.json", c.scene), "-o", folder / "out.rom"});
    EXPECT_EQ(ran.exit_code, 3) << c.scene << ran.err;
    EXPECT_NE(ran.err.find(c.told), std::string::npos) << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  }
  EXPECT_EQ(folder.files(), std::vector<std::string>{"scene.json"}) << "nothing half-written";
}

TEST(SceneFile, ModelsBesideSolidsArePackedWithThem) {
  const TempFolder folder;
  folder.write("plate.gltf", testing::one_triangle().text());
  const std::string scene =
      folder.write("scene.json", R"({"solids": [{"kind": "cube", "edge": 1}], "models": ["plate.gltf"]})");
  const auto ran = run_usuzumi({"pack", scene, "-o", folder / "out.rom"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_NE(ran.out.find("1 meshes"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("1 solids"), std::string::npos) << ran.out;
  const auto inspected = run_usuzumi({"inspect", folder / "out.rom", "--json"});
  const auto report = nlohmann::json::parse(inspected.out);
  EXPECT_EQ(report["solids"][0]["kind"], "cube");
  EXPECT_EQ(report["solids"][0]["edge"], 1);
  EXPECT_EQ(run_usuzumi({"pack", scene, "--bare", "-o", folder / "bare.rom"}).exit_code, 2);
  EXPECT_EQ(run_usuzumi({"pack", scene, scene, "-o", folder / "two.rom"}).exit_code, 2);
}

TEST(SolidsSection, WhatIsWrongIsToldByItsPlaceInTheFile) {
  const RomImage good = rom_of(kThree);
  const auto data = DrawingData::open(good.bytes());
  ASSERT_TRUE(data.ok());
  const auto offset_of = [&](const void* p) {
    return static_cast<std::uint32_t>(static_cast<const std::byte*>(p) - good.bytes().data());
  };
  const std::uint32_t candidates = offset_of(data->solids().candidates.data());
  const std::uint32_t header = candidates - 72, solid = offset_of(data->solids().solids.data());
  const auto refused_at = [&](std::uint32_t offset, std::uint32_t value) {
    RomImage rom = good;
    rom[offset] = value;
    testing::seal(rom);
    const Status status = DrawingData::open(rom.bytes()).status();
    EXPECT_FALSE(status.ok()) << "at " << offset << " " << value;
    return status.where;
  };
  const auto bits = [](float f) {
    std::uint32_t word;
    std::memcpy(&word, &f, 4);
    return word;
  };
  for (const std::uint32_t count : {0u, 2u, 4u, 0xFFFFFFFFu}) EXPECT_EQ(refused_at(header, count), header);
  for (const std::uint32_t count : {0u, 17u, 33u, 0xFFFFFFFFu}) EXPECT_EQ(refused_at(header + 4, count), header);
  EXPECT_EQ(refused_at(header + 8, 2), header + 8) << "around a sphere";
  EXPECT_EQ(refused_at(header + 8, 65), header + 8);
  EXPECT_EQ(refused_at(header + 20, 1), header + 8) << "its rows";
  EXPECT_EQ(refused_at(header + 68, 1), header + 8) << "reserved";
  EXPECT_EQ(refused_at(candidates + 12, bits(3)), candidates + 12);
  EXPECT_EQ(refused_at(candidates + 12, bits(std::numeric_limits<float>::quiet_NaN())), candidates + 12);
  EXPECT_EQ(refused_at(solid, 10), solid) << "kind";
  for (const float size : {0.0f, -1.0f, 2e8f, std::numeric_limits<float>::infinity(),
                           std::numeric_limits<float>::quiet_NaN()})
    EXPECT_EQ(refused_at(solid + 4, bits(size)), solid + 4);
  EXPECT_EQ(refused_at(solid + 8, bits(1)), solid + 4) << "a size that a sphere has not";
  EXPECT_EQ(refused_at(solid + 24, 0), solid + 24) << "flat";
  EXPECT_EQ(refused_at(solid + 24, bits(std::numeric_limits<float>::quiet_NaN())), solid + 24);
  EXPECT_EQ(refused_at(solid + 36, bits(2e8f)), solid + 24) << "far away";
  EXPECT_EQ(refused_at(solid + 76, 4), solid) << "name";
}

TEST(SolidsSection, NoWordOfItCanDoHarm) {
  const RomImage good = rom_of(kThree);
  const auto data = DrawingData::open(good.bytes());
  ASSERT_TRUE(data.ok());
  const auto begin = static_cast<std::uint32_t>(
      reinterpret_cast<const std::byte*>(data->solids().candidates.data()) - good.bytes().data() - 72);
  const std::uint32_t bytes = 72 + 18 * 12 + 3 * 84;
  std::mt19937 random(5);
  std::vector<std::byte> memory(1 << 20);
  int made = 0;
  for (int i = 0; i < 3000; ++i) {
    RomImage rom = good;
    rom[begin + random() % (bytes / 4) * 4] =
        i % 3 == 0 ? static_cast<std::uint32_t>(random()) : (i % 3 == 1 ? 1u << random() % 32 : rom[begin + 8] + 1);
    testing::seal(rom);
    const auto opened = DrawingData::open(rom.bytes());
    if (!opened.ok()) continue;
    Arena arena(memory);
    firmware::SolidMembers members;
    if (!members.begin(opened->solids(), arena).ok()) continue;
    ++made;
    for (std::uint32_t n = 0; n < members.count(); ++n)
      for (const auto member : {firmware::Member::kHigh, firmware::Member::kLow, firmware::Member::kRough}) {
        const auto drawn = members.choose(n, member, {1, 2, 3});
        ASSERT_LE(std::size_t{drawn.first_index} + drawn.index_count, members.indices().size());
        ASSERT_LE(std::size_t{drawn.first_vertex} + drawn.vertex_count, members.positions().size());
        for (std::uint32_t c = 0; c < drawn.index_count; ++c)
          ASSERT_LT(members.indices()[drawn.first_index + c], drawn.vertex_count);
        for (std::uint32_t v = 0; v < drawn.vertex_count; ++v)
          ASSERT_TRUE(is_finite(members.positions()[drawn.first_vertex + v]));
      }
  }
  EXPECT_GT(made, 100);
}

}  // namespace
}  // namespace usuzumi
