#include "tests/study/seam_shapes.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace usuzumi::study {
namespace {

float unit(std::uint32_t i, std::uint32_t n) { return static_cast<float>(i) / static_cast<float>(n); }

struct Axes {
  Vec3 outward, right, up;
};

void add_cell(std::vector<std::uint32_t>& indices, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  indices.insert(indices.end(), {a, b, c, a, c, d});
}

TexturedPart side_of_cube(const Axes& axes, std::uint32_t n) {
  TexturedPart part;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      // Rounded once, so that what another side counts from its other end is the same to the bit.
      const auto centred = [n](std::uint32_t at) {
        return (static_cast<float>(2 * at) - static_cast<float>(n)) / static_cast<float>(n);
      };
      const float x = centred(i), y = centred(j);
      part.positions.push_back(axes.outward + axes.right * x + axes.up * y);
      part.normals.push_back(axes.outward);
      part.coordinates.push_back({unit(i, n), 1 - unit(j, n)});
    }
  }
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t at = j * (n + 1) + i;
      add_cell(part.indices, at, at + 1, at + n + 2, at + n + 1);
    }
  return part;
}

Vec3 on_circle(std::uint32_t side, std::uint32_t sides) {
  const double angle = 2 * std::numbers::pi * (side % sides) / sides;
  return {static_cast<float>(std::cos(angle)), 0, static_cast<float>(-std::sin(angle))};
}

void add_mantle(TexturedPart& part, std::uint32_t sides, std::uint32_t rows) {
  for (std::uint32_t j = 0; j <= rows; ++j) {
    for (std::uint32_t i = 0; i <= sides; ++i) {
      const Vec3 radius = on_circle(i, sides);
      part.positions.push_back({radius.x, 2 * unit(j, rows) - 1, radius.z});
      part.normals.push_back(radius);
      part.coordinates.push_back({unit(i, sides), 0.5f - unit(j, rows) / 2});  // the texture's upper half
    }
  }
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t at = j * (sides + 1) + i;
      add_cell(part.indices, at, at + 1, at + sides + 2, at + sides + 1);
    }
}

// In the texture's lower half: the upper cap left, the lower one right.
void add_cap(TexturedPart& part, std::uint32_t sides, std::uint32_t rings, bool upper) {
  const auto first = static_cast<std::uint32_t>(part.positions.size());
  const float height = upper ? 1.0f : -1.0f;
  const auto add = [&](float x, float z) {
    part.positions.push_back({x, height, z});
    part.normals.push_back({0, height, 0});
    part.coordinates.push_back({(upper ? 0.25f : 0.75f) + 0.24f * x, 0.75f + 0.24f * (upper ? z : -z)});
  };
  add(0, 0);
  for (std::uint32_t r = 1; r <= rings; ++r)
    for (std::uint32_t i = 0; i < sides; ++i) {
      const Vec3 radius = on_circle(i, sides);
      if (r == rings) add(radius.x, radius.z);  // the rim's positions are the mantle's to the bit
      else add(radius.x * unit(r, rings), radius.z * unit(r, rings));
    }
  const auto at = [&](std::uint32_t ring, std::uint32_t i) {
    return ring == 0 ? first : first + 1 + (ring - 1) * sides + i % sides;
  };
  const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (upper) part.indices.insert(part.indices.end(), {a, b, c});
    else part.indices.insert(part.indices.end(), {a, c, b});
  };
  for (std::uint32_t i = 0; i < sides; ++i) {
    face(at(0, 0), at(1, i), at(1, i + 1));
    for (std::uint32_t r = 1; r < rings; ++r) {
      face(at(r, i), at(r + 1, i), at(r + 1, i + 1));
      face(at(r, i), at(r + 1, i + 1), at(r, i + 1));
    }
  }
}

}  // namespace

std::vector<TexturedPart> six_sided_cube(std::uint32_t n) {
  const Axes sides[] = {{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                        {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}, {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
                        {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}}};
  std::vector<TexturedPart> parts;
  for (const Axes& axes : sides) parts.push_back(side_of_cube(axes, n));
  return parts;
}

TexturedPart creased_cylinder(std::uint32_t sides, std::uint32_t rows, std::uint32_t rings) {
  TexturedPart part;
  add_mantle(part, sides, rows);
  add_cap(part, sides, rings, true);
  add_cap(part, sides, rings, false);
  return part;
}

std::vector<std::uint32_t> test_card(std::uint32_t size, std::uint32_t number) {
  constexpr std::uint32_t kHues[6][3] = {{230, 60, 50}, {60, 170, 70}, {60, 90, 220},
                                         {220, 190, 50}, {60, 190, 200}, {190, 70, 190}};
  std::vector<std::uint32_t> texels;
  for (std::uint32_t y = 0; y < size; ++y) {
    for (std::uint32_t x = 0; x < size; ++x) {
      const bool dark = ((x * 8 / size) + (y * 8 / size)) % 2 != 0;
      const std::uint32_t ramp = 160 + 95 * (x * 8 % size) / size;
      std::uint32_t texel = 0;
      for (const std::uint32_t channel : kHues[number % 6])
        texel = texel << 8 | channel * ramp / 255 * (dark ? 40u : 100u) / 100u;
      texels.push_back(texel);
    }
  }
  return texels;
}

}  // namespace usuzumi::study
