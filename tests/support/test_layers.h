// Chains of layers for meshes of drawing data in tests, made by the firmware's own method.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "firmware/drawing_data/drawing_data.h"
#include "firmware/drawing_data/mesh_layers.h"
#include "tests/support/rom_builder.h"

namespace usuzumi::testing {

/// The mesh with its chain; it must have normals.
inline TestMesh with_layers(TestMesh mesh, std::span<const std::uint32_t> quotas_millionths,
                            const TestAppearance& appearance = {}) {
  const RomImage rom = container_rom({mesh}, appearance);
  const auto data = firmware::DrawingData::open(rom.bytes());
  EXPECT_TRUE(data.ok()) << data.status().message;
  const firmware::MeshView view = data->mesh_at(0, data->first_record());
  const std::uint32_t faces = view.proper_face_count();
  std::vector<std::byte> memory(firmware::mesh_layers_bytes(view, faces));
  Arena arena(memory);
  const auto made = firmware::make_mesh_layers(view, faces, quotas_millionths, firmware::Placement::kOptimal, arena);
  EXPECT_TRUE(made.ok()) << made.status().message;
  mesh.layers.resize(made->size() / 4);
  std::memcpy(mesh.layers.data(), made->data(), made->size());
  return mesh;
}

}  // namespace usuzumi::testing
