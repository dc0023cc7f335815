// Meshes of drawing data for tests.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tests/support/rom_builder.h"

namespace usuzumi::testing {

/// An n x n grid of squares over [-1, 1] x [-1, 1] with gentle hills: 2 n^2 faces, (n + 1)^2 vertices.
inline TestMesh hills(std::uint32_t n, std::uint32_t level) {
  TestMesh mesh;
  mesh.level = level;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const float x = 2 * static_cast<float>(i) / static_cast<float>(n) - 1,
                  y = 2 * static_cast<float>(j) / static_cast<float>(n) - 1;
      mesh.positions.push_back({x, y, 0.2f * x * x - 0.1f * y * y * y});
    }
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      for (std::uint32_t v : {a, b, c, b, d, c}) mesh.indices.push_back(v);
    }
  return mesh;
}

/// The mesh with normals as hills have them.
inline TestMesh with_smooth_normals(TestMesh mesh) {
  for (const Vec3& p : mesh.positions)
    mesh.normals.push_back(pack_normal(normalized(Vec3{-0.4f * p.x, 0.3f * p.y * p.y, 1})));
  return mesh;
}

/// One square of side 2 * half around the origin, facing +z, as a strip.
inline TestMesh square(float half, std::uint32_t level, float z = 0) {
  TestMesh mesh;
  mesh.level = level;
  mesh.positions = {{-half, -half, z}, {half, -half, z}, {-half, half, z}, {half, half, z}};
  return mesh;
}

/// Hills whose texture coordinates are the places seen from above: s = (x + 1) / 2, t = (1 - y) / 2.
inline TestMesh mapped_hills(std::uint32_t n, std::uint32_t level, std::uint32_t material) {
  TestMesh mesh = hills(n, level);
  for (const Vec3& p : mesh.positions) mesh.texture_coordinates.push_back({(p.x + 1) / 2, (1 - p.y) / 2});
  mesh.material = material;
  return mesh;
}

/// A mesh of two materials: hills, and more hills 3 to the right of them.
inline TestMesh two_hills(std::uint32_t n, std::uint32_t level, std::uint32_t first, std::uint32_t second) {
  TestMesh mesh = mapped_hills(n, level, first);
  const TestMesh other = mesh;
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const auto faces = static_cast<std::uint32_t>(mesh.indices.size() / 3);
  for (const Vec3& p : other.positions) mesh.positions.push_back({p.x + 3, p.y, p.z});
  for (std::uint32_t i : other.indices) mesh.indices.push_back(i + vertices);
  for (TexCoord c : other.texture_coordinates) mesh.texture_coordinates.push_back(c);
  mesh.groups = {{faces, vertices, first, 0xFF0000FF}, {2 * faces, 2 * vertices, second, 0xFF00FF00}};
  return mesh;
}

/// Materials 0: opaque and textured; 1: plain; 2: masked with the same texture; 3: blended, without a texture;
/// 4: another texture.
inline TestAppearance five_materials() {
  TestAppearance appearance;
  appearance.textures.resize(2);
  appearance.textures[0] = {1, 2, 2, 1, {0xF800FFFF, 0x07E0001F}, {}};  // RGB565
  appearance.textures[1] = {3, 1, 1, 1, {0x80FFFFFF}, {}};              // ARGB8888
  using firmware::format::AlphaMode;
  appearance.materials.resize(5);
  appearance.materials[0].texture = 0;
  appearance.materials[2] = {0, 1, 0, 0, AlphaMode::kMask, 77, {}};
  appearance.materials[3].alpha_mode = AlphaMode::kBlend;
  appearance.materials[4] = {1, 0, 1, 2, AlphaMode::kOpaque, 0, {}};
  return appearance;
}

/// The faces of an indexed mesh as one strip that repeats places between them, the way bare data must have them; a mesh
/// without indices is a strip already.
inline TestMesh as_strip(const TestMesh& mesh) {
  if (mesh.indices.empty()) return mesh;
  TestMesh strip;
  strip.level = mesh.level;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3 &a = mesh.positions[mesh.indices[i]], &b = mesh.positions[mesh.indices[i + 1]],
               &c = mesh.positions[mesh.indices[i + 2]];
    // Six places for a face, which so is even in the strip and keeps its winding.
    for (const Vec3& p : {a, a, a, b, c, c}) strip.positions.push_back(p);
  }
  return strip;
}

}  // namespace usuzumi::testing
