// Materials and textures from model files to ROM: what arrives, and what becomes of what is missing or broken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/pack/load_model.h"
#include "sim/pack/rom_writer.h"
#include "tests/sim/pack/pictures.h"
#include "tests/sim/pack/support.h"

namespace usuzumi {
namespace {

using firmware::DrawingData;
using firmware::format::AlphaMode;
using sim::load_model;
using sim::Model;
using ::testing::AllOf;
using ::testing::ElementsAre;
using testing::GltfBuilder;
using ::testing::HasSubstr;
using testing::jpeg_file;
using testing::json;
using testing::plain;
using testing::png_file;
using testing::run_usuzumi;
using testing::TempFolder;

const Rgba8 kRed = rgba8(255, 0, 0), kBlue = rgba8(0, 0, 255);

/// One triangle with the coordinates `st`, whose material has the texture of image 0.
GltfBuilder textured_triangle(const std::vector<float>& st, const json& image) {
  GltfBuilder b;
  const int p = b.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const int t = b.accessor(st, 5126, "VEC2", 2);
  b.document["images"] = json::array({image});
  b.document["textures"] = json::array({{{"source", 0}}});
  b.document["materials"] =
      json::array({{{"name", "paint"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", p}, {"TEXCOORD_0", t}}}, {"material", 0}}, "plate")}});
  return b;
}
const std::vector<float> kCorners{0, 0, 1, 0, 0, 1};

std::string data_uri(const std::string& file, const std::string& mime) {
  return "data:" + mime + ";base64," + testing::base64(std::as_bytes(std::span(file)));
}

json& base_texture(GltfBuilder& b) { return b.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]; }

Model load(const GltfBuilder& b, const TempFolder& folder) { return load_model(folder.write("m.gltf", b.text())); }

/// The texture coordinates at the corners in the order (0 0 0), (1 0 0), (0 1 0).
std::vector<TexCoord> by_corner(const Model& model) {
  std::vector<TexCoord> out(3);
  const sim::Mesh& mesh = model.meshes.at(0);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    out[mesh.positions[v].x > 0.5f ? 1 : mesh.positions[v].y > 0.5f ? 2 : 0] = mesh.texture_coordinates.at(v);
  return out;
}

void expect_near(const std::vector<TexCoord>& got, const std::vector<TexCoord>& want) {
  ASSERT_EQ(got.size(), want.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_NEAR(got[i].s, want[i].s, 1e-6f) << i;
    EXPECT_NEAR(got[i].t, want[i].t, 1e-6f) << i;
  }
}

TEST(GltfTextures, ComeFromFilesDataUrisAndBufferViewsOfBothKinds) {
  TempFolder folder;
  const std::string png = png_file(2, 1, {kRed, kBlue}), jpeg = jpeg_file(8, 8, plain(8, 8, kBlue));
  folder.write("my paint.png", png);
  GltfBuilder in_view = textured_triangle(kCorners, {});
  in_view.document["images"][0] = {
      {"bufferView", in_view.view(std::as_bytes(std::span(png)))}, {"mimeType", "image/png"}, {"name", "inside"}};
  for (const auto& [gltf, name] :
       {std::pair{textured_triangle(kCorners, {{"uri", "my%20paint.png"}}), "my paint.png"},
        std::pair{textured_triangle(kCorners, {{"uri", data_uri(png, "image/png")}}), "image 0"},
        std::pair{in_view, "inside"}}) {
    const Model model = load(gltf, folder);
    ASSERT_EQ(model.textures.size(), 1u) << name << (model.notes.empty() ? "" : model.notes[0]);
    EXPECT_EQ(model.textures[0].name, name);
    EXPECT_THAT(model.textures[0].texels, ElementsAre(kRed, kBlue));
    EXPECT_EQ(model.materials.at(*model.meshes[0].material).texture, 0u);
    EXPECT_EQ(model.meshes[0].material_name, "paint");
    EXPECT_EQ(by_corner(model), (std::vector<TexCoord>{{0, 0}, {1, 0}, {0, 1}}));
    EXPECT_EQ(load_model(folder.write("m.glb", gltf.glb())).textures.size(), 1u);
  }
  const Model model = load(textured_triangle(kCorners, {{"uri", data_uri(jpeg, "image/jpeg")}}), folder);
  ASSERT_EQ(model.textures.size(), 1u);
  EXPECT_GE(model.textures[0].texels[0].b(), 250u);
}

TEST(GltfTextures, SamplerAndAlphaArrive) {
  TempFolder folder;
  GltfBuilder b = textured_triangle(kCorners, {{"uri", data_uri(png_file(1, 1, {kRed}), "image/png")}});
  b.document["samplers"] = json::array({{{"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33648}}});
  b.document["textures"][0]["sampler"] = 0;
  b.document["materials"][0]["alphaMode"] = "MASK";
  b.document["materials"][0]["alphaCutoff"] = 0.25;
  const Model model = load(b, folder);
  const sim::Material& m = model.materials.at(*model.meshes[0].material);
  EXPECT_EQ(m.filter, command::TextureFilter::kNearest);
  EXPECT_EQ(m.wrap_s, command::TextureWrap::kClamp);
  EXPECT_EQ(m.wrap_t, command::TextureWrap::kMirror);
  EXPECT_EQ(m.alpha_mode, AlphaMode::kMask);
  EXPECT_EQ(m.alpha_reference, 64u) << "63/255 is below a quarter, 64/255 is not";
  b.document["materials"][0]["alphaMode"] = "BLEND";
  const Model blended = load(b, folder);
  EXPECT_EQ(blended.materials.at(*blended.meshes[0].material).alpha_mode, AlphaMode::kBlend);
}

TEST(GltfTextures, TakeTheSetOfCoordinatesThatTheMaterialNamesAlsoInNormalizedIntegers) {
  TempFolder folder;
  GltfBuilder b = textured_triangle(kCorners, {{"uri", data_uri(png_file(1, 1, {kRed}), "image/png")}});
  const int bytes = b.accessor(std::vector<std::uint8_t>{0, 51, 255, 0, 102, 255}, 5121, "VEC2", 2);
  const int shorts = b.accessor(std::vector<std::uint16_t>{65535, 0, 13107, 0, 0, 65535}, 5123, "VEC2", 2);
  for (int a : {bytes, shorts}) b.document["accessors"][static_cast<std::size_t>(a)]["normalized"] = true;
  b.document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = bytes;
  b.document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_2"] = shorts;
  base_texture(b)["texCoord"] = 1;
  expect_near(by_corner(load(b, folder)), {{0, 0.2f}, {1, 0}, {0.4f, 1}});
  base_texture(b)["texCoord"] = 2;
  expect_near(by_corner(load(b, folder)), {{1, 0}, {0.2f, 0}, {0, 1}});
}

TEST(GltfTextures, TextureTransformIsAppliedAsItsExampleSays) {
  TempFolder folder;
  GltfBuilder b = textured_triangle(kCorners, {{"uri", data_uri(png_file(1, 1, {kRed}), "image/png")}});
  // The extension's example: the lower left quarter of the image, turned. s' = t / 2, t' = 1 - s / 2.
  base_texture(b)["extensions"]["KHR_texture_transform"] = {
      {"offset", {0, 1}}, {"rotation", std::acos(-1.0) / 2}, {"scale", {0.5, 0.5}}};
  expect_near(by_corner(load(b, folder)), {{0, 1}, {0, 0.5f}, {0.5f, 1}});
}

TEST(GltfTextures, WedgesOfOnePositionKeepTheirOwnCoordinates) {
  TempFolder folder;
  GltfBuilder b;
  const int p = b.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  const int t = b.accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0.5, 0, 1, 1, 0, 1}, 5126, "VEC2", 2);
  b.document["images"] = json::array({{{"uri", data_uri(png_file(1, 1, {kRed}), "image/png")}}});
  b.document["textures"] = json::array({{{"source", 0}}});
  b.document["materials"] = json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
  b.node({{"mesh", b.mesh({{"attributes", {{"POSITION", p}, {"TEXCOORD_0", t}}}, {"material", 0}})}});
  // (1 0 0) is at (1 0) in one face and at (0.5 0) in the other; (0 1 0) is the same in both.
  EXPECT_EQ(load(b, folder).meshes[0].positions.size(), 5u);
  b.document["materials"][0]["pbrMetallicRoughness"].erase("baseColorTexture");
  const Model plain_model = load(b, folder);
  EXPECT_EQ(plain_model.meshes[0].positions.size(), 4u) << "without texture nobody needs the seam";
  EXPECT_TRUE(plain_model.meshes[0].texture_coordinates.empty());
}

TEST(GltfTextures, MissingOrBrokenImagesCostOneNoteEachAndTheTexture) {
  TempFolder folder;
  const std::string png = png_file(4, 4, plain(4, 4, kRed));
  folder.write("cut.png", png.substr(0, png.size() / 2));
  folder.write("text.png", "not an image");
  folder.write("empty.png", "");
  const std::string jpeg = jpeg_file(16, 16, plain(16, 16, kRed));
  folder.write("cut.jpg", jpeg.substr(0, jpeg.size() / 2));
  for (const auto& [name, why] : {std::pair{"gone.png", "missing"}, std::pair{"cut.png", "damaged PNG"},
                                  std::pair{"text.png", "neither PNG nor JPEG"}, std::pair{"empty.png", "empty"},
                                  std::pair{"cut.jpg", "damaged JPEG"}}) {
    GltfBuilder b = textured_triangle(kCorners, {{"uri", name}});
    b.document["nodes"].push_back({{"mesh", 0}, {"translation", {5, 0, 0}}});
    b.document["scenes"][0]["nodes"].push_back(1);
    const Model model = load(b, folder);
    ASSERT_EQ(model.meshes.size(), 2u);
    EXPECT_THAT(model.notes, ElementsAre(AllOf(HasSubstr(name), HasSubstr(why), HasSubstr("without texture"))));
    EXPECT_TRUE(model.textures.empty());
    EXPECT_FALSE(model.meshes[0].material);
    EXPECT_TRUE(model.meshes[0].texture_coordinates.empty());
    EXPECT_TRUE(DrawingData::open(sim::write_container(model)).ok());
  }
}

TEST(GltfTextures, MeshesWithoutUsableCoordinatesLoseTheTextureAndANoteSaysWhy) {
  TempFolder folder;
  const json image = {{"uri", data_uri(png_file(1, 1, {kRed}), "image/png")}};
  GltfBuilder without = textured_triangle(kCorners, image);
  without.document["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
  const float inf = std::numeric_limits<float>::infinity();
  const GltfBuilder infinite = textured_triangle({0, 0, inf, 0, 0, 1}, image);
  const GltfBuilder wide = textured_triangle({0, 0, 30000, 0, 0, 1}, image);
  for (const auto& [gltf, why] :
       {std::pair{without, "no texture coordinates"}, std::pair{infinite, "infinite"}, std::pair{wide, "30000"}}) {
    const Model model = load(gltf, folder);
    EXPECT_THAT(model.notes, ElementsAre(AllOf(HasSubstr("'plate'"), HasSubstr(why))));
    EXPECT_FALSE(model.meshes[0].material);
    EXPECT_TRUE(model.meshes[0].texture_coordinates.empty());
    EXPECT_TRUE(DrawingData::open(sim::write_container(model)).ok());
  }
}

TEST(GltfTextures, WholeRepeatsFarOffAreTakenOffAndNothingElse) {
  TempFolder folder;
  const json image = {{"uri", data_uri(png_file(1, 1, {kRed}), "image/png")}};
  expect_near(by_corner(load(textured_triangle({20000.25, 3, 20001.25, 3, 20000.25, 4}, image), folder)),
              {{0.25f, 3}, {1.25f, 3}, {0.25f, 4}});
  GltfBuilder clamped = textured_triangle({20, 3, 21, 3, 20, 4}, image);
  clamped.document["samplers"] = json::array({{{"wrapS", 33071}, {"wrapT", 33071}}});
  clamped.document["textures"][0]["sampler"] = 0;
  expect_near(by_corner(load(clamped, folder)), {{20, 3}, {21, 3}, {20, 4}});
}

TEST(ObjTextures, ComeFromMtlFilesWithTRunningUpAndFromOtherFoldersNames) {
  TempFolder folder;
  folder.write("Wood.png", png_file(2, 1, {kRed, kBlue}));
  folder.write("m.obj",
               "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl wood\nf 1/1 2/2 3/3\n");
  for (const char* name : {"Wood.png", "wood.PNG", "C:\\art\\textures\\Wood.png", "./Wood.png", "/nowhere/Wood.png"}) {
    folder.write("m.mtl", std::string("newmtl wood\nKd 1 1 1\nmap_Kd ") + name + "\n");
    const Model model = load_model(folder / "m.obj");
    ASSERT_EQ(model.textures.size(), 1u) << name << (model.notes.empty() ? "" : model.notes[0]);
    EXPECT_THAT(model.textures[0].texels, ElementsAre(kRed, kBlue));
    expect_near(by_corner(model), {{0, 1}, {1, 1}, {0, 0}});
    EXPECT_EQ(model.meshes[0].material_name, "wood");
    EXPECT_THAT(model.part_files, ElementsAre(HasSubstr("Wood.png")));
  }
  folder.write("m.mtl", "newmtl wood\nKd 1 1 1\nmap_Kd gone.tga\n");
  EXPECT_THAT(load_model(folder / "m.obj").notes, ElementsAre(AllOf(HasSubstr("gone.tga"), HasSubstr("missing"))));
  folder.write("m.mtl", "newmtl wood\nKd 0 0 0\nmap_Kd Wood.png\n");
  EXPECT_EQ(load_model(folder / "m.obj").meshes[0].base_colour, rgba8(255, 255, 255)) << "black would show nothing";
}

TEST(TexturedRom, ReachesTheReaderWithLevelsInEveryFormat) {
  TempFolder folder;
  const std::vector<Rgba8> texels{kRed, kBlue, rgba8(0, 255, 0), rgba8(255, 255, 255)};
  GltfBuilder b = textured_triangle(kCorners, {{"uri", data_uri(png_file(2, 2, texels), "image/png")}});
  const Model model = load(b, folder);
  struct Case {
    sim::TexelChoice choice;
    command::TextureFormat format;
    std::size_t bytes;  // 2 x 2 and 1 x 1
  };
  for (const Case& c : {Case{sim::TexelChoice::kAuto, command::TextureFormat::kXrgb8888, 20},
                        Case{sim::TexelChoice::kRgb565, command::TextureFormat::kRgb565, 8 + 4},
                        Case{sim::TexelChoice::kArgb8888, command::TextureFormat::kArgb8888, 20}}) {
    const auto rom = sim::write_container(model, {.texels = c.choice});
    EXPECT_EQ(rom, sim::write_container(model, {.texels = c.choice}));
    const auto data = DrawingData::open(rom);
    ASSERT_TRUE(data.ok()) << data.status().message << data.status().where;
    const auto texture = data->mesh(0).material.texture;
    EXPECT_EQ(texture.format, c.format);
    EXPECT_EQ(texture.level_count, 2u);
    EXPECT_EQ(texture.texels.size(), c.bytes);
    EXPECT_EQ(texture.name, "image 0");
    EXPECT_EQ(data->mesh(0).texture_coordinates.size(), 3u);
  }
  const auto single = sim::write_container(model, {.mips = false});
  EXPECT_EQ(DrawingData::open(single)->mesh(0).material.texture.level_count, 1u);
}

TEST(PackCommand, BadTexturesCostANoteAndFilesThatContradictThemselvesAreRefused) {
  TempFolder folder;
  const std::string rom = folder / "m.rom";
  const auto pack = [&](const GltfBuilder& b) {
    std::filesystem::remove(rom);
    const auto result = run_usuzumi({"pack", folder.write("m.gltf", b.text()), "-o", rom, "--default-level", "1"});
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(std::filesystem::exists(rom), result.exit_code == 0);
    return result;
  };
  const std::string good = data_uri(png_file(1, 1, {kRed}), "image/png");
  GltfBuilder without = textured_triangle(kCorners, {{"uri", good}});
  without.document["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
  for (const auto& [gltf, why] : {std::pair{textured_triangle(kCorners, {{"uri", "gone.png"}}), "gone.png is missing"},
                                  std::pair{textured_triangle({0, 0, 2e5, 0, 0, 1}, {{"uri", good}}), "hold up to"},
                                  std::pair{without, "no texture coordinates"}}) {
    const auto packed = pack(gltf);
    EXPECT_EQ(packed.exit_code, 0) << why;
    EXPECT_THAT(packed.err, AllOf(::testing::StartsWith("note: "), HasSubstr(why)));
    const json shown = json::parse(run_usuzumi({"inspect", rom, "--json"}).out);
    EXPECT_EQ(shown["textures"], json::array()) << why;
    EXPECT_EQ(shown["meshes"][0]["texture_coordinates"], false) << why;
  }
  GltfBuilder negative = textured_triangle(kCorners, {{"uri", good}}), beyond = negative, few = negative;
  base_texture(negative)["index"] = -2;
  base_texture(beyond)["index"] = 1;
  few.document["accessors"][1]["count"] = 2;
  const GltfBuilder garbled = textured_triangle(kCorners, {{"uri", "data:image/png;base64,@"}});
  for (const auto& [gltf, why] : {std::pair{negative, "texture -2, which does not exist"},
                                  std::pair{beyond, "texture 1, which does not exist"},
                                  std::pair{few, "3 positions but 2 of TEXCOORD_0"},
                                  std::pair{garbled, "uri"}}) {
    const auto refused = pack(gltf);
    EXPECT_EQ(refused.exit_code, 3) << why;
    EXPECT_THAT(refused.err, AllOf(::testing::StartsWith("usuzumi: "), HasSubstr("m.gltf"), HasSubstr(why)));
  }
}

TEST(PackCommand, TextureOptionsDecideWhatLiesInRom) {
  TempFolder folder;
  GltfBuilder b = textured_triangle(kCorners, {{"uri", "paint.png"}});
  folder.write("paint.png", png_file(64, 16, plain(64, 16, kRed)));
  const std::string model = folder.write("m.gltf", b.text()), rom = folder / "m.rom";
  const auto inspected = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"pack", model, "-o", rom, "--default-level", "1"});
    const auto packed = run_usuzumi(options);
    EXPECT_EQ(packed.exit_code, 0) << packed.err;
    return json::parse(run_usuzumi({"inspect", rom, "--json"}).out);
  };
  const json plain_rom = inspected({});
  EXPECT_EQ(plain_rom["textures"][0], (json{{"number", 1},
                                            {"name", "paint.png"},
                                            {"width", 64},
                                            {"height", 16},
                                            {"format", "xrgb8888"},
                                            {"levels", 7},
                                            {"bytes", 4 * (64 * 16 + 32 * 8 + 16 * 4 + 8 * 2 + 4 + 2 + 1)}}));
  EXPECT_EQ(plain_rom["meshes"][0]["material"], 1);
  EXPECT_EQ(plain_rom["meshes"][0]["texture_coordinates"], true);
  const json small = inspected({"--texture-format", "rgb565", "--no-mips", "--texture-size", "20"});
  EXPECT_EQ(small["textures"][0]["width"], 16);
  EXPECT_EQ(small["textures"][0]["bytes"], 16 * 4 * 2);
  EXPECT_EQ(small["textures"][0]["format"], "rgb565");
  EXPECT_THAT(run_usuzumi({"inspect", rom}).out, AllOf(HasSubstr("16x4"), HasSubstr("rgb565"), HasSubstr("paint.png")));
  const auto bare = run_usuzumi({"pack", model, "-o", rom, "--bare"});
  EXPECT_EQ(bare.exit_code, 0);
  EXPECT_THAT(bare.err, HasSubstr("the textures of 1 mesh"));
  for (const char* word : {"rgb888", "RGB565", "3", ""})
    EXPECT_EQ(run_usuzumi({"pack", model, "-o", rom, "--texture-format", word}).exit_code, 2) << word;
  EXPECT_EQ(run_usuzumi({"pack", model, "-o", rom, "--texture-size", "0"}).exit_code, 2);
  const auto over = run_usuzumi({"pack", model, "-o", folder / "paint.png"});
  EXPECT_EQ(over.exit_code, 2) << "the output would be the texture itself";
}

/// Two squares side by side, one material each, as the primitives of one mesh.
GltfBuilder two_materials() {
  GltfBuilder b;
  const int left = b.positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}),
            right = b.positions({1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0});
  const int t = b.accessor(std::vector<float>{0, 0, 1, 0, 1, 1, 0, 1}, 5126, "VEC2", 2);
  const int order = b.indices({0, 1, 2, 0, 2, 3});
  b.document["images"] = json::array({{{"uri", data_uri(png_file(1, 1, {kRed}), "image/png")}}});
  b.document["textures"] = json::array({{{"source", 0}}});
  b.document["materials"] =
      json::array({{{"name", "red"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}},
                   {{"name", "blue"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 1, 1}}}}}});
  const int mesh =
      b.mesh({{"attributes", {{"POSITION", left}, {"TEXCOORD_0", t}}}, {"indices", order}, {"material", 0}}, "board");
  b.document["meshes"][0]["primitives"].push_back(
      {{"attributes", {{"POSITION", right}}}, {"indices", order}, {"material", 1}});
  b.node({{"mesh", mesh}});
  return b;
}

TEST(JoinParts, MakesOneMeshOfThePrimitivesOfOneAndKeepsTheirMaterials) {
  TempFolder folder;
  const std::string model = folder.write("m.gltf", two_materials().text()), rom = folder / "m.rom";
  ASSERT_EQ(run_usuzumi({"pack", model, "-o", rom, "--default-level", "1"}).exit_code, 0);
  EXPECT_EQ(json::parse(run_usuzumi({"inspect", rom, "--json"}).out)["mesh_max"], 2);
  const auto packed = run_usuzumi({"pack", model, "-o", rom, "--default-level", "3", "--join", "board"});
  ASSERT_EQ(packed.exit_code, 0) << packed.err;
  const auto bytes = testing::bytes_of_file(rom);
  const auto data = DrawingData::open(bytes);
  ASSERT_TRUE(data.ok()) << data.status().message;
  ASSERT_EQ(data->mesh_max(), 1u);
  const auto mesh = data->mesh(0);
  ASSERT_EQ(mesh.group_count(), 2u);
  EXPECT_EQ(mesh.name, "board");
  EXPECT_EQ(mesh.group(0).face_end, 2u);
  EXPECT_EQ(mesh.group(0).vertex_end, 4u);
  EXPECT_EQ(mesh.group(0).material, 0u);
  EXPECT_EQ(mesh.group(1).face_end, 4u);
  EXPECT_EQ(mesh.group(1).vertex_end, 8u);
  EXPECT_EQ(mesh.group(1).material, firmware::format::kAbsent);
  EXPECT_EQ(Rgba8{mesh.group(1).base_colour}, kBlue);
  EXPECT_EQ(mesh.texture_coordinates.size(), 8u);
  const auto unknown = run_usuzumi({"pack", model, "-o", rom, "--join", "bord"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean board"));
}

}  // namespace
}  // namespace usuzumi
