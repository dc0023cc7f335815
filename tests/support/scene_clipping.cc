// Scenes of clipping: near and far planes, guard band, viewports, and what perspective does to colours.
#include "tests/support/scene_functions.h"
#include "tests/support/scene_math.h"

namespace usuzumi::scenes {
namespace {

using namespace command;

void use_depth(SceneBuilder& b) {
  SetRasterState raster;
  raster.depth_test = 1;
  b.put(raster);
}

}  // namespace

// Triangles with one and with two corners behind the eye, and one wholly behind.
void build_near_plane(SceneBuilder& b) {
  b.clear_to_background();
  use_depth(b);
  b.set_transform(perspective(1.2, b.aspect(), 1, 20));
  Mesh mesh;
  const auto triangle = [&](Vec3 p, Vec3 q, Vec3 r) {
    mesh.add_vertex(p, rgba8(230, 60, 50));
    mesh.add_vertex(q, rgba8(70, 200, 90));
    mesh.add_vertex(r, rgba8(60, 110, 230));
  };
  triangle({-1.5f, -1, -4}, {1, -1, 2}, {-0.5f, 1.2f, -3});   // one behind the eye
  triangle({0.5f, 1, -6}, {3, -1.5f, 1.5f}, {2.5f, 0.5f, 3});  // two
  triangle({-0.4f, 0.4f, 1}, {0.4f, 0.4f, 2}, {0, -0.4f, 1});  // all three
  triangle({-3, 1.5f, -5}, {-2, 2.5f, -0.5f}, {-1, 1.5f, -5});  // one between the eye and the near plane
  b.draw_vertices(mesh, Topology::kTriangles);
}

// A floor and a wall that end where the far plane cuts them.
void build_far_plane(SceneBuilder& b) {
  b.clear_to_background();
  use_depth(b);
  b.set_transform(perspective(1.0, b.aspect(), 1, 8));
  Mesh mesh;
  const auto quad = [&](Vec3 p, Vec3 q, Vec3 r, Vec3 s, Rgba8 near, Rgba8 far) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.add_vertex(p, near);
    mesh.add_vertex(q, near);
    mesh.add_vertex(r, far);
    mesh.add_vertex(s, far);
    mesh.add_triangle(first, first + 1, first + 2);
    mesh.add_triangle(first, first + 2, first + 3);
  };
  quad({-2, -1, -2}, {2, -1, -2}, {2, -1, -12}, {-2, -1, -12}, rgba8(255, 220, 60), rgba8(200, 30, 30));
  quad({-2, -1, -2}, {-2, 1.5f, -2}, {-2, 1.5f, -10}, {-2, -1, -12}, rgba8(60, 220, 255), rgba8(30, 30, 160));
  quad({0.2f, -0.6f, -7}, {1.2f, -0.6f, -7}, {1.6f, 1, -9}, {0.6f, 1, -9}, rgba8(250, 250, 250), rgba8(20, 120, 20));
  b.draw_mesh(mesh);
}

// Triangles thousands of times as large as the target; only pieces of edges and interiors are seen.
void build_giant_triangles(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  Mesh mesh;
  const auto triangle = [&](Vec3 p, Vec3 q, Vec3 r, double turn) {
    mesh.add_vertex(p, colour_wheel(turn));
    mesh.add_vertex(q, colour_wheel(turn + 0.15));
    mesh.add_vertex(r, colour_wheel(turn + 0.3));
  };
  triangle({-30000, 20, 0.5f}, {64, 50000, 0.5f}, {400, 30, 0.5f}, 0);
  triangle({20, -90000, 0.5f}, {10, 60, 0.5f}, {90000, -90, 0.5f}, 0.4);
  triangle({100, 127, 0.5f}, {1e6f, 50, 0.5f}, {1e6f, 127, 0.5f}, 0.6);
  triangle({-400000, -400000, 0.5f}, {-300000, -400000, 0.5f}, {-300000, -300000, 0.5f}, 0.1);  // beyond the target
  b.draw_vertices(mesh, Topology::kTriangles);
}

// Viewports smaller than the target, overlapping and beyond its edge, at fractions of a pixel, with depth ranges. What
// a triangle has outside -w..w is not drawn, though the target has room for it.
void build_viewports(SceneBuilder& b) {
  b.clear_to_background();
  use_depth(b);
  Mesh mesh;
  mesh.add_vertex({-1.6f, -0.9f, -0.5f}, rgba8(255, 80, 60));
  mesh.add_vertex({1.2f, -0.7f, 0}, rgba8(80, 255, 90));
  mesh.add_vertex({0.1f, 1.4f, 0.5f}, rgba8(90, 110, 255));
  const SetViewport viewports[] = {{8, 8, 48, 40, 0, 1},     {66.5f, 10.25f, 50.5f, 30.75f, 0, 1},
                                   {4, 60, 60, 60, 0.5f, 1}, {40, 70, 60, 50, 0, 0.25f},
                                   {110, 64, 80, 40, 1, 0},  {90, 104, 40, 60, 0.5f, 0.5f}};
  for (const SetViewport& viewport : viewports) {
    b.put(viewport);
    b.draw_vertices(mesh, Topology::kTriangles);
  }
}

// A chequered floor from under the eye to the horizon: colours follow perspective, and the near plane cuts the first
// rows.
void build_floor(SceneBuilder& b) {
  b.clear_to_background();
  use_depth(b);
  b.set_transform(perspective(0.9, b.aspect(), 0.5, 60) * rotation_x(0.25) * translation(0, -1.5f, 0));
  Mesh mesh;
  constexpr std::uint32_t kColumns = 8, kRows = 12;
  for (std::uint32_t r = 0; r <= kRows; ++r)
    for (std::uint32_t c = 0; c <= kColumns; ++c) {
      const Vec3 p{(static_cast<float>(c) - 4) * 2.5f, 0, 2 - static_cast<float>(r) * 4};
      mesh.add_vertex(p, (r + c) % 2 == 0 ? rgba8(240, 236, 220) : colour_wheel(r / 13.0));
    }
  for (std::uint32_t r = 0; r < kRows; ++r)
    for (std::uint32_t c = 0; c < kColumns; ++c) {
      const std::uint32_t v = r * (kColumns + 1) + c, beyond = v + kColumns + 1;
      mesh.add_triangle(v, v + 1, beyond + 1);
      mesh.add_triangle(v, beyond + 1, beyond);
    }
  b.draw_mesh(mesh);
}

}  // namespace usuzumi::scenes
