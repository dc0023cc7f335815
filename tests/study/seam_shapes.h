// Shapes that are hard on seams: what a method tears, it tears here.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/vec.h"

namespace usuzumi::study {

/// A part of a shape that has one texture, with vertices of its own. Indices count from the part's first vertex.
struct TexturedPart {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;
  std::vector<TexCoord> coordinates;
  std::vector<std::uint32_t> indices;  // three per face, counter-clockwise from outside
};

/// The cube [-1, 1]^3, n x n cells a side; each side is a part: +x, -x, +y, -y, +z, -z. Where sides meet, positions
/// repeat exactly.
std::vector<TexturedPart> six_sided_cube(std::uint32_t n);

/// A cylinder along y, radius 1, height 2, in one part: a mantle of `sides` x `rows` cells whose texture is wound
/// around it once (a seam where it meets itself), and two caps of `rings` rings with a texture coordinate and a normal
/// of their own (a crease all around).
TexturedPart creased_cylinder(std::uint32_t sides, std::uint32_t rows, std::uint32_t rings);

/// A texture on which a shift shows: size x size texels 0x00RRGGBB, 8 x 8 fields of two shades of hue `number` (0..5)
/// with a ramp across each.
std::vector<std::uint32_t> test_card(std::uint32_t size, std::uint32_t number);

}  // namespace usuzumi::study
