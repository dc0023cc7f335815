// Chains of layers on their way into ROM: what each layer is, who may ask for them, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "firmware/drawing_data/mesh_layers.h"
#include "firmware/layers/layer_chain_builder.h"
#include "firmware/layers/middle_layer.h"
#include "hal/crc32.h"
#include "tests/sim/pack/pictures.h"
#include "tests/sim/pack/support.h"
#include "tests/support/seen_faces.h"

namespace usuzumi {
namespace {

using firmware::DrawingData;
using firmware::LayerChainView;
using firmware::MeshView;
using firmware::Method;
using ::testing::AllOf;
using testing::GltfBuilder;
using ::testing::HasSubstr;
using testing::json;
using ::testing::Not;
using testing::run_usuzumi;
using testing::TempFolder;

/// The rows from `first` to `end` of a sphere of 10 rows and 14 columns, slightly uneven, its pole's row open:
/// positions in one accessor, coordinates that part along one meridian in another.
struct Zone {
  std::vector<float> positions, normals, coordinates;
  std::vector<std::uint16_t> indices;
};
Zone zone(std::uint16_t first, std::uint16_t end) {
  constexpr std::uint16_t kRows = 10, kColumns = 14;
  Zone z;
  for (std::uint16_t r = first; r <= end; ++r)
    for (std::uint16_t c = 0; c <= kColumns; ++c) {
      const float polar = std::numbers::pi_v<float> * (static_cast<float>(r) + 0.5f) / (kRows + 1);
      const float around = 2 * std::numbers::pi_v<float> * static_cast<float>(c % kColumns) / kColumns;
      const float radius = 1 + 0.05f * std::sin(3 * around) * std::sin(2 * polar);
      const std::array<float, 3> n{std::sin(polar) * std::cos(around), std::cos(polar),
                                   -std::sin(polar) * std::sin(around)};
      for (float v : n) {
        z.positions.push_back(v * radius);
        z.normals.push_back(v);
      }
      z.coordinates.push_back(static_cast<float>(c) / kColumns);
      z.coordinates.push_back(static_cast<float>(r) / kRows);
    }
  for (std::uint16_t r = 0; r < end - first; ++r)
    for (std::uint16_t c = 0; c < kColumns; ++c) {
      const auto a = static_cast<std::uint16_t>(r * (kColumns + 1) + c), b = static_cast<std::uint16_t>(a + 1),
                 d = static_cast<std::uint16_t>(a + kColumns + 1), e = static_cast<std::uint16_t>(d + 1);
      for (std::uint16_t v : {a, d, b, b, d, e}) z.indices.push_back(v);
    }
  return z;
}

json primitive(GltfBuilder& b, const Zone& z, int material) {
  const int p = b.positions(z.positions), n = b.accessor(z.normals, 5126, "VEC3", 3),
            t = b.accessor(z.coordinates, 5126, "VEC2", 2);
  return {{"attributes", {{"POSITION", p}, {"NORMAL", n}, {"TEXCOORD_0", t}}},
          {"indices", b.indices(z.indices)},
          {"material", material}};
}

/// "ball": its north has a texture, its south another colour; as the primitives of one mesh.
GltfBuilder ball() {
  GltfBuilder b;
  const std::string png = testing::png_file(1, 1, {rgba8(255, 0, 0)});
  b.document["images"] =
      json::array({{{"uri", "data:image/png;base64," + testing::base64(std::as_bytes(std::span(png)))}}});
  b.document["textures"] = json::array({{{"source", 0}}});
  b.document["materials"] =
      json::array({{{"name", "map"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}},
                   {{"name", "sea"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 1, 1}}}}}});
  const int mesh = b.mesh(primitive(b, zone(0, 5), 0), "ball");
  b.document["meshes"][0]["primitives"].push_back(primitive(b, zone(5, 10), 1));
  b.node({{"name", "Ball"}, {"mesh", mesh}});
  return b;
}

using Corner = testing::SeenCorner;
using Face = std::array<Corner, 3>;
using testing::add_face;
using testing::corner_of;

template <class Streams>
Corner corner_at(const Streams& of, std::uint32_t v) {
  return corner_of(of.positions[v], of.normals[v], of.colours.empty() ? Rgba8{} : of.colours[v],
                   of.texture_coordinates.empty() ? TexCoord{} : of.texture_coordinates[v]);
}

/// The faces of each group.
using Picture = std::vector<testing::SeenFaceSet>;

/// The mesh thinned by its own method at once, without a chain.
Picture thinned(const MeshView& mesh, std::uint32_t target) {
  std::vector<Vec3> positions(mesh.positions.begin(), mesh.positions.end());
  std::vector<PackedNormal> normals(mesh.normals.begin(), mesh.normals.end());
  std::vector<Rgba8> colours(mesh.colours.begin(), mesh.colours.end());
  std::vector<TexCoord> coordinates(mesh.texture_coordinates.begin(), mesh.texture_coordinates.end());
  std::vector<firmware::MaterialGroup> groups;
  for (const auto& group : mesh.groups) groups.push_back({group.face_end, group.vertex_end});
  std::vector<std::uint32_t> indices;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    std::uint32_t v[3];
    mesh.face(f, v);
    indices.insert(indices.end(), v, v + 3);
  }
  firmware::WorkingMesh work;
  work.positions = positions;
  work.normals = normals;
  work.colours = colours;
  work.texture_coordinates = coordinates;
  work.edge_values = mesh.edge_values;
  work.groups = groups;
  work.indices = indices;
  work.vertex_count = static_cast<std::uint32_t>(positions.size());
  work.face_count = mesh.face_count();
  std::vector<std::byte> memory(8u << 20);
  Arena arena(memory);
  firmware::SimplifyOptions options;
  options.target_faces = target;
  options.method = mesh.method;
  options.edge_removal = mesh.edge_removal();
  options.vertex_deletion = mesh.vertex_deletion();
  options.for_layers = true;
  EXPECT_TRUE(firmware::simplify(work, options, arena).ok());
  Picture picture(mesh.group_count());
  for (std::uint32_t f = 0, g = 0; f < work.face_count; ++f) {
    while (!groups.empty() && f >= groups[g].face_end) ++g;
    add_face(picture[g], {corner_at(work, indices[3 * f]), corner_at(work, indices[3 * f + 1]),
                          corner_at(work, indices[3 * f + 2])});
  }
  return picture;
}

/// A layer of the chain that lies in ROM, by replaying it.
Picture replayed(const MeshView& mesh, std::uint32_t step) {
  const LayerChainView chain = LayerChainView::of_checked(mesh.layers);
  const std::size_t store = chain.store_count();
  std::vector<Vec3> positions(store);
  std::vector<PackedNormal> normals(store);
  std::vector<Rgba8> colours(mesh.colours.empty() ? 0 : store);
  std::vector<TexCoord> coordinates(mesh.texture_coordinates.empty() ? 0 : store);
  firmware::write_store(chain, {mesh.positions, mesh.normals, mesh.colours, mesh.texture_coordinates},
                        {positions, normals, colours, coordinates});
  const firmware::VertexStreams streams{positions, normals, colours, coordinates};
  std::vector<std::uint32_t> indices(std::size_t{3} * chain.face_count()), live(chain.group_count());
  firmware::LayerReplay replay(chain, std::as_writable_bytes(std::span(indices)), 4, live);
  firmware::begin_replay(mesh, replay);
  EXPECT_TRUE(replay.check().ok());
  replay.go_to(step);
  Picture picture(mesh.group_count());
  for (std::uint32_t g = 0; g < chain.group_count(); ++g)
    for (std::uint32_t slot = chain.group_begin(g); slot < chain.group_begin(g) + live[g]; ++slot)
      add_face(picture[g], {corner_at(streams, indices[3 * slot]), corner_at(streams, indices[3 * slot + 1]),
                            corner_at(streams, indices[3 * slot + 2])});
  return picture;
}

class Layers : public ::testing::Test {
 protected:
  testing::CommandResult pack(std::vector<std::string> options) {
    options.insert(options.begin(), {"pack", folder_.write("ball.gltf", ball().text()), "-o", rom_file()});
    return run_usuzumi(options);
  }
  std::string rom_file() const { return folder_ / "ball.rom"; }
  DrawingData data() {
    rom_ = testing::bytes_of_file(rom_file());
    const auto opened = DrawingData::open(rom_);
    EXPECT_TRUE(opened.ok()) << opened.status().message;
    return *opened;
  }
  json inspected() { return json::parse(run_usuzumi({"inspect", rom_file(), "--json"}).out); }
  /// The quotas of each mesh's layers; null where it has none.
  json quotas() {
    json all = json::array();
    const json report = inspected();
    for (const json& mesh : report["meshes"]) {
      json one = mesh["layers"].is_null() ? json() : json::array();
      if (!one.is_null())
        for (const json& layer : mesh["layers"]["layers"]) one.push_back(layer["quota"]);
      all.push_back(one);
    }
    return all;
  }
  std::string refused(std::vector<std::string> options, int code) {
    std::filesystem::remove(rom_file());
    const auto result = pack(std::move(options));
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(std::filesystem::exists(rom_file()));
    return result.err;
  }
  std::string sidecar(const json& properties) {
    return folder_.write("s.json", json{{"meshes", {{"ball", properties}}}}.dump());
  }

  TempFolder folder_;
  std::vector<std::byte> rom_;
};

class LayersOf : public Layers, public ::testing::WithParamInterface<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, LayersOf,
                         ::testing::Values(Method::kQem, Method::kEdgeRemoval, Method::kHalfEdge,
                                           Method::kVertexDeletion));

TEST_P(LayersOf, EachIsWhatItsMethodMakesAtOnceAlsoWithSettingsAndMaterials) {
  constexpr const char* kMethods[] = {"qem", "edge-removal", "half-edge", "vertex-deletion"};
  json properties = {{"thinning_level", 3}, {"method", kMethods[static_cast<std::size_t>(GetParam())]}};
  if (GetParam() == Method::kEdgeRemoval) {
    properties["method_settings"] = {{"a", 0.5}, {"b", 2}};
    properties["regions"] = json::array({{{"material", "sea"}, {"value", 3}}});
  }
  if (GetParam() == Method::kVertexDeletion) properties["method_settings"] = {{"preset", "curved"}};
  for (const bool join : {false, true}) {
    std::vector<std::string> options{"--sidecar", sidecar(properties), "--layers", "100,80,60,45"};
    if (join) options.insert(options.end(), {"--join", "ball"});
    const auto packed = pack(options);
    ASSERT_EQ(packed.exit_code, 0) << packed.err;
    const DrawingData rom = data();
    ASSERT_EQ(rom.mesh_max(), join ? 1u : 2u);
    rom.for_each_mesh([&](const MeshView& mesh) {
      ASSERT_FALSE(mesh.layers.empty());
      const LayerChainView chain = LayerChainView::of_checked(mesh.layers);
      EXPECT_EQ(chain.header().method, static_cast<std::uint32_t>(GetParam()));
      ASSERT_EQ(chain.layer_count(), 4u) << mesh.number;
      for (const auto& layer : chain.layers()) {
        const std::uint32_t target = firmware::layer_faces(mesh.face_count(), layer.quota_millionths);
        EXPECT_LE(layer.faces, target);
        const Picture alone = thinned(mesh, target), from_rom = replayed(mesh, layer.step);
        for (std::size_t g = 0; g < alone.size(); ++g) {
          EXPECT_EQ(alone[g].size(), from_rom[g].size()) << layer.faces << " faces, group " << g;
          EXPECT_TRUE(alone[g] == from_rom[g]) << layer.faces << " faces, group " << g;
        }
      }
    });
  }
}

TEST_F(Layers, OptionWinsOverSidecarOverNodeOverMesh) {
  GltfBuilder b = ball();
  b.document["meshes"][0]["extras"] = {{"thinning_level", 3}, {"layers", {100, 90}}};
  const auto packed = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"pack", folder_.write("x.gltf", b.text()), "-o", rom_file()});
    const auto result = run_usuzumi(options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return quotas();
  };
  EXPECT_EQ(packed({}), json::array({{"100%", "90%"}, {"100%", "90%"}}));
  b.document["nodes"][0]["extras"] = {{"layers", "100, 70.5"}};
  EXPECT_EQ(packed({}), json::array({{"100%", "70.5%"}, {"100%", "70.5%"}}));
  const std::string file = sidecar({{"layers", "[100, 60]"}});
  EXPECT_EQ(packed({"--sidecar", file}), json::array({{"100%", "60%"}, {"100%", "60%"}}));
  EXPECT_EQ(packed({"--sidecar", file, "--layers", "ball#2=100%,50%"}),
            json::array({{"100%", "60%"}, {"100%", "50%"}}));
  EXPECT_EQ(packed({"--sidecar", file, "--layers", "100,55", "--layers", "ball#2=100,50"}),
            json::array({{"100%", "55%"}, {"100%", "50%"}}));
  EXPECT_EQ(packed({"--layers", "ball#2=100,50", "--layers", "100,55"}),
            json::array({{"100%", "55%"}, {"100%", "55%"}}))
      << "the later counts";
}

TEST_F(Layers, AreOfLevelThreeAndANoteSaysWhoAskedInVain) {
  EXPECT_THAT(pack({"--level", "ball#1=3", "--level", "ball#2=1", "--layers", "100,60"}).err, Not(HasSubstr("note")));
  EXPECT_EQ(quotas(), json::array({{"100%", "60%"}, nullptr}));
  EXPECT_THAT(pack({"--level", "ball#1=3", "--level", "ball#2=1", "--layers", "ball=100,60"}).err,
              HasSubstr("mesh 'ball#2': layers are left out: they are for level 3, and its level is 1"));
  EXPECT_EQ(quotas(), json::array({{"100%", "60%"}, nullptr}));
  EXPECT_EQ(pack({"--default-level", "1", "--layers", "100,60"}).err,
            "note: --layers 100,60 has no effect: no mesh is of level 3\n");
}

TEST_F(Layers, ListsThatAreNoneAreOneLine) {
  const auto option = [&](const std::string& list) { return refused({"--layers", list}, 2); };
  EXPECT_THAT(option("100,60,60"), AllOf(HasSubstr("--layers 100,60,60:"), HasSubstr("layer 3, 60, is not below 60")));
  EXPECT_THAT(option("100,36,60"), HasSubstr("layer 3, 60, is not below 36"));
  EXPECT_THAT(option("60,36"), HasSubstr("must begin with 100, the whole mesh, and not with 60"));
  EXPECT_THAT(option("100"), HasSubstr("two layers or more"));
  EXPECT_THAT(option("100,0"), HasSubstr("layer 2 is 0, no number above 0"));
  EXPECT_THAT(option("100,-5"), HasSubstr("layer 2 is -5, no number above 0"));
  EXPECT_THAT(option("100,half"), HasSubstr("layer 2 is half"));
  EXPECT_THAT(option("100,,50"), HasSubstr("layer 2 is nothing"));
  EXPECT_THAT(option("100,50,"), HasSubstr("layer 3 is nothing"));
  EXPECT_THAT(option("100,nan"), HasSubstr("layer 2 is nan"));
  EXPECT_THAT(option("100,1e-9"), HasSubstr("layer 2 is 1e-9"));
  EXPECT_THAT(option("101,50"), HasSubstr("layer 1 is 101"));
  EXPECT_THAT(option("100,90,80,70,60,50,40,30,20,10,9,8,7,6,5,4,3"), HasSubstr("16 layers at most, not 17"));
  EXPECT_THAT(option("=100,60"), HasSubstr("wants NAME=VALUE"));
  EXPECT_THAT(option("bal=100,60"), HasSubstr("did you mean ball"));
  EXPECT_EQ(pack({"--layers", "100,90,80,70,60,50,40,30,20,10,9,8,7,6,5,4", "--default-level", "3"}).exit_code, 0);
}

TEST_F(Layers, ListsThatAreNoneInFilesAreOneLineAndNameThePlace) {
  const auto in_sidecar = [&](const json& list) { return refused({"--sidecar", sidecar({{"layers", list}})}, 3); };
  EXPECT_THAT(in_sidecar({100, 60, 70}), AllOf(HasSubstr("s.json: meshes.ball: layers must fall"), HasSubstr("70")));
  EXPECT_THAT(in_sidecar(100), HasSubstr("must be two layers or more"));
  EXPECT_THAT(in_sidecar(true), HasSubstr("not true"));
  EXPECT_THAT(in_sidecar(nullptr), HasSubstr("two layers or more"));
  EXPECT_THAT(in_sidecar(json::array()), HasSubstr("two layers or more"));
  EXPECT_THAT(in_sidecar({{"a", 100}, {"b", 50}}), HasSubstr("layer 1 is {\"a\":100"));
  EXPECT_THAT(in_sidecar({100, json::array({60, 30})}), HasSubstr("layer 2 is [60"));
  EXPECT_THAT(in_sidecar({100, nullptr}), HasSubstr("layer 2 is null"));
  GltfBuilder b = ball();
  b.document["nodes"][0]["extras"] = {{"layers", {100, 120}}};
  const auto result = run_usuzumi({"pack", folder_.write("x.gltf", b.text()), "-o", rom_file()});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, AllOf(HasSubstr("node 'Ball': layers must be"), HasSubstr("layer 2 is 120")));
}

TEST_F(Layers, HaveNoPlaceInBareData) {
  EXPECT_THAT(refused({"--bare", "--layers", "100,60"}, 2), HasSubstr("--bare keeps levels only"));
  EXPECT_THAT(refused({"--bare", "--sidecar", sidecar({{"layers", {100, 60}}})}, 3), HasSubstr("layers"));
  GltfBuilder b = ball();
  b.document["nodes"][0]["extras"] = {{"thinning_level", 3}, {"layers", {100, 60}}};
  const auto result = run_usuzumi({"pack", folder_.write("x.gltf", b.text()), "-o", rom_file(), "--bare"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("layers of 2 meshes are lost"));
}

TEST_F(Layers, AreReportedInFacesAndBytes) {
  const auto packed = pack({"--default-level", "3", "--method", "*=half-edge", "--layers", "100,60,36"});
  ASSERT_EQ(packed.exit_code, 0) << packed.err;
  const DrawingData rom = data();
  std::uint64_t bytes = 0;
  rom.for_each_mesh([&](const MeshView& mesh) {
    const LayerChainView chain = LayerChainView::of_checked(mesh.layers);
    bytes += chain.header().bytes;
    const json shown = inspected()["meshes"][mesh.number]["layers"];
    EXPECT_EQ(shown["bytes"], chain.header().bytes);
    EXPECT_EQ(shown["steps"], chain.step_count());
    EXPECT_EQ(shown["added_vertices"], 0) << "half-edge makes none";
    EXPECT_EQ(shown["layers"], (json::array({{{"quota", "100%"}, {"faces", 140}},
                                             {{"quota", "60%"}, {"faces", chain.layer(1).faces}},
                                             {{"quota", "36%"}, {"faces", chain.layer(2).faces}}})));
  });
  EXPECT_THAT(packed.out, HasSubstr(std::to_string(bytes) + " of them layers of 2 meshes"));
  EXPECT_THAT(
      run_usuzumi({"inspect", rom_file()}).out,
      AllOf(HasSubstr("mesh 2: layers of 140 (100%), "), HasSubstr("layers of 2 meshes: " + std::to_string(bytes))));
  ASSERT_EQ(pack({"--default-level", "3"}).exit_code, 0);
  EXPECT_EQ(inspected()["meshes"][0]["layers"], nullptr);
  EXPECT_THAT(run_usuzumi({"inspect", rom_file()}).out, Not(HasSubstr("layers of")));
}

TEST_F(Layers, WhereAMethodMayGoNoFurtherTheChainEndsAndANoteSaysSo) {
  const auto packed = pack({"--default-level", "3", "--layers", "100,50,0.1"});
  EXPECT_EQ(packed.exit_code, 0);
  EXPECT_THAT(packed.err,
              AllOf(HasSubstr("layers of 2 meshes end before the last"), HasSubstr("the first mesh 'ball'")));
}

TEST_F(Layers, SameInputGivesTheSameBytes) {
  ASSERT_EQ(pack({"--default-level", "3", "--layers", "100,50"}).exit_code, 0);
  const auto first = testing::bytes_of_file(rom_file());
  ASSERT_EQ(pack({"--default-level", "3", "--layers", "100,50"}).exit_code, 0);
  EXPECT_EQ(testing::bytes_of_file(rom_file()), first);
}

/// Puts the checksum right, so that what lies behind it is reached.
void seal(std::vector<std::byte>& rom) {
  const std::uint32_t crc = crc32(kCrc32Start, std::span(rom).subspan(24));
  std::memcpy(rom.data() + 20, &crc, 4);
}

TEST_F(Layers, EveryChangedWordOfThemIsRefusedOrHarmless) {
  ASSERT_EQ(pack({"--default-level", "3", "--join", "ball", "--method", "*=half-edge", "--layers", "100,60"}).exit_code,
            0);
  const MeshView mesh = data().mesh(0);
  const LayerChainView chain = LayerChainView::of_checked(mesh.layers);
  const auto begin = static_cast<std::size_t>(mesh.layers.data() - rom_.data());
  std::size_t refused = 0, harmless = 0;
  for (std::size_t at = begin; at < begin + chain.header().bytes; at += 4)
    for (const std::uint32_t with : {0u, 1u, 0x7FFFFFFFu, 0xFFFFFFFFu}) {
      std::vector<std::byte> rom = rom_;
      if (std::memcmp(rom.data() + at, &with, 4) == 0) continue;
      std::memcpy(rom.data() + at, &with, 4);
      seal(rom);
      const auto opened = DrawingData::open(rom);
      refused += opened.ok() ? 0u : 1u;
      if (!opened.ok()) {
        EXPECT_EQ(opened.status().code, StatusCode::kDataLoss);
        continue;
      }
      ++harmless;
      const MeshView changed = opened->mesh(0);
      const LayerChainView its = LayerChainView::of_checked(changed.layers);
      std::vector<std::uint32_t> indices(std::size_t{3} * its.face_count()), live(its.group_count());
      firmware::LayerReplay replay(its, std::as_writable_bytes(std::span(indices)), 4, live);
      firmware::begin_replay(changed, replay);
      if (!replay.check().ok()) continue;
      for (const auto& layer : its.layers()) replay.go_to(layer.step);
      for (std::uint32_t i : indices) EXPECT_LT(i, its.store_count());
    }
  EXPECT_GT(refused, harmless);
  rom_[begin + 4] ^= std::byte{1};
  seal(rom_);
  folder_.write("ball.rom", {reinterpret_cast<const char*>(rom_.data()), rom_.size()});
  const auto shown = run_usuzumi({"inspect", rom_file()});
  EXPECT_EQ(shown.exit_code, 3);
  EXPECT_THAT(shown.err, AllOf(HasSubstr("unsound"), HasSubstr(std::to_string(begin + 4))));
}

}  // namespace
}  // namespace usuzumi
