// Command lists of textured meshes and of those of several materials, packet by packet.
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "firmware/device/scene_commands.h"
#include "tests/support/test_layers.h"
#include "tests/support/thinning_bench.h"

namespace usuzumi {
namespace {

using testing::container_rom;
using testing::five_materials;
using testing::hills;
using testing::mapped_hills;
using testing::TestMesh;
using testing::ThinningBench;
using testing::two_hills;

constexpr BusAddress kRom = 0x10000000, kRam = 0x50000000;

/// Blocks stand in the order in which they were built.
const std::byte* lowest_block(const ThinningBench& bench) {
  const std::byte* lowest = nullptr;
  for (std::uint32_t n = 0; n < bench.copy().mesh_max(); ++n)
    if (bench.copy().present(n) && (lowest == nullptr || bench.copy().block(n) < lowest))
      lowest = bench.copy().block(n);
  return lowest;
}
BusAddress block_address(const ThinningBench& bench, std::uint32_t n) {
  return kRam + static_cast<BusAddress>(bench.copy().block(n) - lowest_block(bench));
}

/// The copy's memory at kRam, and the drawing data at kRom where the engine reaches them.
class TwoMemories final : public AddressTranslation {
 public:
  explicit TwoMemories(const ThinningBench& bench, bool rom_on_bus = true)
      : ram_{lowest_block(bench), bench.copy().used_bytes()}, rom_(rom_on_bus ? bench.rom().bytes() : Bytes{}) {}

 private:
  using Bytes = std::span<const std::byte>;
  BusAddress do_bus_address(const void* pointer) const override {
    const auto* p = static_cast<const std::byte*>(pointer);
    if (p >= ram_.data() && p < ram_.data() + ram_.size()) return kRam + static_cast<BusAddress>(p - ram_.data());
    if (p >= rom_.data() && p < rom_.data() + rom_.size()) return kRom + static_cast<BusAddress>(p - rom_.data());
    return 0;
  }
  Bytes ram_, rom_;
};

/// A draw and the state it is drawn with.
struct Drawn {
  command::Draw draw;
  command::SetVertexStreams streams;
  command::SetRasterState raster;
  command::SetTexture texture;
  command::SetFragmentState fragment;
};
struct Walked {
  std::vector<Drawn> draws;
  std::size_t textures_set = 0, fragment_states_set = 0;
};

template <class Packet>
void read(std::span<const std::uint32_t> payload, Packet& packet) {
  ASSERT_EQ(payload.size_bytes(), sizeof packet);
  std::memcpy(static_cast<void*>(&packet), payload.data(), sizeof packet);
}

Walked walk(std::span<const std::uint32_t> words) {
  Walked result;
  Drawn now;
  for (std::size_t at = 0; at < words.size(); at += 1 + (words[at] & 0xFFFF)) {
    const auto payload = words.subspan(at + 1, words[at] & 0xFFFF);
    switch (static_cast<command::Opcode>(words[at] >> 24)) {
      case command::Opcode::kSetVertexStreams: read(payload, now.streams); break;
      case command::Opcode::kSetRasterState: read(payload, now.raster); break;
      case command::Opcode::kSetTexture:
        read(payload, now.texture);
        ++result.textures_set;
        break;
      case command::Opcode::kSetFragmentState:
        read(payload, now.fragment);
        ++result.fragment_states_set;
        break;
      case command::Opcode::kDraw:
        read(payload, now.draw);
        result.draws.push_back(now);
        break;
      default: break;
    }
  }
  return result;
}

constexpr firmware::FrameTarget kTarget{0x80000000, 448, command::PixelFormat::kXrgb8888,
                                        0x80040000, 448, command::DepthFormat::kUnorm24};

Walked drawn(ThinningBench& bench, const firmware::ThinningSettings& settings = {}) {
  EXPECT_TRUE(bench.update(settings).ok());
  std::vector<std::uint32_t> words(firmware::scene_command_words(bench.thinning.data()));
  const auto list = write_scene(bench.thinning, testing::flat_view(), {}, kTarget, TwoMemories(bench), words);
  EXPECT_TRUE(list.ok()) << list.status().message;
  return walk(*list);
}

/// Which mesh a draw is of, by where its vertices lie.
std::uint32_t mesh_of(const ThinningBench& bench, const Drawn& draw) {
  for (std::uint32_t n = 0; n < bench.copy().mesh_max(); ++n)
    if (bench.copy().present(n) && draw.streams.positions == block_address(bench, n)) return n;
  ADD_FAILURE() << "vertices lie elsewhere";
  return 0xFFFFFFFF;
}

TEST(TexturedScene, ReadsTheTextureFromRomAndTheCoordinatesFromTheCopy) {
  for (const bool thinned : {true, false}) {
    firmware::ThinningSettings settings;
    settings.enabled = thinned;
    ThinningBench bench(container_rom({mapped_hills(4, 3, 4)}, five_materials()));
    const Walked list = drawn(bench, settings);
    ASSERT_EQ(list.draws.size(), 1u);
    const Drawn& draw = list.draws[0];
    const auto texels = bench.thinning.data().texture(1).texels;
    EXPECT_EQ(draw.texture.format, command::TextureFormat::kArgb8888);
    EXPECT_EQ(draw.texture.base, kRom + static_cast<BusAddress>(texels.data() - bench.rom().bytes().data()));
    EXPECT_EQ(draw.texture.width, 1u);
    EXPECT_EQ(draw.texture.height, 1u);
    EXPECT_EQ(draw.texture.level_count, 1u);
    EXPECT_EQ(draw.texture.filter, command::TextureFilter::kNearest);
    EXPECT_EQ(draw.texture.wrap_s, command::TextureWrap::kClamp);
    EXPECT_EQ(draw.texture.wrap_t, command::TextureWrap::kMirror);
    EXPECT_EQ(draw.streams.texture_coordinates, kRam + bench.copy().mesh(0).texture_coordinate_offset);
    EXPECT_EQ(draw.streams.texture_coordinate_stride, 8u);
  }
}

TEST(TexturedScene, SetsATextureWhereItChanges) {
  ThinningBench bench(container_rom({hills(2, 1), mapped_hills(2, 1, 0), mapped_hills(2, 1, 0), mapped_hills(2, 1, 1),
                                     mapped_hills(2, 1, 4), mapped_hills(2, 1, 0)},
                                    five_materials()));
  const Walked list = drawn(bench);
  EXPECT_EQ(list.textures_set, 4u);
  EXPECT_EQ(list.fragment_states_set, 0u);
  using enum command::TextureFormat;
  const command::TextureFormat expected[] = {kNone, kRgb565, kRgb565, kNone, kArgb8888, kRgb565};
  ASSERT_EQ(list.draws.size(), 6u);
  for (std::size_t n = 0; n < 6; ++n) {
    EXPECT_EQ(mesh_of(bench, list.draws[n]), n);
    EXPECT_EQ(list.draws[n].texture.format, expected[n]) << n;
    EXPECT_EQ(list.draws[n].raster.depth_write, 1u);
  }
  EXPECT_EQ(list.draws[3].streams.texture_coordinates, 0u) << "of a mesh without a texture";
}

TEST(TexturedScene, UntexturedDataTakeNoWordMoreForWhatTheyHaveNot) {
  ThinningBench plain(container_rom({hills(2, 1), hills(2, 1)})),
      coordinates(container_rom({mapped_hills(2, 1, 1), mapped_hills(2, 1, 1)}, five_materials()));
  EXPECT_EQ(firmware::scene_command_words(plain.thinning.data()),
            firmware::scene_command_words(coordinates.thinning.data()));
  EXPECT_EQ(drawn(plain).textures_set, 0u);
  EXPECT_EQ(drawn(coordinates).textures_set, 0u);
}

TEST(TexturedScene, MaskedPartsAreTestedAndBlendedOnesComeLastWithoutWritingDepth) {
  // Blended, masked, blended, opaque.
  ThinningBench bench(container_rom(
      {mapped_hills(2, 1, 3), mapped_hills(2, 1, 2), mapped_hills(2, 1, 3), hills(2, 1)}, five_materials()));
  const Walked list = drawn(bench);
  ASSERT_EQ(list.draws.size(), 4u);
  const std::uint32_t order[] = {1, 3, 0, 2};
  for (std::size_t i = 0; i < 4; ++i) {
    const Drawn& draw = list.draws[i];
    EXPECT_EQ(mesh_of(bench, draw), order[i]);
    EXPECT_EQ(draw.raster.depth_write, i < 2 ? 1u : 0u);
    EXPECT_EQ(draw.raster.depth_test, 1u);
    EXPECT_EQ(draw.fragment.blend, i < 2 ? command::BlendMode::kNone : command::BlendMode::kAlpha);
    EXPECT_EQ(draw.fragment.alpha_test, i == 0 ? 1u : 0u);
  }
  EXPECT_EQ(list.draws[0].fragment.alpha_reference, 77u);
  EXPECT_EQ(list.fragment_states_set, 3u);
}

TEST(TexturedScene, EveryGroupIsDrawnWithItsMaterialAndColour) {
  for (const std::uint32_t level : {1u, 3u}) {
    ThinningBench bench(container_rom({two_hills(6, level, 0, 4)}, five_materials()));
    const Walked list = drawn(bench);
    ASSERT_EQ(list.draws.size(), 2u);
    const std::uint32_t faces = bench.copy().mesh(0).faces;
    const std::uint32_t end = level == 1 ? 72 : bench.copy().group_words(0)[0];
    EXPECT_EQ(list.draws[0].draw.first, 0u);
    EXPECT_EQ(list.draws[0].draw.count, 3 * end);
    EXPECT_EQ(list.draws[1].draw.first, 3 * end);
    EXPECT_EQ(list.draws[1].draw.count, 3 * (faces - end));
    EXPECT_EQ(list.draws[0].texture.format, command::TextureFormat::kRgb565);
    EXPECT_EQ(list.draws[1].texture.format, command::TextureFormat::kArgb8888);
    EXPECT_EQ(list.draws[0].streams.constant_colour, Rgba8{0xFF0000FF});
    EXPECT_EQ(list.draws[1].streams.constant_colour, Rgba8{0xFF00FF00});
    EXPECT_EQ(list.draws[0].draw.index_address, list.draws[1].draw.index_address);
  }
}

TEST(TexturedScene, OfALayeredMeshTheFirstSlotsOfEveryGroupAreDrawn) {
  constexpr std::uint32_t kQuotas[] = {1'000'000, 500'000};
  TestMesh mesh = two_hills(6, 3, 0, 4);
  mesh.normals.assign(mesh.positions.size(), pack_normal({0, 0, 1}));
  ThinningBench bench(container_rom({testing::with_layers(mesh, kQuotas, five_materials())}, five_materials()));
  const Walked list = drawn(bench);
  ASSERT_TRUE(bench.copy().mesh(0).layered);
  ASSERT_EQ(list.draws.size(), 2u);
  EXPECT_LE(bench.copy().mesh(0).faces, 72u);
  EXPECT_EQ(list.draws[0].draw.first, 0u);
  EXPECT_EQ(list.draws[1].draw.first, 3u * 72) << "the second group's slots lie where its faces would";
  const auto indices = bench.indices(0);
  const auto vertices = bench.positions(0);
  std::uint32_t faces = 0;
  for (const std::size_t g : {0u, 1u}) {
    const command::Draw& draw = list.draws[g].draw;
    faces += draw.count / 3;
    for (std::uint32_t i = draw.first; i < draw.first + draw.count; ++i)
      EXPECT_EQ(vertices[indices[i]].x > 1.5f, g == 1) << "the second hills stand 3 to the right";
  }
  EXPECT_EQ(faces, bench.copy().mesh(0).faces);
  EXPECT_EQ(list.draws[1].texture.format, command::TextureFormat::kArgb8888);
  EXPECT_EQ(list.draws[1].streams.constant_colour, Rgba8{0xFF00FF00});
}

TEST(TexturedScene, AGroupThatThinningHasEmptiedIsNotDrawn) {
  TestMesh mesh = two_hills(6, 3, 0, 4);
  for (std::size_t i = 3 * 72; i < mesh.indices.size(); ++i) mesh.indices[i] = 60;  // of no area, all of the second
  ThinningBench bench(container_rom({mesh}, five_materials()));
  const Walked list = drawn(bench);
  ASSERT_EQ(bench.copy().group_words(0).size(), 2u);
  ASSERT_EQ(list.draws.size(), 1u);
  EXPECT_EQ(list.draws[0].texture.format, command::TextureFormat::kRgb565);
}

TEST(TexturedScene, BlendedGroupsWaitForTheOtherMeshes) {
  ThinningBench bench(container_rom({two_hills(2, 1, 3, 0), hills(2, 1)}, five_materials()));
  const Walked list = drawn(bench);
  ASSERT_EQ(list.draws.size(), 3u);
  EXPECT_EQ(mesh_of(bench, list.draws[0]), 0u);
  EXPECT_EQ(list.draws[0].draw.first, 3u * 8) << "the second group";
  EXPECT_EQ(mesh_of(bench, list.draws[1]), 1u);
  EXPECT_EQ(mesh_of(bench, list.draws[2]), 0u);
  EXPECT_EQ(list.draws[2].draw.first, 0u);
  EXPECT_EQ(list.draws[2].fragment.blend, command::BlendMode::kAlpha);
}

TEST(TexturedScene, AMarkHasTheMaterialOfItsVertex) {
  TestMesh mesh = two_hills(2, 4, 0, 4);
  mesh.positions[0] = {1000, 0, 0};  // the mean lies 55 to the right: the second hills are nearer
  ThinningBench bench(container_rom({mesh}, five_materials()));
  const Walked list = drawn(bench);
  ASSERT_EQ(list.draws.size(), 1u);
  EXPECT_EQ(list.draws[0].draw.topology, command::Topology::kPoints);
  EXPECT_EQ(list.draws[0].draw.count, 1u);
  EXPECT_EQ(list.draws[0].texture.format, command::TextureFormat::kArgb8888);
  EXPECT_EQ(list.draws[0].streams.constant_colour, Rgba8{0xFF00FF00});
}

TEST(TexturedScene, ATextureOutsideTheBusIsRefusedByName) {
  ThinningBench bench(container_rom({hills(2, 1), mapped_hills(2, 1, 0)}, five_materials()));
  ASSERT_TRUE(bench.update().ok());
  std::vector<std::uint32_t> words(firmware::scene_command_words(bench.thinning.data()));
  const Status status =
      write_scene(bench.thinning, testing::flat_view(), {}, kTarget, TwoMemories(bench, false), words).status();
  EXPECT_EQ(status.code, StatusCode::kFailedPrecondition);
  EXPECT_NE(std::string_view(status.message).find("texture"), std::string_view::npos) << status.message;
  EXPECT_EQ(status.where, 1u);
}

TEST(TexturedScene, VerticesThatStayInRomAreReadThere) {
  TestMesh mesh = mapped_hills(8, 3, 0);
  mesh.method = firmware::format::Method::kHalfEdge;
  mesh.normals.assign(mesh.positions.size(), pack_normal({0, 0, 1}));
  mesh.colours.assign(mesh.positions.size(), rgba8(9, 9, 9));
  ThinningBench bench(container_rom({mesh}, five_materials()), 1 << 20, true);
  const Walked list = drawn(bench);
  ASSERT_EQ(list.draws.size(), 1u);
  const command::SetVertexStreams& streams = list.draws[0].streams;
  const firmware::MeshView view = bench.thinning.data().mesh(0);
  const auto in_rom = [&](const auto& stream) {
    return kRom + static_cast<BusAddress>(std::as_bytes(stream).data() - bench.rom().bytes().data());
  };
  EXPECT_EQ(streams.vertex_count, 81u);
  EXPECT_EQ(streams.positions, in_rom(view.positions));
  EXPECT_EQ(streams.normals, in_rom(view.normals));
  EXPECT_EQ(streams.colours, in_rom(view.colours));
  EXPECT_EQ(streams.texture_coordinates, in_rom(view.texture_coordinates));
  EXPECT_EQ(list.draws[0].draw.index_address, kRam);
  EXPECT_EQ(list.draws[0].draw.count, 3 * bench.copy().mesh(0).faces);
}

TEST(TexturedScene, NormalsMadeForVerticesInRomAreReadFromTheCopy) {
  TestMesh mesh = hills(8, 3);
  mesh.method = firmware::format::Method::kHalfEdge;
  mesh.quota_kind = firmware::format::QuotaKind::kMillionths;
  mesh.quota = 800'000;
  ThinningBench bench(container_rom({mesh}), 1 << 20, true);
  const Walked list = drawn(bench);
  ASSERT_TRUE(bench.copy().mesh(0).vertices_in_rom);
  EXPECT_EQ(list.draws[0].streams.normals, kRam + bench.copy().mesh(0).normal_offset);
  EXPECT_EQ(list.draws[0].streams.colours, 0u);
}

TEST(TexturedScene, VerticesOutsideTheBusAreRefused) {
  TestMesh mesh = hills(8, 3);
  mesh.method = firmware::format::Method::kHalfEdge;
  mesh.normals.assign(mesh.positions.size(), pack_normal({0, 0, 1}));
  ThinningBench bench(container_rom({hills(2, 1), mesh}), 1 << 20, true);  // told that the ROM were there
  ASSERT_TRUE(bench.update().ok());
  std::vector<std::uint32_t> words(firmware::scene_command_words(bench.thinning.data()));
  const Status status =
      write_scene(bench.thinning, testing::flat_view(), {}, kTarget, TwoMemories(bench, false), words).status();
  EXPECT_EQ(status.code, StatusCode::kFailedPrecondition);
  EXPECT_NE(std::string_view(status.message).find("vertices"), std::string_view::npos) << status.message;
  EXPECT_EQ(status.where, 1u);
}

TEST(TexturedScene, TheWordsAskedForAreEnoughHoweverMaterialsChange) {
  // Every material after every other, and groups of two.
  std::vector<TestMesh> meshes;
  for (std::uint32_t a = 0; a < 5; ++a)
    for (std::uint32_t b = 0; b < 5; ++b) {
      meshes.push_back(mapped_hills(1, 1, a));
      meshes.push_back(mapped_hills(1, 1, b));
      meshes.push_back(two_hills(1, 1, b, a));
    }
  ThinningBench bench(container_rom(meshes, five_materials()));
  EXPECT_EQ(drawn(bench).draws.size(), 100u);
}

}  // namespace
}  // namespace usuzumi
