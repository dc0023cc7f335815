// Scenes of lit solids, and a picture like those of use: an instrument cluster.
#include "tests/support/scene_functions.h"
#include "tests/support/scene_math.h"

namespace usuzumi::scenes {
namespace {

using namespace command;

constexpr Rgba8 kPanel = rgba8(14, 18, 26), kRim = rgba8(92, 104, 124), kTick = rgba8(226, 232, 240),
                kNeedle = rgba8(255, 72, 40), kGlow = rgba8(40, 150, 255), kAmber = rgba8(255, 176, 0),
                kGreen = rgba8(60, 214, 92), kRed = rgba8(240, 40, 40);

SetLight light(Vec3 to_light, Vec3 ambient, Vec3 diffuse) { return {1, normalized(to_light), ambient, diffuse}; }

void use_solid_state(SceneBuilder& b) {
  SetRasterState raster;
  raster.cull = CullMode::kBack;
  raster.depth_test = 1;
  b.put(raster);
}

Vec3 around(Vec3 centre, double angle, float radius) {
  return centre + Vec3{static_cast<float>(sine(angle)), static_cast<float>(-cosine(angle)), 0} * radius;
}

// A ring, ticks, a glowing arc up to the value and the needle at it; `value` in [0, 1] runs over three quarters of a
// turn.
void add_gauge(Mesh& mesh, Vec3 centre, float radius, double value) {
  const double from = -0.75 * kPi, to = 0.75 * kPi, at = from + (to - from) * value;
  append(mesh, disc(centre, radius, 64, kPanel));
  append(mesh, arc(centre, radius * 0.95f, radius, 0, 2 * kPi, 64, kRim));
  append(mesh, arc(centre, radius * 0.86f, radius * 0.92f, from, at, 40, kGlow));
  for (std::uint32_t i = 0; i <= 20; ++i) {
    const double angle = from + (to - from) * i / 20;
    const double half = i % 5 == 0 ? 0.022 : 0.01;
    append(mesh, arc(centre, radius * (i % 5 == 0 ? 0.70f : 0.76f), radius * 0.83f, angle - half, angle + half, 1,
                     i > 16 ? kRed : kTick));
  }
  append(mesh, convex({around(centre, at, radius * 0.8f), around(centre, at - 0.35, radius * 0.1f),
                       around(centre, at + kPi, radius * 0.16f), around(centre, at + 0.35, radius * 0.1f)},
                      kNeedle));
  append(mesh, disc(centre, radius * 0.09f, 24, kRim));
  append(mesh, disc(centre, radius * 0.05f, 20, kTick));
}

// An arrow, a lamp and a warning triangle: what may never be thinned.
void add_telltales(Mesh& mesh) {
  append(mesh, convex({{176, 30, 0.5f}, {192, 44, 0.5f}, {192, 16, 0.5f}}, kGreen));
  append(mesh, convex({{192, 24, 0.5f}, {192, 36, 0.5f}, {204, 36, 0.5f}, {204, 24, 0.5f}}, kGreen));
  append(mesh, disc({232, 30, 0.5f}, 10, 24, kGlow));
  for (std::uint32_t i = 0; i < 4; ++i) {
    const float y = 22 + 5 * static_cast<float>(i);
    append(mesh, convex({{212, y, 0.5f}, {212, y + 2, 0.5f}, {220, y + 1, 0.5f}, {220, y - 1, 0.5f}}, kGlow));
  }
  append(mesh, convex({{276, 14, 0.5f}, {260, 44, 0.5f}, {292, 44, 0.5f}}, kAmber));
  append(mesh, convex({{276, 22, 0.5f}, {267, 39.5f, 0.5f}, {285, 39.5f, 0.5f}}, kPanel));
  append(mesh, convex({{275, 27, 0.5f}, {275, 34, 0.5f}, {277, 34, 0.5f}, {277, 27, 0.5f}}, kAmber));
}

}  // namespace

void build_lit_sphere(SceneBuilder& b) {
  b.clear_to_background();
  use_solid_state(b);
  b.put(light({1, 1.2f, 1.5f}, {0.15f, 0.15f, 0.2f}, {0.85f, 0.8f, 0.7f}));
  b.set_transform(perspective(0.7, b.aspect(), 1, 20) * translation(0, 0, -3.4f));
  b.draw_mesh(sphere(40, 24), rgba8(240, 200, 150));
}

void build_lit_torus(SceneBuilder& b) {
  b.clear_to_background();
  use_solid_state(b);
  // So bright that the sum is cut at 1 where the light falls straight.
  b.put(light({-1, 2, 1}, {0.3f, 0.3f, 0.3f}, {0.9f, 0.9f, 0.9f}));
  b.set_transform(perspective(0.8, b.aspect(), 1, 20) * translation(0, 0, -3.6f) * rotation_x(0.7) * rotation_z(0.3));
  b.draw_mesh(torus(1, 0.42f, 48, 20));
}

void build_cluster(SceneBuilder& b) {
  b.put(Clear{kClearColour | kClearDepth, rgba8(4, 6, 10), 1});
  b.set_pixel_transform();
  Mesh flat;
  add_gauge(flat, {112, 150, 0.5f}, 100, 0.62);
  add_gauge(flat, {368, 150, 0.5f}, 100, 0.27);
  add_telltales(flat);
  b.draw_mesh(flat);
  // The middle: a small solid in a viewport of its own, and a graph of points and lines.
  use_solid_state(b);
  b.put(SetViewport{190, 70, 100, 100, 0, 1});
  b.put(light({-0.6f, 1, 1}, {0.25f, 0.25f, 0.25f}, {0.75f, 0.75f, 0.75f}));
  b.set_transform(perspective(0.8, 1, 1, 20) * translation(0, 0, -3.8f) * rotation_x(1.1) * rotation_y(0.5));
  b.draw_mesh(torus(1, 0.35f, 32, 14));
  b.put(SetViewport{0, 0, static_cast<float>(b.width()), static_cast<float>(b.height()), 0, 1});
  b.set_pixel_transform();
  Mesh graph, dots;
  for (std::uint32_t i = 0; i < 12; ++i) {
    const auto height = [](std::uint32_t k) { return static_cast<float>(static_cast<int>(222 - 16 * sine(k * 0.8))); };
    const float x = 192 + 8 * static_cast<float>(i);
    graph.add_vertex({x, height(i), 0.5f}, kGlow);
    graph.add_vertex({x + 8, height(i + 1), 0.5f}, kGlow);
    dots.add_vertex({x, height(i), 0.4f}, kTick);
  }
  SetRasterState raster;
  raster.depth_test = 1;
  raster.line_width = 2;
  raster.point_size = 4;
  b.put(raster);
  b.draw_vertices(graph, Topology::kLines);
  b.draw_vertices(dots, Topology::kPoints);
}

}  // namespace usuzumi::scenes
