// Section LAYR of a container: found, checked, and told of by its offset in the file.
#include <gtest/gtest.h>

#include <cstring>

#include "firmware/drawing_data/drawing_data.h"
#include "firmware/drawing_data/mesh_layers.h"
#include "firmware/layers/layer_chain.h"
#include "tests/support/mesh_shapes.h"
#include "tests/support/rom_builder.h"

namespace usuzumi {
namespace {

using firmware::DrawingData;

constexpr std::uint32_t kQuotas[] = {1'000'000, 600'000, 360'000};
constexpr std::size_t kDescriptorBytes = 80, kLayerOffsetAt = 76;

testing::TestMesh sphere(Vec3 centre, bool groups) {
  const testing::Mesh shape = testing::icosphere(2);
  testing::TestMesh mesh;
  mesh.level = 3;
  mesh.method = firmware::format::Method::kHalfEdge;
  const std::uint32_t count = groups ? 2 : 1;
  const auto vertices = static_cast<std::uint32_t>(shape.positions.size());
  for (std::uint32_t g = 0; g < count; ++g) {
    for (const std::uint32_t v : shape.indices) mesh.indices.push_back(g * vertices + v);
    for (const Vec3 p : shape.positions) {
      mesh.positions.push_back(p + centre + Vec3{0, 3, 0} * static_cast<float>(g));
      mesh.normals.push_back(pack_normal(p));
    }
    if (groups)
      mesh.groups.push_back({static_cast<std::uint32_t>(mesh.indices.size() / 3),
                             static_cast<std::uint32_t>(mesh.positions.size()), firmware::format::kAbsent, 0xFFu});
  }
  return mesh;
}

/// A container of a mesh without layers and two with them, one of several materials.
testing::RomImage layered_rom() {
  std::vector<testing::TestMesh> meshes{sphere({0, 0, 0}, false), sphere({5, 0, 0}, false), sphere({9, 0, 0}, true)};
  const testing::RomImage plain = testing::container_rom(meshes);
  const auto data = DrawingData::open(plain.bytes());
  EXPECT_TRUE(data.ok()) << data.status().message;
  for (std::uint32_t n = 1; n < 3; ++n) {
    const firmware::MeshView mesh = data->mesh(n);
    std::vector<std::byte> memory(firmware::mesh_layers_bytes(mesh, mesh.proper_face_count()));
    Arena arena(memory);
    const auto made = firmware::make_mesh_layers(mesh, mesh.proper_face_count(), kQuotas,
                                                 firmware::Placement::kOptimal, arena);
    EXPECT_TRUE(made.ok()) << made.status().message << " " << made.status().where;
    meshes[n].layers.resize(made->size() / 4);
    std::memcpy(meshes[n].layers.data(), made->data(), made->size());
  }
  return testing::container_rom(meshes);
}

TEST(DrawingDataLayers, MeshesHaveTheChainsThatThePackerWrote) {
  const testing::RomImage rom = layered_rom();
  const auto data = DrawingData::open(rom.bytes());
  ASSERT_TRUE(data.ok()) << data.status().message << " " << data.status().where;
  EXPECT_TRUE(data->mesh(0).layers.empty());
  for (std::uint32_t n = 1; n < 3; ++n) {
    const auto chain = firmware::LayerChainView::of_checked(data->mesh(n).layers);
    EXPECT_EQ(chain.layer_count(), 3u);
    EXPECT_EQ(chain.face_count(), data->mesh(n).face_count());
    EXPECT_EQ(chain.group_count(), n);
  }
}

TEST(DrawingDataLayers, WhatIsWrongIsToldByItsPlaceInTheFile) {
  const testing::RomImage good = layered_rom();
  const auto data = DrawingData::open(good.bytes());
  ASSERT_TRUE(data.ok());
  const auto chain_at = [&](std::uint32_t n) {
    return static_cast<std::uint32_t>(data->mesh(n).layers.data() - good.bytes().data());
  };
  const auto status_with = [&](std::size_t offset, std::uint32_t value) {
    testing::RomImage rom = good;
    rom[offset] = value;
    testing::seal(rom);
    return DrawingData::open(rom.bytes()).status();
  };
  const Status vertices = status_with(chain_at(1) + 4, 3);
  EXPECT_EQ(vertices.code, StatusCode::kDataLoss);
  EXPECT_EQ(vertices.where, chain_at(1) + 4);
  const Status size = status_with(chain_at(2), 0x10000000);
  EXPECT_EQ(size.code, StatusCode::kDataLoss);
  EXPECT_EQ(size.where, chain_at(2));

  const std::uint32_t end = good.size();
  const std::size_t descriptor = end - 2 * kDescriptorBytes;  // MSHD comes last; mesh 1
  EXPECT_EQ(status_with(descriptor + kLayerOffsetAt, chain_at(2)).code, StatusCode::kDataLoss) << "another mesh's";
  EXPECT_EQ(status_with(descriptor + kLayerOffsetAt, chain_at(1) + 4).code, StatusCode::kDataLoss);
  EXPECT_EQ(status_with(descriptor + kLayerOffsetAt, chain_at(1) + 2).code, StatusCode::kDataLoss);
  for (const std::uint32_t outside : {4u, end - 4, end, 0xFFFFFFFCu}) {
    const Status status = status_with(descriptor + kLayerOffsetAt, outside);
    EXPECT_EQ(status.code, StatusCode::kDataLoss);
    EXPECT_EQ(status.where, descriptor);
  }
}

TEST(DrawingDataLayers, AFaceInTheSlotOfAnotherMaterialIsRefused) {
  testing::RomImage rom = layered_rom();
  const auto data = DrawingData::open(rom.bytes());
  ASSERT_TRUE(data.ok());
  const auto chain = firmware::LayerChainView::of_checked(data->mesh(2).layers);
  const std::size_t slots = static_cast<std::size_t>(data->mesh(2).layers.data() - rom.bytes().data()) + 56 +
                            16 * chain.layer_count() + 4 * chain.group_count() + 8 * chain.step_count();
  std::swap(rom[slots], rom[slots + 4 * (chain.face_count() - 1)]);  // the first face and the last
  testing::seal(rom);
  EXPECT_EQ(DrawingData::open(rom.bytes()).status().code, StatusCode::kDataLoss);
}

}  // namespace
}  // namespace usuzumi
