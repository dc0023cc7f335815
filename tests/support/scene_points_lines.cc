// Scenes of points and lines.
#include "tests/support/scene_functions.h"
#include "tests/support/scene_math.h"

namespace usuzumi::scenes {
namespace {

using namespace command;

float whole(double v) { return static_cast<float>(v < 0 ? static_cast<int>(v - 0.5) : static_cast<int>(v + 0.5)); }

// Lines from around `centre` outwards. Their ends lie on pixel corners, where no pixel's diamond reaches: the first and
// last pixel are then the same for OpenGL's diamond-exit rule and for a plain parallelogram.
Mesh star(Vec3 centre, double inner, double outer, std::uint32_t rays, bool inwards) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < rays; ++i) {
    const double angle = 2 * kPi * i / rays;
    const Vec3 near = centre + Vec3{whole(inner * cosine(angle)), whole(inner * sine(angle)), 0};
    const Vec3 far = centre + Vec3{whole(outer * cosine(angle)), whole(outer * sine(angle)), 0};
    const Rgba8 inner_colour = rgba8(255, 255, 255), outer_colour = colour_wheel(static_cast<double>(i) / rays);
    mesh.add_vertex(inwards ? far : near, inwards ? outer_colour : inner_colour);
    mesh.add_vertex(inwards ? near : far, inwards ? inner_colour : outer_colour);
  }
  return mesh;
}

}  // namespace

void build_points(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  SetRasterState raster;
  const float sizes[] = {1, 1.5f, 2, 2.75f, 3, 4, 5, 7, 8, 11.25f, 16};
  float x = 6;
  for (float size : sizes) {
    raster.point_size = size;
    b.put(raster);
    Mesh mesh;
    x += size / 2;
    const float offsets[] = {0, 0.25f, 0.5f, 0.71875f};  // of the vertex within its pixel
    for (std::uint32_t i = 0; i < 4; ++i)
      mesh.add_vertex({static_cast<float>(static_cast<int>(x)) + offsets[i],
                       12 + 20 * static_cast<float>(i) + offsets[3 - i], 0.5f},
                      colour_wheel(i / 4.0 + static_cast<double>(size) / 64));
    b.draw_vertices(mesh, Topology::kPoints);
    x += size / 2 + 4;
  }
  raster.point_size = 64;
  b.put(raster);
  Mesh large;
  large.add_vertex({60, 130, 0.5f}, rgba8(90, 160, 220));
  b.draw_vertices(large, Topology::kPoints);
  // One pixel each, and thousands of them.
  raster.point_size = 1;
  b.put(raster);
  RandomSequence random(11);
  Mesh dust;
  for (std::uint32_t i = 0; i < 1500; ++i)
    dust.add_vertex({random.between(100, 165), random.between(95, 165), 0.5f}, colour_wheel(i / 1500.0));
  b.draw_vertices(dust, Topology::kPoints);
}

void build_lines(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  b.draw_vertices(star({64, 64, 0.5f}, 12, 58, 32, false), Topology::kLines);
  b.draw_vertices(star({192, 64, 0.5f}, 12, 58, 40, true), Topology::kLines);
}

// The target's sides are powers of two, so that diagonals stay exact in clip space and neither axis is the longer one.
void build_wide_lines(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  const float widths[] = {2, 3, 5, 8};
  for (std::uint32_t i = 0; i < 4; ++i) {
    SetRasterState raster;
    raster.line_width = widths[i];
    raster.shade_model = i % 2 == 0 ? ShadeModel::kGouraud : ShadeModel::kFlat;
    b.put(raster);
    const Vec3 centre{64 + 128 * static_cast<float>(i % 2), 64 + 128 * static_cast<float>(i / 2), 0.5f};
    b.draw_vertices(star(centre, 20, 54, 16, i % 2 == 1), Topology::kLines);
  }
}

}  // namespace usuzumi::scenes
