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

/// One square of side 2 * half around the origin, facing +z, as a strip.
inline TestMesh square(float half, std::uint32_t level, float z = 0) {
  TestMesh mesh;
  mesh.level = level;
  mesh.positions = {{-half, -half, z}, {half, -half, z}, {-half, half, z}, {half, half, z}};
  return mesh;
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
