#include "tests/bench/engine/bench_scenes.h"

#include <cmath>
#include <numbers>

namespace usuzumi::bench {
namespace {

/// Smooth, and different for neighbouring vertices.
Rgba8 colour_at(float u, float v) {
  const auto channel = [](float x) { return static_cast<std::uint32_t>(127.5f + 127.4f * std::sin(x)); };
  return rgba8(channel(u * 9), channel(v * 7 + 1), channel((u + v) * 5 + 2));
}

/// A rectangle in clip space, z = -1 near .. 1 far, with a gentle relief so that depth varies.
void add_grid(BenchScene& s, std::uint32_t columns, std::uint32_t rows, float z, float relief) {
  const auto base = static_cast<std::uint32_t>(s.positions.size());
  for (std::uint32_t j = 0; j <= rows; ++j)
    for (std::uint32_t i = 0; i <= columns; ++i) {
      const float u = static_cast<float>(i) / static_cast<float>(columns),
                  v = static_cast<float>(j) / static_cast<float>(rows);
      s.positions.push_back({u * 2 - 1, v * 2 - 1, z + relief * std::sin(u * 12) * std::cos(v * 10)});
      s.colours.push_back(colour_at(u + z, v));
      s.coordinates.push_back({u, v});
    }
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = base + j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
      s.indices.insert(s.indices.end(), {a, b, d, a, d, c});
    }
}

/// `faces` = 4 * rings * rings triangles (about), turned a little, before a perspective camera.
void add_sphere(BenchScene& s, std::uint32_t faces) {
  const auto rings = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(faces) / 4));
  const std::uint32_t segments = 2 * rings;
  for (std::uint32_t j = 0; j <= rings; ++j)
    for (std::uint32_t i = 0; i <= segments; ++i) {
      const float u = static_cast<float>(i) / static_cast<float>(segments),
                  v = static_cast<float>(j) / static_cast<float>(rings);
      const float theta = v * std::numbers::pi_v<float>, phi = u * 2 * std::numbers::pi_v<float>;
      s.positions.push_back({std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)});
      s.colours.push_back(colour_at(u, v));
      s.coordinates.push_back({u * 4, v * 2});
    }
  for (std::uint32_t j = 0; j < rings; ++j)
    for (std::uint32_t i = 0; i < segments; ++i) {
      const std::uint32_t a = j * (segments + 1) + i, b = a + 1, c = a + segments + 1, d = c + 1;
      s.indices.insert(s.indices.end(), {a, b, d, a, d, c});
    }
  const float aspect = static_cast<float>(s.width) / static_cast<float>(s.height), focal = 2.2f, near = 1, far = 5;
  const Mat4 projection{{focal / aspect, 0, 0, 0, 0, focal, 0, 0, 0, 0, (far + near) / (near - far),
                         2 * far * near / (near - far), 0, 0, -1, 0}};
  const float c = std::cos(0.4f), n = std::sin(0.4f);
  s.transform = projection * Mat4{{1, 0, 0, 0, 0, c, -n, 0, 0, n, c, -2.6f, 0, 0, 0, 1}};
}

/// Grid of about `faces` triangles with cells as square as the target allows.
void add_grid_of(BenchScene& s, std::uint32_t faces) {
  const double aspect = static_cast<double>(s.width) / s.height;
  const auto rows = static_cast<std::uint32_t>(std::sqrt(faces / 2.0 / aspect) + 0.5);
  add_grid(s, static_cast<std::uint32_t>(rows * aspect + 0.5), rows, 0, 0.4f);
}

/// From under the eye to far away.
void add_floor(BenchScene& s) {
  for (const Vec3 p : {Vec3{-60, -1, -120}, Vec3{-60, -1, 0}, Vec3{60, -1, 0}, Vec3{60, -1, -120}}) {
    s.positions.push_back(p);
    s.colours.push_back(rgba8(255, 255, 255));
    s.coordinates.push_back({p.x / 4, p.z / 4});
  }
  s.indices = {0, 1, 2, 0, 2, 3};
  const float aspect = static_cast<float>(s.width) / static_cast<float>(s.height), focal = 2, near = 0.5f, far = 200;
  const Mat4 projection{{focal / aspect, 0, 0, 0, 0, focal, 0, 0, 0, 0, (far + near) / (near - far),
                         2 * far * near / (near - far), 0, 0, -1, 0}};
  const float c = std::cos(0.25f), n = std::sin(0.25f);  // looks down a little
  s.transform = projection * Mat4{{1, 0, 0, 0, 0, c, -n, 0, 0, n, c, 0, 0, 0, 0, 1}};
}

/// Smooth, so that a level is much like the one beside it; alpha from a quarter to the whole.
BenchTexture smooth_texture(std::uint32_t size, bool bilinear) {
  BenchTexture t{size, size, 0, {}, bilinear};
  for (std::uint32_t side = size; side > 0; side /= 2, ++t.levels)
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x) {
        const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(side) * 2 * std::numbers::pi_v<float>,
                    v = (static_cast<float>(y) + 0.5f) / static_cast<float>(side) * 2 * std::numbers::pi_v<float>;
        const auto channel = [](float at) { return static_cast<std::uint32_t>(160 + 95 * std::sin(at)); };
        t.texels.push_back(channel(u + v) << 24 | channel(u) << 16 | channel(v) << 8 | channel(u - v));
      }
  return t;
}

/// Textured scenes; `begin` adds one of that name to the list.
template <class Begin>
void add_textured_scenes(Begin begin) {
  for (const bool bilinear : {false, true}) {
    const std::string filter = bilinear ? "/bilinear" : "/nearest";
    BenchScene& quad = begin("textured_quad" + filter);
    add_grid(quad, 1, 1, 0, 0);
    quad.colours.assign(quad.positions.size(), rgba8(255, 255, 255));
    quad.texture = smooth_texture(512, bilinear);
    BenchScene& floor = begin("textured_floor" + filter);
    add_floor(floor);
    floor.texture = smooth_texture(256, bilinear);
    for (const std::uint32_t thousands : {2u, 20u}) {
      BenchScene& sphere = begin("textured_sphere_" + std::to_string(thousands) + "k" + filter);
      add_sphere(sphere, thousands * 1000);
      sphere.texture = smooth_texture(256, bilinear);
    }
    BenchScene& layers = begin("blended_8x" + filter);
    for (int k = 0; k < 8; ++k) add_grid(layers, 1, 1, 0.8f - 0.2f * static_cast<float>(k), 0);
    layers.texture = smooth_texture(512, bilinear);
    layers.blended = true;
  }
}

}  // namespace

std::vector<BenchScene> all_bench_scenes() {
  std::vector<BenchScene> scenes;
  struct Size { std::uint32_t width, height; };
  for (const Size size : {Size{800, 480}, Size{1920, 720}}) {
    const std::string suffix = "/" + std::to_string(size.width) + "x" + std::to_string(size.height);
    const auto begin = [&](const std::string& name, bool flat) -> BenchScene& {
      BenchScene& s = scenes.emplace_back();
      s.name = name + (name == "clear" ? "" : flat ? "/flat" : "/gouraud") + suffix;
      s.width = size.width;
      s.height = size.height;
      s.flat = flat;
      return s;
    };
    begin("clear", false).clear_only = true;
    for (const bool flat : {true, false}) {
      add_grid(begin("quad", flat), 1, 1, 0, 0);
      for (const std::uint32_t thousands : {2u, 20u, 200u})
        add_grid_of(begin("grid_" + std::to_string(thousands) + "k", flat), thousands * 1000);
      for (const std::uint32_t thousands : {2u, 20u, 200u})
        add_sphere(begin("sphere_" + std::to_string(thousands) + "k", flat), thousands * 1000);
      add_grid_of(begin("tiny_1M", flat), 1000000);
      BenchScene& layers = begin("overdraw_8x", flat);
      for (int k = 0; k < 8; ++k) add_grid(layers, 1, 1, 0.8f - 0.2f * static_cast<float>(k), 0);
    }
    add_textured_scenes([&](const std::string& name) -> BenchScene& {
      BenchScene& s = begin(name, false);
      s.name = name + suffix;
      return s;
    });
  }
  return scenes;
}

}  // namespace usuzumi::bench
