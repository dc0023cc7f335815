// Closed and open shapes with seams, as one mesh each.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "tests/study/seam_shapes.h"
#include "tests/support/mesh_shapes.h"

namespace usuzumi::testing {

/// A bumpy ball in `islands` random patches, each with texture coordinates of its own; one vertex per face corner.
inline Mesh ball_of_islands(int levels, std::uint32_t islands, unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&] { return static_cast<float>(random() % 2001) * 1e-3f - 1.0f; };
  Mesh shape = icosphere(levels);
  for (Vec3& p : shape.positions) p = p * (1.0f + 0.02f * number());
  std::vector<Vec3> centres;
  for (std::uint32_t i = 0; i < islands; ++i) {
    const float x = number(), y = number(), z = number();
    centres.push_back({x, y, z});
  }
  Mesh mesh;
  for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
    const Vec3 centre = shape.positions[shape.indices[i]] + shape.positions[shape.indices[i + 1]] +
                        shape.positions[shape.indices[i + 2]];
    std::size_t island = 0;
    const auto distance = [&](std::size_t c) {
      const Vec3 d = centre * (1.0f / 3) - centres[c];
      return dot(d, d);
    };
    for (std::size_t c = 1; c < centres.size(); ++c)
      if (distance(c) < distance(island)) island = c;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = shape.positions[shape.indices[i + k]];
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(p);
      mesh.texture_coordinates.push_back({p.x + 10 * static_cast<float>(island), p.y});
    }
  }
  return mesh;
}

inline Mesh joined(const std::vector<study::TexturedPart>& parts) {
  Mesh mesh;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const std::uint32_t i : parts[part].indices) mesh.indices.push_back(first + i);
    for (std::size_t v = 0; v < parts[part].positions.size(); ++v) {
      mesh.positions.push_back(parts[part].positions[v]);
      mesh.normals.push_back(pack_normal(parts[part].normals[v]));
      const TexCoord c = parts[part].coordinates[v];
      mesh.texture_coordinates.push_back({c.s + static_cast<float>(part), c.t});
    }
  }
  return mesh;
}

}  // namespace usuzumi::testing
