// Every model that Debian's assimp-testmodels ships, broken ones included, and the two that the demo draws.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <fstream>
#include <iterator>

#include "sim/pack/method_settings.h"
#include "tests/sim/pack/support.h"

namespace usuzumi {
namespace {

namespace fs = std::filesystem;
using firmware::DrawingData;
using testing::bytes_of_file;
using testing::CommandResult;
using testing::json;
using testing::run_usuzumi;
using testing::TempFolder;

const char* const kFolders[] = {"/usr/share/assimp/models", "/usr/share/assimp/models-nonbsd"};
const std::string kEngine = "/usr/share/assimp/models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb";
const std::string kTruck = "/usr/share/assimp/models/glTF/CesiumMilkTruck/CesiumMilkTruck.gltf";

std::vector<std::string> model_files() {
  static const std::set<std::string> kExtensions{".gltf", ".glb", ".obj", ".ply", ".stl", ".off", ".dae", ".ac"};
  std::vector<std::string> files;
  for (const char* folder : kFolders) {
    if (!fs::exists(folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      std::string extension = entry.path().extension().string();
      std::transform(extension.begin(), extension.end(), extension.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      if (entry.is_regular_file() && kExtensions.contains(extension)) files.push_back(entry.path().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

// A skipped test would count as passed; sim/install.sh brings the models.
#define ASSERT_IS_HERE(path) ASSERT_TRUE(fs::exists(path)) << path << " is not here: install assimp-testmodels"

// With layers, by the four methods in turn.
TEST(RealModels, EachGivesASoundRomOrOneClearLine) {
  ASSERT_IS_HERE(kFolders[0]);
  const std::vector<std::string> files = model_files();
  EXPECT_GE(files.size(), 100u);
  std::size_t sound = 0, tried = 0;
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    TempFolder folder;
    const std::string method(sim::kMethodNames[tried++ % sim::kMethodNames.size()]);
    const CommandResult result =
        run_usuzumi({"pack", file, "-o", folder / "out.rom", "--time-limit", "60", "--default-level", "3", "--method",
                     "*=" + method, "--layers", "100,60,20"});
    if (result.exit_code == 0) {
      ++sound;
      const std::vector<std::byte> rom = bytes_of_file(folder / "out.rom");
      const auto opened = DrawingData::open(rom);
      ASSERT_TRUE(opened.ok()) << opened.status().message << " " << opened.status().where;
      for (std::uint32_t n = 0; n < opened->mesh_max(); ++n) {
        EXPECT_GT(opened->mesh(n).face_count(), 0u);
        EXPECT_EQ(opened->mesh(n).normals.size(), opened->mesh(n).positions.size());
        EXPECT_FALSE(opened->mesh(n).name.empty());
        EXPECT_FALSE(opened->mesh(n).layers.empty()) << n << " by " << method;
      }
      continue;
    }
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_TRUE(folder.files().empty());
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, ::testing::HasSubstr(file));
    EXPECT_THAT(result.err, ::testing::Not(::testing::HasSubstr("--time-limit")));
  }
  RecordProperty("files", static_cast<int>(files.size()));
  RecordProperty("sound", static_cast<int>(sound));
  EXPECT_GE(sound, 90u) << "many of these files are good";
}

TEST(RealModels, BareRomsDrawTheSameFaces) {
  ASSERT_IS_HERE(kTruck);
  TempFolder folder;
  ASSERT_EQ(run_usuzumi({"pack", kTruck, "-o", folder / "container.rom"}).exit_code, 0);
  ASSERT_EQ(run_usuzumi({"pack", kTruck, "-o", folder / "bare.rom", "--bare"}).exit_code, 0);
  const auto container_bytes = bytes_of_file(folder / "container.rom"), bare_bytes = bytes_of_file(folder / "bare.rom");
  const auto container = DrawingData::open(container_bytes), bare = DrawingData::open(bare_bytes);
  ASSERT_TRUE(container.ok() && bare.ok());
  ASSERT_EQ(container->mesh_max(), bare->mesh_max());
  for (std::uint32_t n = 0; n < bare->mesh_max(); ++n)
    EXPECT_EQ(testing::faces_of(bare->mesh(n)), testing::faces_of(container->mesh(n)));
}

/// An independent reading of a .glb's geometry, straight from its JSON and binary chunk.
struct PlainGlb {
  json document;
  std::string binary;

  explicit PlainGlb(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    const std::string all{std::istreambuf_iterator<char>(in), {}};
    std::uint32_t json_bytes = 0;
    std::memcpy(&json_bytes, all.data() + 12, 4);
    document = json::parse(all.substr(20, json_bytes));
    binary = all.substr(20 + json_bytes + 8);
  }
  std::size_t offset(const json& accessor, std::size_t element, std::size_t packed_bytes) const {
    const json& view = document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    return view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0}) +
           element * view.value("byteStride", packed_bytes);
  }
  /// Vertex number of corner `i` (all of this file's indices are unsigned shorts).
  std::uint16_t index(const json& accessor, std::size_t i) const {
    std::uint16_t v = 0;
    std::memcpy(&v, binary.data() + offset(accessor, i, 2), 2);
    return v;
  }
  std::array<float, 3> position(const json& accessor, std::size_t v) const {
    std::array<float, 3> p{};
    std::memcpy(p.data(), binary.data() + offset(accessor, v, 12), 12);
    return p;
  }
};

TEST(RealModels, EngineHasTheMeshesAndFacesThatItsJsonCounts) {
  ASSERT_IS_HERE(kEngine);
  const PlainGlb glb(kEngine);
  // Per mesh of the file: faces by accessor counts, and those of them whose corners are at three places.
  std::vector<std::size_t> counted, with_area;
  for (const json& mesh : glb.document["meshes"]) {
    std::size_t all = 0, real = 0;
    for (const json& primitive : mesh["primitives"]) {
      const json& order = glb.document["accessors"][primitive["indices"].get<std::size_t>()];
      const json& positions = glb.document["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
      ASSERT_EQ(order["componentType"], 5123);
      for (std::size_t i = 0; i < order["count"].get<std::size_t>(); i += 3) {
        const auto a = glb.position(positions, glb.index(order, i)),
                   b = glb.position(positions, glb.index(order, i + 1)),
                   c = glb.position(positions, glb.index(order, i + 2));
        ++all;
        real += a != b && b != c && c != a ? 1u : 0u;
      }
    }
    counted.push_back(all);
    with_area.push_back(real);
  }
  std::size_t meshes = 0, faces = 0, real_faces = 0;
  for (const json& node : glb.document["nodes"]) {  // all nodes hang below the scene's one root
    if (!node.contains("mesh")) continue;
    const std::size_t m = node["mesh"];
    meshes += glb.document["meshes"][m]["primitives"].size();
    faces += counted[m];
    real_faces += with_area[m];
  }
  TempFolder folder;
  ASSERT_EQ(run_usuzumi({"pack", kEngine, "-o", folder / "out.rom"}).exit_code, 0);
  const json report = json::parse(run_usuzumi({"inspect", folder / "out.rom", "--json"}).out);
  EXPECT_EQ(report["mesh_max"], meshes);
  EXPECT_EQ(report["faces"], real_faces);
  EXPECT_EQ(meshes, 115u);
  EXPECT_EQ(faces, 121'496u);
  EXPECT_EQ(real_faces, 110'336u);
}

TEST(RealModels, TruckHasTheMeshesFacesAndNamesOfItsJson) {
  ASSERT_IS_HERE(kTruck);
  std::ifstream in(kTruck);
  const json document = json::parse(in);
  std::size_t meshes = 0, faces = 0;
  for (const auto& [id, node] : document["nodes"].items())
    for (const json& mesh : node.value("meshes", json::array()))
      for (const json& primitive : document["meshes"][mesh.get<std::string>()]["primitives"]) {
        ++meshes;
        faces += document["accessors"][primitive["indices"].get<std::string>()]["count"].get<std::size_t>() / 3;
      }
  TempFolder folder;
  ASSERT_EQ(run_usuzumi({"pack", kTruck, "-o", folder / "out.rom"}).exit_code, 0);
  const json report = json::parse(run_usuzumi({"inspect", folder / "out.rom", "--json"}).out);
  EXPECT_EQ(report["mesh_max"], meshes);
  EXPECT_EQ(report["faces"], faces);
  EXPECT_EQ(meshes, 5u);
  std::multiset<std::string> names;
  for (const json& mesh : report["meshes"]) names.insert(mesh["name"]);
  EXPECT_EQ(names, (std::multiset<std::string>{"Cesium_Milk_Truck", "Cesium_Milk_Truck#2", "Cesium_Milk_Truck#3",
                                               "Wheels", "Wheels#2"}));
  // The wheels' nodes move them by +1.43267 and -1.35233 in x; a wheel pair is symmetric about its own origin.
  for (const json& mesh : report["meshes"]) {
    if (mesh["name"].get<std::string>().substr(0, 6) != "Wheels") continue;
    const double middle =
        (mesh["bounding_box"]["min"][0].get<double>() + mesh["bounding_box"]["max"][0].get<double>()) / 2;
    EXPECT_TRUE(std::abs(middle - 1.43267) < 0.1 || std::abs(middle + 1.35233) < 0.1) << middle;
  }
}

}  // namespace
}  // namespace usuzumi
