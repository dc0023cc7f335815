#include "tests/support/scene_meshes.h"

#include <cmath>

#include "tests/support/scene_math.h"

namespace usuzumi::scenes {
namespace {

Vec3 vec3(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

// Joins a grid of (columns + 1) x (rows + 1) vertices, row by row, into triangles.
void add_grid(Mesh& mesh, std::uint32_t columns, std::uint32_t rows) {
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) {
      const std::uint32_t v = r * (columns + 1) + c, below = v + columns + 1;
      mesh.add_triangle(v, below, below + 1);
      mesh.add_triangle(v, below + 1, v + 1);
    }
  }
}

}  // namespace

void Mesh::add_vertex(Vec3 position, Rgba8 colour) {
  positions.push_back(position);
  colours.push_back(colour);
}

void Mesh::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { indices.insert(indices.end(), {a, b, c}); }

Mesh sphere(std::uint32_t slices, std::uint32_t stacks) {
  Mesh mesh;
  for (std::uint32_t r = 0; r <= stacks; ++r) {
    const double latitude = kPi * r / stacks;
    for (std::uint32_t c = 0; c <= slices; ++c) {
      const double longitude = 2 * kPi * (c % slices) / slices;
      const Vec3 p = vec3(sine(latitude) * sine(longitude), cosine(latitude), sine(latitude) * cosine(longitude));
      mesh.positions.push_back(p);
      mesh.normals.push_back(pack_normal(p));
    }
  }
  add_grid(mesh, slices, stacks);
  return mesh;
}

Mesh torus(float ring_radius, float tube_radius, std::uint32_t ring_parts, std::uint32_t tube_parts) {
  Mesh mesh;
  for (std::uint32_t r = 0; r <= tube_parts; ++r) {
    const double tube = -2 * kPi * (r % tube_parts) / tube_parts;
    for (std::uint32_t c = 0; c <= ring_parts; ++c) {
      const double ring = 2 * kPi * (c % ring_parts) / ring_parts;
      const Vec3 out = vec3(sine(ring), 0, cosine(ring)), up{0, 1, 0};
      const Vec3 normal = out * static_cast<float>(cosine(tube)) + up * static_cast<float>(sine(tube));
      mesh.positions.push_back(out * ring_radius + normal * tube_radius);
      mesh.normals.push_back(pack_normal(normal));
      mesh.colours.push_back(colour_wheel(static_cast<double>(c % ring_parts) / ring_parts));
    }
  }
  add_grid(mesh, ring_parts, tube_parts);
  return mesh;
}

Mesh arc(Vec3 centre, float inner_radius, float outer_radius, double from_rad, double to_rad, std::uint32_t parts,
         Rgba8 colour) {
  Mesh mesh;
  for (std::uint32_t i = 0; i <= parts; ++i) {
    const double angle = from_rad + (to_rad - from_rad) * i / parts;
    const Vec3 out = vec3(sine(angle), -cosine(angle), 0);
    mesh.add_vertex(centre + out * inner_radius, colour);
    mesh.add_vertex(centre + out * outer_radius, colour);
  }
  for (std::uint32_t i = 0; i < parts; ++i) {
    mesh.add_triangle(2 * i, 2 * i + 3, 2 * i + 1);
    mesh.add_triangle(2 * i, 2 * i + 2, 2 * i + 3);
  }
  return mesh;
}

Mesh disc(Vec3 centre, float radius, std::uint32_t parts, Rgba8 colour) {
  std::vector<Vec3> outline;
  for (std::uint32_t i = 0; i < parts; ++i) {
    const double angle = -2 * kPi * i / parts;
    outline.push_back(centre + vec3(sine(angle), -cosine(angle), 0) * radius);
  }
  return convex(outline, colour);
}

Mesh convex(const std::vector<Vec3>& outline, Rgba8 colour) {
  Mesh mesh;
  for (const Vec3& p : outline) mesh.add_vertex(p, colour);
  for (std::uint32_t i = 1; i + 1 < outline.size(); ++i) mesh.add_triangle(0, i, i + 1);
  return mesh;
}

void append(Mesh& to, const Mesh& piece) {
  const auto base = static_cast<std::uint32_t>(to.positions.size());
  to.positions.insert(to.positions.end(), piece.positions.begin(), piece.positions.end());
  to.normals.insert(to.normals.end(), piece.normals.begin(), piece.normals.end());
  to.colours.insert(to.colours.end(), piece.colours.begin(), piece.colours.end());
  for (std::uint32_t i : piece.indices) to.indices.push_back(base + i);
}

Rgba8 colour_wheel(double turn) {
  const auto channel = [turn](double peak) {
    double distance = std::fabs(turn - peak);
    if (distance > 0.5) distance = 1 - distance;
    const double level = 2 - 6 * distance;  // full within a sixth of the peak, none beyond a third
    return static_cast<std::uint32_t>(255 * (level < 0 ? 0 : (level > 1 ? 1 : level)) + 0.5);
  };
  return rgba8(channel(0), channel(1.0 / 3), channel(2.0 / 3));
}

std::uint32_t RandomSequence::next() {
  state_ = state_ * 6364136223846793005u + 1442695040888963407u;
  return static_cast<std::uint32_t>(state_ >> 32);
}

float RandomSequence::between(float low, float high) {
  return low + (high - low) * static_cast<float>(next() >> 8) / 16777216.0f;
}

}  // namespace usuzumi::scenes
