// What version 1.1 adds to the container: textures, materials, methods and their settings.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "firmware/drawing_data/drawing_data.h"
#include "tests/support/rom_builder.h"

namespace usuzumi {
namespace {

using firmware::DrawingData;
using firmware::MeshView;
using firmware::Method;
using firmware::format::kAbsent;
using firmware::format::Material;
using testing::container_rom;
using testing::RomImage;
using testing::seal;
using testing::TestAppearance;
using testing::TestMesh;
using testing::TestTexture;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

std::vector<std::uint32_t> words_of(std::initializer_list<float> numbers) {
  std::vector<std::uint32_t> words;
  for (float f : numbers) words.push_back(std::bit_cast<std::uint32_t>(f));
  return words;
}

/// A mesh with a masked texture thinned by edge removal, a plain one thinned by vertex deletion, and a third without
/// anything of 1.1.
struct Drawing {
  std::vector<TestMesh> meshes{3};
  TestAppearance appearance;

  Drawing() {
    for (TestMesh& mesh : meshes) {
      mesh.level = 3;
      mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
      mesh.indices = {0, 1, 2};
    }
    meshes[0].name = "leaf";
    meshes[0].texture_coordinates = {{0, 1}, {1, 1}, {0, -0.5f}};
    meshes[0].material = 1;
    meshes[0].method = firmware::format::Method::kEdgeRemoval;
    meshes[0].method_settings = words_of({2, 3, 4, 5, 6});
    for (std::uint32_t w : {4u, 0u, std::bit_cast<std::uint32_t>(0.25f), 0u, 0u})
      meshes[0].method_settings.push_back(w);
    meshes[0].edge_values = {0, 7.5f, -1};
    meshes[1].method = firmware::format::Method::kVertexDeletion;
    meshes[1].method_settings = words_of({1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
    meshes[1].material = 0;
    appearance.materials.resize(2);
    appearance.materials[1] = {1, 0, 1, 2, firmware::format::AlphaMode::kMask, 200, {}};
    TestTexture paint;  // RGB565, 3 x 2 texels: a row has 6 bytes and takes 8; then 1 x 1, 2 bytes that take 4
    paint.format = 1;
    paint.width = 3;
    paint.height = 2;
    paint.level_count = 2;
    paint.texels = {0x00020001, 0x00000003, 0x00050004, 0x00000006, 0x00000007};
    TestTexture mask;  // ARGB8888
    mask.width = 1;
    mask.height = 2;
    mask.texels = {0x80FF0000, 0x00FF0000};
    mask.name = "leaf.png";
    appearance.textures = {paint, mask};
  }
  /// A fourth mesh: two faces, of which the second has the masked texture and the first none.
  Drawing& with_groups() {
    TestMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
    mesh.indices = {0, 1, 2, 3, 4, 5};
    mesh.texture_coordinates.resize(6);
    mesh.groups = {{1, 3, kAbsent, 0xFF0000FF}, {2, 6, 1, 0xFFFFFFFF}};
    meshes.push_back(mesh);
    return *this;
  }
  RomImage rom() const { return container_rom(meshes, appearance); }
};

void expect_refused(const RomImage& rom, StatusCode code, const char* about) {
  const auto data = DrawingData::open(rom.bytes());
  EXPECT_EQ(data.status().code, code) << about;
  EXPECT_NE(std::string(data.status().message).find(about), std::string::npos)
      << '"' << data.status().message << "\" should speak of: " << about;
}
void expect_refused(const Drawing& drawing, StatusCode code, const char* about) {
  expect_refused(drawing.rom(), code, about);
}

TEST(Appearance, IsReadInPlace) {
  const RomImage rom = Drawing().rom();
  const auto data = DrawingData::open(rom.bytes());
  ASSERT_TRUE(data.ok()) << data.status().message << " " << data.status().where;
  const MeshView leaf = data->mesh(0);
  ASSERT_EQ(leaf.texture_coordinates.size(), 3u);
  EXPECT_EQ(leaf.texture_coordinates[2], (TexCoord{0, -0.5f}));
  ASSERT_EQ(leaf.edge_values.size(), 3u);
  EXPECT_EQ(leaf.edge_values[1], 7.5f);
  EXPECT_EQ(leaf.edge_values[2], firmware::kLockedEdgeValue);
  EXPECT_EQ(leaf.material.number, 1u);
  EXPECT_EQ(leaf.material.filter, command::TextureFilter::kNearest);
  EXPECT_EQ(leaf.material.wrap_s, command::TextureWrap::kClamp);
  EXPECT_EQ(leaf.material.wrap_t, command::TextureWrap::kMirror);
  EXPECT_EQ(leaf.material.alpha_mode, firmware::format::AlphaMode::kMask);
  EXPECT_EQ(leaf.material.alpha_reference, 200u);
  EXPECT_EQ(leaf.material.texture.number, 1u);
  EXPECT_EQ(leaf.material.texture.name, "leaf.png");
  EXPECT_EQ(leaf.material.texture.format, command::TextureFormat::kArgb8888);
  EXPECT_EQ(leaf.material.texture.width, 1u);
  EXPECT_EQ(leaf.material.texture.height, 2u);
  ASSERT_EQ(leaf.material.texture.texels.size(), 8u);
  std::uint32_t texel;
  std::memcpy(&texel, leaf.material.texture.texels.data(), 4);
  EXPECT_EQ(texel, 0x80FF0000u);
  const auto* first = rom.bytes().data();
  EXPECT_TRUE(leaf.material.texture.texels.data() > first &&
              leaf.material.texture.texels.data() < first + rom.bytes().size())
      << "texels are not copied";
}

TEST(Appearance, TexturesAndMaterialsAreCounted) {
  const RomImage rom = Drawing().rom();
  const auto data = DrawingData::open(rom.bytes());
  ASSERT_TRUE(data.ok());
  EXPECT_EQ(data->texture_count(), 2u);
  EXPECT_EQ(data->material_count(), 2u);
  EXPECT_FALSE(data->material(0).texture.present());
  const firmware::TextureView paint = data->texture(0);
  EXPECT_EQ(paint.level_count, 2u);
  EXPECT_EQ(paint.texels.size(), 20u) << "two rows of 8 bytes, and one of 4";
  EXPECT_EQ(paint.name, "");
  EXPECT_EQ(data->mesh(1).material.number, 0u);
  EXPECT_FALSE(data->mesh(1).material.texture.present());
}

TEST(Appearance, MethodsCarryTheirAuthorsSettings) {
  const RomImage rom = Drawing().rom();
  const auto data = DrawingData::open(rom.bytes());
  ASSERT_TRUE(data.ok());
  const auto removal = data->mesh(0).edge_removal();
  EXPECT_EQ(data->mesh(0).method, Method::kEdgeRemoval);
  EXPECT_EQ(removal.a, 2);
  EXPECT_EQ(removal.b, 3);
  EXPECT_EQ(removal.neighbour_weight, 4);
  EXPECT_EQ(removal.computed_weight, 5);
  EXPECT_EQ(removal.user_weight, 6);
  EXPECT_EQ(removal.placement, firmware::EdgePlacement::kMidpoint);
  EXPECT_EQ(removal.boundary_answer, firmware::BoundaryAnswer::kRefuse);
  EXPECT_EQ(removal.boundary_limit, 0.25f);
  const auto deletion = data->mesh(1).vertex_deletion();
  EXPECT_EQ(data->mesh(1).method, Method::kVertexDeletion);
  EXPECT_EQ(deletion.area, 1);
  EXPECT_EQ(deletion.boundary_area, 5);
  EXPECT_EQ(deletion.protrusion_penalty, 10);
  EXPECT_EQ(data->mesh(0).vertex_deletion().area, firmware::VertexDeletionSettings{}.area) << "not another method's";
}

TEST(Appearance, WhatIsAbsentIsTheDefault) {
  const RomImage rom = Drawing().rom();
  const auto data = DrawingData::open(rom.bytes());
  ASSERT_TRUE(data.ok());
  const MeshView plain = data->mesh(2);
  EXPECT_TRUE(plain.texture_coordinates.empty());
  EXPECT_TRUE(plain.edge_values.empty());
  EXPECT_EQ(plain.material.number, kAbsent);
  EXPECT_FALSE(plain.material.texture.present());
  EXPECT_EQ(plain.material.alpha_mode, firmware::format::AlphaMode::kOpaque);
  EXPECT_EQ(plain.method, Method::kQem);
  EXPECT_EQ(plain.edge_removal().b, firmware::EdgeRemovalSettings{}.b);
  EXPECT_EQ(plain.vertex_deletion().boundary_area, firmware::VertexDeletionSettings{}.boundary_area);
}

TEST(Appearance, EveryMethodIsTakenWithAndWithoutSettings) {
  for (std::uint32_t method = 0; method < firmware::kMethodCount; ++method) {
    Drawing drawing;
    drawing.meshes[2].method = static_cast<firmware::format::Method>(method);
    const RomImage rom = drawing.rom();
    const auto data = DrawingData::open(rom.bytes());
    ASSERT_TRUE(data.ok()) << data.status().message;
    EXPECT_EQ(data->mesh(2).method, static_cast<Method>(method));
  }
  Drawing drawing;
  drawing.meshes[2].method = static_cast<firmware::format::Method>(4);
  expect_refused(drawing, StatusCode::kUnsupported, "method of a later release");
}

TEST(Appearance, TextureSizesEndAt4096) {
  Drawing drawing;
  TestTexture& texture = drawing.appearance.textures[1];
  texture.width = 4096;
  texture.height = 1;
  texture.texels.resize(4096);
  EXPECT_TRUE(DrawingData::open(drawing.rom().bytes()).ok());
  texture.width = 4097;
  texture.texels.resize(4097);
  expect_refused(drawing, StatusCode::kDataLoss, "1 to 4096");
  for (auto size : {&TestTexture::width, &TestTexture::height})
    for (std::uint32_t bad : {0u, 4097u, 0xFFFFFFFFu}) {
      drawing = {};
      drawing.appearance.textures[1].*size = bad;
      expect_refused(drawing, StatusCode::kDataLoss, "1 to 4096");
    }
}

TEST(Appearance, TexelsOfAllLevelsLieInTheirSection) {
  // 6 x 5 texels of 4 bytes: levels of 30, 3 x 2 and 1 x 1 texels, 37 words, and no fourth level.
  Drawing drawing;
  drawing.appearance.textures.resize(2);
  TestTexture& texture = drawing.appearance.textures[1];
  texture.width = 6;
  texture.height = 5;
  texture.level_count = 3;
  texture.texels.assign(37, 0xFF000000);
  EXPECT_TRUE(DrawingData::open(drawing.rom().bytes()).ok());
  texture.texels.resize(36);
  expect_refused(drawing, StatusCode::kDataLoss, "outside section TEXL");
  texture.texels.resize(50);
  texture.level_count = 4;
  expect_refused(drawing, StatusCode::kDataLoss, "no level or more than");
  texture.level_count = 0;
  expect_refused(drawing, StatusCode::kDataLoss, "no level or more than");
}

/// Offset of the first section of a type in a container.
std::uint32_t section_at(RomImage& rom, firmware::format::SectionType type) {
  for (std::uint32_t at = 32; at < 32 + 16 * rom[24]; at += 16)
    if (rom[at] == static_cast<std::uint32_t>(type)) return rom[at + 4];
  ADD_FAILURE() << "no such section";
  return 0;
}

struct BadWord {
  firmware::format::SectionType section;
  std::uint32_t offset;
  std::uint32_t value;
  StatusCode code;
  const char* about;
};

TEST(Appearance, EveryWordOfTexturesMaterialsAndSettingsIsChecked) {
  using enum firmware::format::SectionType;
  constexpr auto kLost = StatusCode::kDataLoss, kLater = StatusCode::kUnsupported;
  const std::uint32_t nan = std::bit_cast<std::uint32_t>(kNan), below = std::bit_cast<std::uint32_t>(-0.5f);
  const BadWord cases[] = {
      {kTextures, 0, 4, kLost, "outside section TEXL"},
      {kTextures, 4, 0, kLater, "texture of a format"},
      {kTextures, 4, 4, kLater, "texture of a format"},
      {kTextures, 32 + 24, 0xFFFFFF, kLost, "name lies outside section NAME, of the texture"},
      {kTextures, 20, 4, kLost, "name lies outside section NAME, of the texture"},
      {kTextures, 28, 1, kLater, "texture has settings of a later release"},
      {kMaterials, 0, 2, kLost, "texture that is not there"},
      {kMaterials, 4, 2, kLater, "filter or wrapping"},
      {kMaterials, 8, 3, kLater, "filter or wrapping"},
      {kMaterials, 12, 3, kLater, "filter or wrapping"},
      {kMaterials, 16, 3, kLater, "alpha mode"},
      {kMaterials, 20, 256, kLost, "alpha reference"},
      {kMaterials, 24, 1, kLater, "material has settings of a later release"},
      {kMaterials, 28, 1, kLater, "material has settings of a later release"},
      {kMethods, 0, nan, kLost, "setting of edge removal"},
      {kMethods, 4, below, kLost, "setting of edge removal"},
      {kMethods, 8, 0x7F800000, kLost, "setting of edge removal"},
      {kMethods, 12, below, kLost, "setting of edge removal"},
      {kMethods, 16, nan, kLost, "setting of edge removal"},
      {kMethods, 20, 5, kLater, "placement or boundary answer"},
      {kMethods, 24, 2, kLater, "placement or boundary answer"},
      {kMethods, 28, below, kLost, "setting of edge removal"},
      {kMethods, 32, 1, kLater, "edge removal has settings of a later release"},
      {kMethods, 36, 1, kLater, "edge removal has settings of a later release"},
      {kEdgeValues, 4, nan, kLost, "edge value"},
      {kEdgeValues, 4, below, kLost, "edge value"},
      {kEdgeValues, 8, std::bit_cast<std::uint32_t>(-2.0f), kLost, "edge value"},
      {kEdgeValues, 0, 0x7F800000, kLost, "edge value"},
      {kTextureCoordinates, 8, nan, kLost, "texture coordinate"},
      {kTextureCoordinates, 20, 0xFF800000, kLost, "texture coordinate"},
      {kMeshes, 64, 2, kLost, "material that is not there"},
      {kMeshes, 64, 0xFFFFFFFE, kLost, "material that is not there"},
      {kMeshes, 60, kAbsent, kLost, "a texture but no texture coordinates"},
      {kMeshes, 60, 0, kLost, "outside section TXCO"},
      {kMeshes, 68, 4, kLost, "outside section METH"},
      {kMeshes, 72, 4, kLost, "outside section EDGV"},
      {kMeshes, 76, 4, kLost, "outside section LAYR"},
      {kMeshes, 44, 2, kLost, "method that has none"},
  };
  for (const BadWord& bad : cases) {
    RomImage rom = Drawing().rom();
    const std::uint32_t at = section_at(rom, bad.section) + bad.offset;
    ASSERT_NE(rom[at], bad.value);
    rom[at] = bad.value;
    seal(rom);
    expect_refused(rom, bad.code, bad.about);
  }
}

TEST(Appearance, EveryNumberOfVertexDeletionIsChecked) {
  for (std::size_t word = 0; word < 10; ++word)
    for (const float bad : {-1.0f, kNan, kInfinity}) {
      Drawing drawing;
      drawing.meshes[1].method_settings[word] = std::bit_cast<std::uint32_t>(bad);
      expect_refused(drawing, StatusCode::kDataLoss, "setting of vertex deletion");
    }
}

TEST(Appearance, TextureCoordinatesReachToTenThousand) {
  for (const float edge : {1e4f, -1e4f}) {
    Drawing drawing;
    drawing.meshes[0].texture_coordinates[1].t = edge;
    EXPECT_TRUE(DrawingData::open(drawing.rom().bytes()).ok()) << edge;
    drawing.meshes[0].texture_coordinates[1].t = std::nextafter(edge, 2 * edge);
    RomImage rom = drawing.rom();
    expect_refused(rom, StatusCode::kDataLoss, "texture coordinate is beyond");
    EXPECT_EQ(DrawingData::open(rom.bytes()).status().where,
              section_at(rom, firmware::format::SectionType::kTextureCoordinates) + 12)
        << "that coordinate";
  }
}

TEST(Appearance, OffsetsOf32BitsDoNotWrap) {
  for (const std::uint32_t word : {60u, 68u, 72u})
    for (const std::uint32_t bad : {0xFFFFFFFCu, 0xFFFFFFF0u, 0x80000000u, 0xFFFFFFFDu}) {
      RomImage rom = Drawing().rom();
      rom[section_at(rom, firmware::format::SectionType::kMeshes) + word] = bad;
      seal(rom);
      expect_refused(rom, StatusCode::kDataLoss, "outside section");
    }
}

TEST(Appearance, OffsetsInsideASectionAreAligned) {
  for (const std::uint32_t word : {60u, 68u, 72u}) {
    Drawing drawing;
    drawing.meshes.push_back(drawing.meshes[0]);  // room behind the first mesh's streams
    RomImage rom = drawing.rom();
    rom[section_at(rom, firmware::format::SectionType::kMeshes) + word] += 2;
    seal(rom);
    expect_refused(rom, StatusCode::kDataLoss, "outside section");
  }
}

TEST(Appearance, SectionsHoldWholeTexturesAndMaterials) {
  using enum firmware::format::SectionType;
  for (const auto& [type, about] : {std::pair{kTextures, "whole number of textures"},
                                    std::pair{kMaterials, "whole number of materials"}}) {
    RomImage rom = Drawing().rom();
    for (std::uint32_t at = 32; at < 32 + 16 * rom[24]; at += 16)
      if (rom[at] == static_cast<std::uint32_t>(type)) rom[at + 8] -= 4;
    seal(rom);
    expect_refused(rom, StatusCode::kDataLoss, about);
  }
}

TEST(Appearance, AMeshMayHaveSeveralMaterials) {
  const RomImage rom = Drawing().with_groups().rom();
  const auto data = DrawingData::open(rom.bytes());
  ASSERT_TRUE(data.ok()) << data.status().message << " " << data.status().where;
  const MeshView mesh = data->mesh(3);
  ASSERT_EQ(mesh.group_count(), 2u);
  EXPECT_EQ(mesh.group(0).material, kAbsent);
  EXPECT_EQ(mesh.group(0).base_colour, 0xFF0000FFu);
  EXPECT_EQ(mesh.group(1).face_end, 2u);
  EXPECT_EQ(mesh.group(1).vertex_end, 6u);
  EXPECT_TRUE(data->material(mesh.group(1).material).texture.present());
  EXPECT_FALSE(data->material(mesh.group(0).material).texture.present());
  EXPECT_EQ(data->mesh(0).group_count(), 1u);
  EXPECT_EQ(data->mesh(0).group(0).material, 1u);
  EXPECT_EQ(data->mesh(0).group(0).face_end, 1u);
  EXPECT_EQ(data->mesh(0).group(0).vertex_end, 3u);
  EXPECT_TRUE(mesh.textured);
  EXPECT_TRUE(data->mesh(0).textured);
  EXPECT_FALSE(data->mesh(1).textured);
}

TEST(Appearance, GroupsCoverTheirMeshAndShareNoVertex) {
  const auto refused = [](std::vector<firmware::format::FaceGroup> groups, const char* about) {
    Drawing drawing;
    drawing.with_groups().meshes[3].groups = std::move(groups);
    expect_refused(drawing, StatusCode::kDataLoss, about);
  };
  refused({{1, 3, 1, 0}}, "do not cover");
  refused({{2, 6, 1, 0}, {2, 7, 1, 0}}, "leave their mesh");
  refused({{2, 6, 1, 0}, {3, 6, 1, 0}}, "leave their mesh");
  refused({{2, 6, 1, 0}, {1, 6, 1, 0}}, "overlap");
  refused({{1, 3, 1, 0}, {2, 2, 1, 0}}, "overlap");
  refused({{1, 2, 1, 0}, {2, 6, 1, 0}}, "vertex of another group");
  refused({{1, 4, 1, 0}, {2, 6, 1, 0}}, "vertex of another group");
  refused({{1, 3, 1, 0}, {2, 6, 2, 0}}, "material that is not there");
  Drawing drawing;
  drawing.with_groups().meshes[3].texture_coordinates.clear();
  expect_refused(drawing, StatusCode::kDataLoss, "no texture coordinates");
  drawing = {};
  drawing.with_groups().meshes[3].indices.clear();
  expect_refused(drawing, StatusCode::kDataLoss, "groups but no indices");
  for (std::uint32_t bad : {0u, 0xFFFFFFFFu, 0xFFFFFFFCu, 0x7FFFFFFCu}) {
    RomImage rom = Drawing().with_groups().rom();
    rom[section_at(rom, firmware::format::SectionType::kMeshes) + 3 * 80 + 64] = bad;
    seal(rom);
    expect_refused(rom, StatusCode::kDataLoss, "outside section GRUP");
  }
  for (std::uint32_t count : {3u, 0x10000000u, 0xFFFFFFFFu}) {  // 16 * 0x10000000 wraps past 2^32
    RomImage rom = Drawing().with_groups().rom();
    rom[section_at(rom, firmware::format::SectionType::kMeshes) + 3 * 80 + 64] =
        section_at(rom, firmware::format::SectionType::kGroups) + 12;  // the last mesh's
    rom[section_at(rom, firmware::format::SectionType::kGroups) + 12] = count;
    seal(rom);
    expect_refused(rom, StatusCode::kDataLoss, "outside section GRUP");
  }
}

TEST(Appearance, GroupsOfNarrowIndicesAreCheckedToo) {
  // The same mesh with 2-byte indices, made by hand: 0 1 2 and 3 4 5 as three words.
  for (const std::uint32_t last : {0x00050004u, 0x00050002u}) {
    RomImage rom = Drawing().with_groups().rom();
    const std::uint32_t descriptor = section_at(rom, firmware::format::SectionType::kMeshes) + 3 * 80;
    rom[descriptor + 16] = 2;
    const std::uint32_t indices = rom[descriptor + 8];
    rom[indices] = 0x00010000;
    rom[indices + 4] = 0x00030002;
    rom[indices + 8] = last;
    seal(rom);
    if (last == 0x00050004u) EXPECT_TRUE(DrawingData::open(rom.bytes()).ok());
    else expect_refused(rom, StatusCode::kDataLoss, "vertex of another group");
  }
}

TEST(Appearance, EveryPrefixAndEverySingleFlippedBitIsRefused) {
  RomImage rom = Drawing().with_groups().rom();
  for (std::size_t n = 0; n < rom.bytes().size(); ++n) EXPECT_FALSE(DrawingData::open(rom.bytes().first(n)).ok()) << n;
  for (std::size_t bit = 0; bit < 8 * rom.bytes().size(); ++bit) {
    if (bit / 8 == 8 || bit / 8 == 9) continue;  // version_minor: another minor version reads the same
    rom.writable()[bit / 8] ^= std::byte(1u << bit % 8);
    EXPECT_FALSE(DrawingData::open(rom.bytes()).ok()) << "byte " << bit / 8 << " bit " << bit % 8;
    rom.writable()[bit / 8] ^= std::byte(1u << bit % 8);
  }
}

/// Goes through everything that a view offers, so that a sanitizer sees what lies outside; a sum of it.
std::uint64_t walk(const MeshView& mesh, const RomImage& rom) {
  std::uint64_t sum = 0;
  const auto inside = [&](const void* first, std::size_t bytes) {
    const auto* p = static_cast<const std::byte*>(first);
    EXPECT_TRUE(bytes == 0 || (p >= rom.bytes().data() && p + bytes <= rom.bytes().data() + rom.bytes().size()));
    for (std::size_t i = 0; i < bytes; ++i) sum += static_cast<std::uint64_t>(p[i]);
  };
  inside(mesh.texture_coordinates.data(), mesh.texture_coordinates.size_bytes());
  inside(mesh.edge_values.data(), mesh.edge_values.size_bytes());
  inside(mesh.material.texture.texels.data(), mesh.material.texture.texels.size());
  inside(mesh.material.texture.name.data(), mesh.material.texture.name.size());
  if (mesh.method_settings != nullptr) inside(mesh.method_settings, 40);
  for (const TexCoord& c : mesh.texture_coordinates) EXPECT_TRUE(std::fabs(c.s) <= 1e4f && std::fabs(c.t) <= 1e4f);
  for (const float value : mesh.edge_values) EXPECT_TRUE(value == -1 || (value >= 0 && std::isfinite(value)));
  EXPECT_TRUE(mesh.edge_removal().a >= 0 && mesh.vertex_deletion().limit_move >= 0);
  EXPECT_TRUE(!mesh.material.texture.present() || mesh.texture_coordinates.size() == mesh.positions.size());
  inside(mesh.groups.data(), mesh.groups.size_bytes());
  const firmware::format::FaceGroup last = mesh.group(mesh.group_count() - 1);
  EXPECT_TRUE(last.face_end == mesh.face_count() && last.vertex_end == mesh.positions.size());
  return sum;
}

TEST(Appearance, AnyWordSetToNonsenseUnderAGoodCrcIsRefusedOrHarmless) {
  const RomImage good = Drawing().with_groups().rom();
  std::uint32_t accepted = 0;
  for (std::uint32_t at = 24; at < good.size(); at += 4) {
    for (std::uint32_t value : {0u, 1u, 2u, 3u, 5u, 4096u, 4097u, 0x7FC00000u, 0x7FFFFFFFu, 0x80000000u, 0xBF800000u,
                                0xFFFFFFF0u, 0xFFFFFFFEu, 0xFFFFFFFFu}) {
      RomImage rom = good;
      rom[at] = value;
      seal(rom);
      const auto data = DrawingData::open(rom.bytes());
      if (!data.ok()) continue;
      ++accepted;
      for (std::uint32_t n = 0; n < data->mesh_max(); ++n) walk(data->mesh(n), rom);
      for (std::uint32_t n = 0; n < data->texture_count(); ++n) EXPECT_FALSE(data->texture(n).texels.empty());
      ASSERT_FALSE(HasFailure()) << "word at " << at << " = " << value;
    }
  }
  EXPECT_GT(accepted, 0u);
}

}  // namespace
}  // namespace usuzumi
