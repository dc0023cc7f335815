#include "firmware/drawing_data/drawing_data.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/rom_builder.h"

namespace usuzumi {
namespace {

using firmware::DrawingData;
using firmware::Level;
using firmware::MeshView;
using testing::bare_rom;
using testing::container_rom;
using testing::RomImage;
using testing::seal;
using testing::TestMesh;

std::vector<TestMesh> two_meshes() {
  TestMesh strip;
  strip.level = 2;
  strip.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  strip.name = "plate";
  TestMesh indexed;
  indexed.level = 3;
  indexed.positions = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  indexed.indices = {0, 1, 2, 2, 1, 0};
  indexed.normals = std::vector<PackedNormal>(3, pack_normal({0, 0, 1}));
  indexed.colours = {rgba8(1, 2, 3), rgba8(4, 5, 6), rgba8(7, 8, 9)};
  indexed.quota_kind = firmware::format::QuotaKind::kMillionths;
  indexed.quota = 250'000;
  indexed.area_threshold_px = 400;
  indexed.flags = firmware::format::kFlagTelltale;
  indexed.name = "lamp";
  return {strip, indexed};
}

TEST(BareDrawingData, IsReadWordByWord) {
  // mesh-max 1; 3 vertices, level 2; the words of 1.0f and -2.0f spelled out
  const std::uint32_t words[] = {1, 3, 2, 0x3F800000, 0, 0, 0, 0xC0000000, 0, 0, 0, 0};
  const auto data = DrawingData::open(std::as_bytes(std::span(words)));
  ASSERT_TRUE(data.ok()) << data.status().message;
  EXPECT_TRUE(data->bare());
  EXPECT_EQ(data->mesh_max(), 1u);
  const MeshView mesh = data->mesh(0);
  EXPECT_EQ(mesh.level, Level::kDelete);
  ASSERT_EQ(mesh.positions.size(), 3u);
  EXPECT_EQ(mesh.positions[0], (Vec3{1, 0, 0}));
  EXPECT_EQ(mesh.positions[1], (Vec3{0, -2, 0}));
  EXPECT_EQ(mesh.face_count(), 1u);
  EXPECT_EQ(reinterpret_cast<const std::byte*>(mesh.positions.data()), reinterpret_cast<const std::byte*>(words + 3))
      << "positions are read in place";
}

TEST(BareDrawingData, VertexOrderIsATriangleStripWithAlternatingWinding) {
  const RomImage rom = bare_rom({two_meshes()[0]});
  const auto data = DrawingData::open(rom.bytes());
  ASSERT_TRUE(data.ok());
  std::uint32_t f[3];
  data->mesh(0).face(0, f);
  EXPECT_EQ((std::vector<std::uint32_t>{f, f + 3}), (std::vector<std::uint32_t>{0, 1, 2}));
  data->mesh(0).face(1, f);
  EXPECT_EQ((std::vector<std::uint32_t>{f, f + 3}), (std::vector<std::uint32_t>{2, 1, 3}));
}

TEST(BareDrawingData, AFaceWithTwoCornersAtOnePlaceIsNoProperFace) {
  // Triangles a b c and d e f in one strip: a b c c d d e f repeats two places; -0 is the same place as 0.
  TestMesh mesh;
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{3, 0, 0}, d_again{3, -0.0f, 0}, e{4, 0, 0}, f{3, 1, 0};
  mesh.positions = {a, b, c, c, d, d_again, e, f};
  const RomImage rom = bare_rom({mesh});
  const auto data = DrawingData::open(rom.bytes());
  ASSERT_TRUE(data.ok());
  const MeshView view = data->mesh(0);
  EXPECT_EQ(view.face_count(), 6u);
  EXPECT_EQ(view.proper_face_count(), 2u);
  std::vector<std::uint32_t> proper;
  for (std::uint32_t n = 0; n < 6; ++n) {
    std::uint32_t corners[3];
    if (view.proper_face(n, corners)) proper.push_back(n);
  }
  EXPECT_EQ(proper, (std::vector<std::uint32_t>{0, 5}));
}

TEST(Container, CarriesWhatThePatentsRecordsHaveNoRoomFor) {
  const RomImage rom = container_rom(two_meshes());
  const auto data = DrawingData::open(rom.bytes());
  ASSERT_TRUE(data.ok()) << data.status().message << " " << data.status().where;
  EXPECT_FALSE(data->bare());
  ASSERT_EQ(data->mesh_max(), 2u);
  EXPECT_EQ(data->mesh(0).name, "plate");
  const MeshView lamp = data->mesh(1);
  EXPECT_EQ(lamp.name, "lamp");
  EXPECT_EQ(lamp.level, Level::kCollapse);
  EXPECT_EQ(lamp.face_count(), 2u);
  std::uint32_t f[3];
  lamp.face(1, f);
  EXPECT_EQ((std::vector<std::uint32_t>{f, f + 3}), (std::vector<std::uint32_t>{2, 1, 0}));
  EXPECT_EQ(lamp.colours[2], rgba8(7, 8, 9));
  EXPECT_NEAR(unpack(lamp.normals[0]).z, 1, 1e-6);
  EXPECT_EQ(lamp.quota, 250'000u);
  EXPECT_EQ(lamp.area_threshold_px, 400);
  EXPECT_TRUE(lamp.telltale());
  EXPECT_FALSE(lamp.two_sided());
}

TEST(Container, EveryPrefixIsRefused) {
  const RomImage rom = container_rom(two_meshes());
  const auto bytes = rom.bytes();
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    const auto data = DrawingData::open(bytes.first(n));
    EXPECT_FALSE(data.ok()) << "prefix of " << n << " bytes";
    EXPECT_STRNE(data.status().message, "");
  }
}

TEST(BareDrawingData, EveryPrefixIsRefused) {
  const RomImage rom = bare_rom(two_meshes());
  for (std::size_t n = 0; n < rom.bytes().size(); ++n) EXPECT_FALSE(DrawingData::open(rom.bytes().first(n)).ok()) << n;
}

TEST(Container, EverySingleFlippedBitIsRefused) {
  RomImage rom = container_rom(two_meshes());
  for (std::size_t bit = 0; bit < 8 * rom.bytes().size(); ++bit) {
    // Bits of version_minor may differ: a newer minor version reads the same.
    if (bit / 8 == 8 || bit / 8 == 9) continue;
    rom.writable()[bit / 8] ^= std::byte(1u << bit % 8);
    EXPECT_FALSE(DrawingData::open(rom.bytes()).ok()) << "byte " << bit / 8 << " bit " << bit % 8;
    rom.writable()[bit / 8] ^= std::byte(1u << bit % 8);
  }
}

TEST(Container, AnyWordSetToNonsenseUnderAGoodCrcIsRefusedOrHarmless) {
  const RomImage good = container_rom(two_meshes());
  for (std::uint32_t at = 24; at < good.size(); at += 4) {
    for (std::uint32_t value : {0u, 1u, 3u, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFF0u, 0xFFFFFFFEu, 0xFFFFFFFFu}) {
      RomImage rom = good;
      rom[at] = value;
      seal(rom);
      const auto data = DrawingData::open(rom.bytes());
      if (!data.ok()) continue;
      for (std::uint32_t n = 0; n < data->mesh_max(); ++n) {  // what was accepted can be walked through
        const MeshView mesh = data->mesh(n);
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
          std::uint32_t v[3];
          mesh.face(f, v);
          for (std::uint32_t i : v) ASSERT_LT(i, mesh.positions.size()) << "word at " << at << " = " << value;
        }
      }
    }
  }
}

void expect_refused(const RomImage& rom, StatusCode code, const char* about) {
  const auto data = DrawingData::open(rom.bytes());
  EXPECT_EQ(data.status().code, code);
  EXPECT_NE(std::string(data.status().message).find(about), std::string::npos) << data.status().message;
}

TEST(Container, SaysWhatIsWrong) {
  RomImage rom = container_rom(two_meshes());
  rom[4] = 0x04030201;
  expect_refused(rom, StatusCode::kDataLoss, "byte-order");
  rom = container_rom(two_meshes());
  rom[0] = __builtin_bswap32(rom[0]);
  expect_refused(rom, StatusCode::kDataLoss, "big-endian");
  rom = container_rom(two_meshes());
  rom[8] = 0x00020000;
  expect_refused(rom, StatusCode::kUnsupported, "version");
  rom = container_rom(two_meshes());
  rom.word(0);
  expect_refused(rom, StatusCode::kDataLoss, "too long");
  rom = container_rom(two_meshes());
  rom[60] ^= 1;
  expect_refused(rom, StatusCode::kDataLoss, "CRC");
  rom = container_rom(two_meshes());
  rom[0] = 0x46546C67;  // "glTF": no magic of ours, and as mesh-max too many
  expect_refused(rom, StatusCode::kDataLoss, "no drawing data");
}

TEST(DrawingDataTest, RefusesCountsThatOverflow) {
  RomImage rom = bare_rom({two_meshes()[0]});
  for (std::uint32_t count :
       {5u, 0x15555555u, 0x15555556u, 0x40000000u, 0xFFFFFFFFu}) {  // 12 * 0x15555556 wraps past 2^32
    rom[4] = count;
    EXPECT_FALSE(DrawingData::open(rom.bytes()).ok()) << count;
  }
}

TEST(DrawingDataTest, RefusesCoordinatesThatAreNotNumbers) {
  for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                    -std::numeric_limits<float>::infinity()}) {
    auto meshes = two_meshes();
    meshes[0].positions[1].z = bad;
    const RomImage rom = bare_rom(meshes);
    const auto data = DrawingData::open(rom.bytes());
    EXPECT_EQ(data.status().code, StatusCode::kDataLoss);
    EXPECT_EQ(data.status().where, 12u + 12u + 8u) << "offset of that coordinate";
  }
}

TEST(DrawingDataTest, CoordinatesReachToAHundredMillion) {
  for (const float edge : {1e8f, -1e8f}) {
    auto meshes = two_meshes();
    meshes[0].positions[1].y = edge;
    EXPECT_TRUE(DrawingData::open(bare_rom(meshes).bytes()).ok()) << edge;
    EXPECT_TRUE(DrawingData::open(container_rom(meshes).bytes()).ok()) << edge;
    for (const float beyond : {std::nextafter(edge, 2 * edge), edge * 3e30f}) {
      meshes[0].positions[1].y = beyond;
      expect_refused(bare_rom(meshes), StatusCode::kDataLoss, "beyond");
      EXPECT_EQ(DrawingData::open(bare_rom(meshes).bytes()).status().where, 12u + 12u + 4u) << "that coordinate";
      expect_refused(container_rom(meshes), StatusCode::kDataLoss, "beyond");
    }
  }
}

TEST(DrawingDataTest, RefusesEmptyDrawings) {
  RomImage none;
  none.word(0);
  expect_refused(none, StatusCode::kDataLoss, "mesh-max is 0");
  RomImage hollow;
  for (std::uint32_t w : {1u, 0u, 1u}) hollow.word(w);
  expect_refused(hollow, StatusCode::kDataLoss, "no vertices");
}

TEST(DrawingDataTest, RefusesAnUnknownLevel) {
  RomImage rom = bare_rom(two_meshes());
  rom[8] = 6;
  expect_refused(rom, StatusCode::kDataLoss, "level");
}

}  // namespace
}  // namespace usuzumi
