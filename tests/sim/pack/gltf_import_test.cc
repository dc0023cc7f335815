// glTF 2.0 by way of load_model: small files, expectations worked out by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "sim/common/error.h"
#include "sim/pack/load_model.h"
#include "tests/sim/pack/support.h"

namespace usuzumi {
namespace {

using sim::Error;
using sim::ExitCode;
using sim::load_model;
using sim::Mesh;
using sim::Model;
using ::testing::AllOf;
using testing::face_corners;
using testing::faces_of;
using testing::GltfBuilder;
using ::testing::HasSubstr;
using testing::json;
using ::testing::Not;
using testing::one_triangle;
using testing::TempFolder;

Model load(const GltfBuilder& gltf) {
  TempFolder folder;
  return load_model(folder.write("model.gltf", gltf.text()));
}

/// The error line of a file that must be refused.
std::string refusal(const std::string& text, const std::string& name = "model.gltf") {
  TempFolder folder;
  const std::string path = folder.write(name, text);
  try {
    load_model(path);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kBadInput);
    const std::string line = e.what();
    EXPECT_THAT(line, HasSubstr(path)) << "the line does not say where";
    EXPECT_THAT(line, Not(HasSubstr("\n")));
    return line;
  }
  ADD_FAILURE() << "was not refused";
  return "";
}
std::string refusal(const GltfBuilder& gltf) { return refusal(gltf.text()); }

std::vector<Vec3> sorted(std::vector<Vec3> v) {
  std::sort(v.begin(), v.end(), [](Vec3 a, Vec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  return v;
}

TEST(GltfImport, ReadsNamesPositionsAndFacesOfBothContainers) {
  TempFolder folder;
  const GltfBuilder gltf = one_triangle();
  for (const std::string& path : {folder.write("a.gltf", gltf.text()), folder.write("a.glb", gltf.glb())}) {
    const Model model = load_model(path);
    ASSERT_EQ(model.meshes.size(), 1u);
    EXPECT_EQ(model.meshes[0].name, "plate");
    EXPECT_EQ(model.meshes[0].node_name, "Plate");
    EXPECT_EQ(faces_of(model.meshes[0]), std::multiset{face_corners({0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
    EXPECT_FALSE(model.meshes[0].tags.any());
  }
}

TEST(GltfImport, ReadsBuffersFromFilesBesideWithEscapedNamesAndSlackAtTheEnd) {
  TempFolder folder;
  const float xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  folder.write("my data.bin", std::string(reinterpret_cast<const char*>(xyz), sizeof xyz) + "slack");
  GltfBuilder gltf = one_triangle();
  gltf.document["buffers"] = json::array({{{"byteLength", 36}, {"uri", "my%20data.bin"}}});
  EXPECT_EQ(load_model(folder.write("a.gltf", gltf.text())).meshes[0].face_count(), 1u);
}

TEST(GltfImport, AppliesTranslationRotationAndScaleInThatOrderDownTheTree) {
  GltfBuilder gltf = one_triangle();
  // The child doubles x, then turns +90 degrees about z ((x y) becomes (-y x)), then moves by (0 0 1); the parent moves
  // by (10 0 0).
  const double half = std::sqrt(0.5);
  gltf.document["nodes"][0]["scale"] = {2, 1, 1};
  gltf.document["nodes"][0]["rotation"] = {0, 0, half, half};
  gltf.document["nodes"][0]["translation"] = {0, 0, 1};
  gltf.document["nodes"].push_back({{"children", {0}}, {"translation", {10, 0, 0}}});
  gltf.document["scenes"][0]["nodes"] = {1};
  const Mesh mesh = load(gltf).meshes[0];
  const std::vector<Vec3> got = sorted(mesh.positions);
  // (0 0 0) -> (10 0 1); (1 0 0) -> (2 0 0) -> (0 2 0) -> (10 2 1); (0 1 0) -> (-1 0 0) -> (9 0 1).
  const std::vector<Vec3> want{{9, 0, 1}, {10, 0, 1}, {10, 2, 1}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(got[i].x, want[i].x, 1e-6f);
    EXPECT_NEAR(got[i].y, want[i].y, 1e-6f);
    EXPECT_NEAR(got[i].z, want[i].z, 1e-6f);
  }
}

TEST(GltfImport, ReadsMatricesColumnByColumn) {
  GltfBuilder gltf = one_triangle();
  gltf.document["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
  EXPECT_EQ(faces_of(load(gltf).meshes[0]), std::multiset{face_corners({5, 6, 7}, {6, 6, 7}, {5, 7, 7})});
}

TEST(GltfImport, MirroringNodeTurnsTheWindingRoundAndMirrorsNormals) {
  GltfBuilder gltf;
  const int p = gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const int n = gltf.positions({0.6f, 0, 0.8f, 0.6f, 0, 0.8f, 0.6f, 0, 0.8f});
  gltf.node({{"mesh", gltf.mesh({{"attributes", {{"POSITION", p}, {"NORMAL", n}}}})}, {"scale", {-1, 1, 1}}});
  const Mesh mesh = load(gltf).meshes[0];
  // The mirrored corners are (0 0 0) (-1 0 0) (0 1 0); seen from +z, outside, they run counter-clockwise the other way.
  EXPECT_EQ(faces_of(mesh), std::multiset{face_corners({0, 0, 0}, {0, 1, 0}, {-1, 0, 0})});
  EXPECT_NEAR(mesh.normals[0].x, -0.6f, 1e-6f);
  EXPECT_NEAR(mesh.normals[0].z, 0.8f, 1e-6f);
}

TEST(GltfImport, NormalsFollowTheInverseTransposeUnderUnevenScale) {
  GltfBuilder gltf;
  const int p = gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const float s = std::sqrt(0.5f);
  const int n = gltf.positions({s, 0, s, s, 0, s, s, 0, s});
  gltf.node({{"mesh", gltf.mesh({{"attributes", {{"POSITION", p}, {"NORMAL", n}}}})}, {"scale", {2, 1, 1}}});
  // (1 0 1) times (1/2 1 1) is (0.5 0 1), of length sqrt(1.25).
  const Vec3 normal = load(gltf).meshes[0].normals[0];
  EXPECT_NEAR(normal.x, 0.5 / std::sqrt(1.25), 1e-6);
  EXPECT_NEAR(normal.z, 1.0 / std::sqrt(1.25), 1e-6);
}

TEST(GltfImport, TakesStripsAndFansApartWithTheirWinding) {
  // A square 0 1 / 2 3 as strip 0 1 2 3 and as fan 0 1 3 2: both are faces 0-1-2 … counter-clockwise from +z.
  const std::vector<float> square{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  GltfBuilder strip;
  int p = strip.positions(square);
  strip.node({{"mesh", strip.mesh({{"attributes", {{"POSITION", p}}}, {"mode", 5}})}});
  EXPECT_EQ(faces_of(load(strip).meshes[0]), (std::multiset{face_corners({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                                                            face_corners({1, 0, 0}, {1, 1, 0}, {0, 1, 0})}));
  GltfBuilder fan;
  p = fan.positions(square);
  const int i = fan.indices({0, 1, 3, 2});
  fan.node({{"mesh", fan.mesh({{"attributes", {{"POSITION", p}}}, {"mode", 6}, {"indices", i}})}});
  EXPECT_EQ(faces_of(load(fan).meshes[0]), (std::multiset{face_corners({0, 0, 0}, {1, 0, 0}, {1, 1, 0}),
                                                          face_corners({0, 0, 0}, {1, 1, 0}, {0, 1, 0})}));
}

TEST(GltfImport, SaysThatPointsAndLinesAreLeftOut) {
  GltfBuilder gltf = one_triangle();
  gltf.document["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
  const Model model = load(gltf);
  EXPECT_EQ(model.meshes.size(), 1u);
  EXPECT_THAT(model.notes, ::testing::Contains(AllOf(HasSubstr("mesh 'plate' primitive 1"), HasSubstr("left out"))));
}

TEST(GltfImport, ReadsNormalizedAndSparseAndBufferlessAccessors) {
  GltfBuilder gltf;
  // Signed shorts: 32767 is 1, -32768 is clamped to -1. No padding: 4 components would be needed, so a stride of 8 is
  // said.
  const std::vector<std::int16_t> shorts{0, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0};
  const int quantized = gltf.accessor(shorts, 5122, "VEC3", 4);
  gltf.document["accessors"][0]["normalized"] = true;
  gltf.document["bufferViews"][0]["byteStride"] = 8;
  gltf.document["accessors"][0]["count"] = 3;
  gltf.node({{"mesh", gltf.mesh({{"attributes", {{"POSITION", quantized}}}}, "quantized")}});
  // All zeros but vertices 1 and 2, which the sparse part replaces.
  const std::vector<std::uint16_t> which{1, 2};
  const std::vector<float> values{3, 0, 0, 0, 4, 0};
  const int wi = gltf.view(std::as_bytes(std::span(which))), vi = gltf.view(std::as_bytes(std::span(values)));
  gltf.document["accessors"].push_back(
      {{"componentType", 5126},
       {"type", "VEC3"},
       {"count", 3},
       {"sparse",
        {{"count", 2}, {"indices", {{"bufferView", wi}, {"componentType", 5123}}}, {"values", {{"bufferView", vi}}}}}});
  gltf.node({{"mesh", gltf.mesh({{"attributes", {{"POSITION", 1}}}}, "sparse")}});
  const Model model = load(gltf);
  EXPECT_EQ(faces_of(model.meshes[0]), std::multiset{face_corners({0, 0, 0}, {1, 0, 0}, {0, -1, 0})});
  EXPECT_EQ(faces_of(model.meshes[1]), std::multiset{face_corners({0, 0, 0}, {3, 0, 0}, {0, 4, 0})});
}

TEST(GltfImport, EncodesLinearColoursForTheDisplay) {
  // The sRGB code of linear 0.5 is 188 (187.52), of 0.25 137 (136.96), of 0.002 (straight part: 0.02584 * 255) 7
  // (6.59).
  GltfBuilder gltf = one_triangle();
  gltf.document["materials"] =
      json::array({{{"doubleSided", true}, {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.002, 1, 0.5}}}}}});
  gltf.document["meshes"][0]["primitives"][0]["material"] = 0;
  const Mesh plain = load(gltf).meshes[0];
  EXPECT_EQ(plain.base_colour, rgba8(188, 7, 255, 128));
  EXPECT_TRUE(plain.colours.empty());
  EXPECT_TRUE(plain.two_sided);
  // Vertex colours, here bytes, are multiplied by the factor in linear light: 0.5 * 0.5 = 0.25.
  const std::vector<std::uint8_t> rgba{255, 255, 255, 255, 255, 255, 255, 255, 0, 0, 0, 255};
  const int c = gltf.accessor(rgba, 5121, "VEC4", 4);
  gltf.document["accessors"][static_cast<std::size_t>(c)]["normalized"] = true;
  gltf.document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = c;
  gltf.document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.25, 1, 1, 1};
  const Mesh painted = load(gltf).meshes[0];
  ASSERT_EQ(painted.colours.size(), 3u);
  EXPECT_THAT(painted.colours,
              ::testing::UnorderedElementsAre(rgba8(137, 255, 255), rgba8(137, 255, 255), rgba8(0, 0, 0)));
}

TEST(GltfImport, EachPrimitiveOfEachPlacementIsAMeshWithANameOfItsOwn) {
  GltfBuilder gltf = one_triangle();
  gltf.document["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}});
  gltf.node({{"name", "Second"}, {"mesh", 0}, {"translation", {0, 0, 5}}});
  const Model model = load(gltf);
  std::vector<std::string> names;
  for (const Mesh& mesh : model.meshes) names.push_back(mesh.name);
  EXPECT_EQ(names, (std::vector<std::string>{"plate", "plate#2", "plate#3", "plate#4"}));
  EXPECT_EQ(model.meshes[2].node_name, "Second");
  EXPECT_EQ(model.meshes[2].positions[0].z, 5);
}

TEST(GltfImport, NamesNamelessMeshesAfterTheirNodeOrTheFile) {
  GltfBuilder gltf = one_triangle();
  gltf.document["meshes"][0].erase("name");
  EXPECT_EQ(load(gltf).meshes[0].name, "Plate");
  gltf.document["nodes"][0].erase("name");
  EXPECT_EQ(load(gltf).meshes[0].name, "model");
}

TEST(GltfImport, SaysWhichMeshesTheSceneDoesNotPlace) {
  GltfBuilder gltf = one_triangle();
  gltf.mesh({{"attributes", {{"POSITION", 0}}}}, "spare wheel");
  const Model model = load(gltf);
  EXPECT_EQ(model.meshes.size(), 1u);
  EXPECT_THAT(model.notes, ::testing::Contains(HasSubstr("mesh 'spare wheel' is not placed")));
}

TEST(GltfExtras, OfTheNodeWinOverThoseOfTheMeshKeyByKey) {
  GltfBuilder gltf = one_triangle();
  gltf.document["meshes"][0]["extras"] = {{"thinning_level", 2}, {"face_quota", "12.5%"}, {"telltale", 1}};
  gltf.document["nodes"][0]["extras"] = {{"thinning_level", 3.0}, {"area_threshold_px", 400}, {"author", "somebody"}};
  const sim::Tags tags = load(gltf).meshes[0].tags;
  EXPECT_EQ(tags.level, 3u);
  EXPECT_EQ(tags.quota, (sim::FaceQuota{firmware::format::QuotaKind::kMillionths, 125'000}));
  EXPECT_EQ(tags.area_threshold_px, 400.0f);
  EXPECT_EQ(tags.telltale, true);
}

TEST(GltfExtras, BadValuesAreRefusedWithTheNodesName) {
  for (const json& extras :
       {json{{"thinning_level", 6}}, json{{"thinning_level", 1.5}}, json{{"thinning_level", "high"}},
        json{{"face_quota", 0}}, json{{"face_quota", "101%"}}, json{{"face_quota", "0%"}}, json{{"face_quota", -3}},
        json{{"area_threshold_px", -1}}, json{{"area_threshold_px", "wide"}}, json{{"telltale", 2}},
        json{{"telltale", json::array()}}}) {
    GltfBuilder gltf = one_triangle();
    gltf.document["nodes"][0]["extras"] = extras;
    EXPECT_THAT(refusal(gltf), AllOf(HasSubstr("node 'Plate'"), HasSubstr(extras.begin().key()), HasSubstr("must be")))
        << extras;
  }
}

TEST(GltfExtras, ThatWouldDoNothingAreTold) {
  GltfBuilder gltf = one_triangle();
  gltf.node({{"name", "Group"}, {"extras", {{"thinning_level", 3}}}});
  gltf.document["meshes"][0]["extras"] = {{"thining_level", 3}};
  const Model model = load(gltf);
  EXPECT_FALSE(model.meshes[0].tags.any());
  EXPECT_THAT(model.notes, ::testing::Contains(AllOf(HasSubstr("node 'Group'"), HasSubstr("no mesh"))));
  EXPECT_THAT(model.notes,
              ::testing::Contains(AllOf(HasSubstr("thining_level"), HasSubstr("did you mean thinning_level"))));
}

TEST(GltfRefusal, CompressionSaysHowToExportAgain) {
  for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"}) {
    GltfBuilder gltf = one_triangle();
    gltf.document["extensionsRequired"] = {name};
    EXPECT_THAT(refusal(gltf), AllOf(HasSubstr("compress"), HasSubstr("export it again")));
  }
}

TEST(GltfRefusal, UnknownExtensionsMayBeUsedButNotRequired) {
  GltfBuilder gltf = one_triangle();
  gltf.document["extensionsUsed"] = {"ACME_rocket_fuel"};
  EXPECT_EQ(load(gltf).meshes.size(), 1u);
  gltf.document["extensionsRequired"] = {"ACME_rocket_fuel"};
  EXPECT_THAT(refusal(gltf), HasSubstr("ACME_rocket_fuel"));
  gltf.document["extensionsRequired"] = {"KHR_materials_unlit", "KHR_texture_transform", "KHR_mesh_quantization"};
  EXPECT_EQ(load(gltf).meshes.size(), 1u);
}

TEST(GltfRefusal, MissingBuffersAreRefusedButMissingImagesAreNot) {
  GltfBuilder gltf = one_triangle();
  gltf.document["images"] = json::array({{{"uri", "nowhere.png"}}});
  EXPECT_EQ(load(gltf).meshes.size(), 1u);
  gltf.document["buffers"] = json::array({{{"byteLength", 36}, {"uri", "nowhere.bin"}}});
  EXPECT_THAT(refusal(gltf), AllOf(HasSubstr("nowhere.bin"), HasSubstr("missing")));
}

TEST(GltfRefusal, EveryRangeIsChecked) {
  using Change = void (*)(json&);
  const std::vector<std::pair<const char*, Change>> changes{
      {"accessor number", [](json& d) { d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 7; }},
      {"accessor below zero", [](json& d) { d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = -2; }},
      {"accessor count", [](json& d) { d["accessors"][0]["count"] = 4; }},
      {"accessor count overflow", [](json& d) { d["accessors"][0]["count"] = 1537228672809129302ull; }},
      {"zeros without end",
       [](json& d) {
         d["accessors"][0].erase("bufferView");
         d["accessors"][0]["count"] = 4294967295u;
       }},
      {"accessor offset", [](json& d) { d["accessors"][0]["byteOffset"] = 4; }},
      {"accessor offset overflow", [](json& d) { d["accessors"][0]["byteOffset"] = 18446744073709551612ull; }},
      {"accessor type", [](json& d) { d["accessors"][0]["type"] = "VEC2"; }},
      {"accessor type unknown", [](json& d) { d["accessors"][0]["type"] = "VEC9"; }},
      {"component type", [](json& d) { d["accessors"][0]["componentType"] = 5130; }},
      {"buffer view number", [](json& d) { d["accessors"][0]["bufferView"] = 3; }},
      {"buffer number", [](json& d) { d["bufferViews"][0]["buffer"] = 3; }},
      {"buffer view length", [](json& d) { d["bufferViews"][0]["byteLength"] = 40; }},
      {"buffer view offset", [](json& d) { d["bufferViews"][0]["byteOffset"] = 4; }},
      {"stride", [](json& d) { d["bufferViews"][0]["byteStride"] = 16; }},
      {"stride too small", [](json& d) { d["bufferViews"][0]["byteStride"] = 4; }},
      {"material number", [](json& d) { d["meshes"][0]["primitives"][0]["material"] = 0; }},
      {"mesh number", [](json& d) { d["nodes"][0]["mesh"] = 1; }},
      {"root node number", [](json& d) { d["scenes"][0]["nodes"] = {5}; }},
      {"child node number", [](json& d) { d["nodes"][0]["children"] = {5}; }},
      {"scene number", [](json& d) { d["scene"] = 5; }},
      {"mode", [](json& d) { d["meshes"][0]["primitives"][0]["mode"] = 9; }},
      {"node is its own child", [](json& d) { d["nodes"][0]["children"] = {0}; }},
      {"rotation of three numbers",
       [](json& d) {
         d["nodes"][0]["rotation"] = {0, 0, 1};
       }},
      {"transform not finite",
       [](json& d) {
         d["nodes"][0]["scale"] = {1e308, 1e308, 1e308};
         d["nodes"][0]["translation"] = {1e308, 0, 0};
         d["nodes"].push_back({{"children", {0}}, {"scale", {1e308, 1, 1}}});
         d["scenes"][0]["nodes"] = {1};
       }},
      {"positions beyond single precision",
       [](json& d) {
         d["nodes"][0]["scale"] = {1e39, 1, 1};
       }},
      {"sparse index",
       [](json& d) {
         d["accessors"][0]["sparse"] = {{"count", 1},
                                        {"indices", {{"bufferView", 0}, {"componentType", 5125}, {"byteOffset", 12}}},
                                        {"values", {{"bufferView", 0}}}};
       }},
      {"sparse count",
       [](json& d) {
         d["accessors"][0]["sparse"] = {
             {"count", 9}, {"indices", {{"bufferView", 0}, {"componentType", 5121}}}, {"values", {{"bufferView", 0}}}};
       }},
      {"sparse offset",
       [](json& d) {
         d["accessors"][0]["sparse"] = {{"count", 1},
                                        {"indices", {{"bufferView", 0}, {"componentType", 5121}, {"byteOffset", -4}}},
                                        {"values", {{"bufferView", 0}}}};
       }},
  };
  for (const auto& [name, change] : changes) {
    SCOPED_TRACE(name);
    GltfBuilder gltf = one_triangle();
    change(gltf.document);
    EXPECT_THAT(refusal(gltf), Not(HasSubstr("crashed")));
  }
}

TEST(GltfRefusal, IndicesBeyondTheVerticesAreNamed) {
  GltfBuilder gltf;
  const int p = gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0}), i = gltf.indices({0, 1, 3});
  gltf.node({{"mesh", gltf.mesh({{"attributes", {{"POSITION", p}}}, {"indices", i}}, "plate")}});
  EXPECT_THAT(refusal(gltf), AllOf(HasSubstr("'plate'"), HasSubstr("vertex 3 of 3")));
}

TEST(GltfRefusal, CoordinatesThatAreNoNumbersAreNamed) {
  for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    GltfBuilder gltf;
    const int p = gltf.positions({0, 0, 0, 1, 0, 0, 0, bad, 0});
    gltf.node({{"mesh", gltf.mesh({{"attributes", {{"POSITION", p}}}}, "plate")}});
    EXPECT_THAT(refusal(gltf), AllOf(HasSubstr("'plate'"), HasSubstr("vertex 2")));
  }
}

TEST(GltfRefusal, FilesThatAreNoGltfAreRefused) {
  refusal("");
  refusal("{");
  refusal("[]");
  refusal("{}");
  EXPECT_THAT(refusal(R"({"asset": {"version": "3.0"}})"), HasSubstr("3.0"));
  EXPECT_THAT(refusal(std::string(100'000, '[')), Not(HasSubstr("crashed")));
  std::string deep = R"({"asset": {"version": "2.0", "extras": )";
  for (int i = 0; i < 100'000; ++i) deep += "[";
  for (int i = 0; i < 100'000; ++i) deep += "]";
  EXPECT_THAT(refusal(deep + "}}"), HasSubstr("nested"));
}

TEST(GltfRefusal, EveryPrefixOfABinaryFileIsRefused) {
  const std::string glb = one_triangle().glb();
  for (std::size_t n = 0; n < glb.size(); n += n < 64 ? 1 : 37) {
    SCOPED_TRACE(n);
    EXPECT_THAT(refusal(glb.substr(0, n), "model.glb"), Not(HasSubstr("crashed")));
  }
}

}  // namespace
}  // namespace usuzumi
