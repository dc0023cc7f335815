// Meshes with seams in them.
#pragma once

#include <cmath>
#include <cstdint>

#include "tests/support/mesh_shapes.h"

namespace usuzumi::testing {

/// A sheet of n x n cells (n even) in z = 0, textured by two charts that meet at x = n / 2: s runs from 0 to 1 on the
/// left and from 2 to 3 on the right, t from 0 to 1 over half of the height each.
inline Mesh two_charts(std::uint32_t n) {
  Mesh mesh;
  const std::uint32_t half = n / 2;
  for (std::uint32_t chart = 0; chart < 2; ++chart) {
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t y = 0; y <= n; ++y)
      for (std::uint32_t x = 0; x <= half; ++x) {
        mesh.positions.push_back({static_cast<float>(chart * half + x), static_cast<float>(y), 0});
        const float along = static_cast<float>(x) / static_cast<float>(half);
        mesh.texture_coordinates.push_back(
            {static_cast<float>(2 * chart) + along, static_cast<float>(y) / static_cast<float>(2 * n)});
      }
    for (std::uint32_t y = 0; y < n; ++y)
      for (std::uint32_t x = 0; x < half; ++x) {
        const std::uint32_t a = base + y * (half + 1) + x, b = a + 1, c = a + half + 1, d = c + 1;
        mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
      }
  }
  return mesh;
}

inline Vec3 on_circle(std::uint32_t i, std::uint32_t n, float radius, float z) {
  const double angle = 6.283185307179586 * static_cast<double>(i % n) / n;
  return {static_cast<float>(std::cos(angle)) * radius, static_cast<float>(std::sin(angle)) * radius, z};
}

/// A closed cylinder of radius 1 over z = -1 .. 1 with `sides` sides and `rows` rows; the caps have wedges and normals
/// of their own and are fans of two rings around their middles.
inline Mesh capped_cylinder(std::uint32_t sides, std::uint32_t rows) {
  Mesh mesh;
  const auto add = [&](Vec3 p, Vec3 n) {
    mesh.positions.push_back(p);
    mesh.normals.push_back(pack_normal(n));
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
  };
  for (std::uint32_t r = 0; r <= rows; ++r)
    for (std::uint32_t i = 0; i < sides; ++i)
      add(on_circle(i, sides, 1, -1 + 2 * static_cast<float>(r) / static_cast<float>(rows)), on_circle(i, sides, 1, 0));
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t a = r * sides + i, b = r * sides + (i + 1) % sides, c = a + sides, d = b + sides;
      mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
    }
  for (const float z : {-1.0f, 1.0f}) {
    const Vec3 up{0, 0, z};
    const auto middle = add(up, up);
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    for (const float radius : {0.5f, 1.0f})
      for (std::uint32_t i = 0; i < sides; ++i) add(on_circle(i, sides, radius, z), up);
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t a = base + i, b = base + (i + 1) % sides, c = a + sides, d = b + sides;
      if (z > 0) mesh.indices.insert(mesh.indices.end(), {middle, a, b, a, c, d, a, d, b});
      else mesh.indices.insert(mesh.indices.end(), {middle, b, a, a, d, c, a, b, d});
    }
  }
  return mesh;
}

/// A torus of radii 3 and 1, closed, welded.
inline Mesh torus(std::uint32_t around, std::uint32_t across) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const Vec3 section = on_circle(j, across, 1, 0);
      mesh.positions.push_back(on_circle(i, around, 3 + section.x, section.y));
    }
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const std::uint32_t a = i * across + j, b = i * across + (j + 1) % across,
                          c = ((i + 1) % around) * across + j, d = ((i + 1) % around) * across + (j + 1) % across;
      mesh.indices.insert(mesh.indices.end(), {a, c, d, a, d, b});
    }
  return mesh;
}

}  // namespace usuzumi::testing
