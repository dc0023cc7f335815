// Meshes for scenes: small, closed where named solid, counter-clockwise seen from outside.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/vec.h"

namespace usuzumi::scenes {

/// Triangles by index. Normals, colours and texture coordinates are empty or as many as positions.
struct Mesh {
  std::vector<Vec3> positions;
  std::vector<PackedNormal> normals;
  std::vector<Rgba8> colours;
  std::vector<TexCoord> texture_coordinates;
  std::vector<std::uint32_t> indices;

  void add_vertex(Vec3 position, Rgba8 colour);
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
};

/// Unit sphere with normals; poles on the y axis.
Mesh sphere(std::uint32_t slices, std::uint32_t stacks);

/// Around the y axis, with normals and a colour wheel along the ring.
Mesh torus(float ring_radius, float tube_radius, std::uint32_t ring_parts, std::uint32_t tube_parts);

/// Flat pieces in the plane z, y down as pixels run, with one colour and wound counter-clockwise as seen on the panel.
/// Angles run clockwise on the panel from twelve o'clock.
Mesh arc(Vec3 centre, float inner_radius, float outer_radius, double from_rad, double to_rad, std::uint32_t parts,
         Rgba8 colour);
Mesh disc(Vec3 centre, float radius, std::uint32_t parts, Rgba8 colour);
Mesh convex(const std::vector<Vec3>& outline, Rgba8 colour);

void append(Mesh& to, const Mesh& piece);

/// Between red, yellow, green, cyan, blue and magenta: `turn` in [0, 1).
Rgba8 colour_wheel(double turn);

/// A fixed random sequence (a linear congruential generator with Knuth's constants).
class RandomSequence {
 public:
  explicit RandomSequence(std::uint64_t seed) : state_(seed) {}
  std::uint32_t next();                   // 32 random bits
  float between(float low, float high);   // uniform, 24 bits

 private:
  std::uint64_t state_;
};

}  // namespace usuzumi::scenes
