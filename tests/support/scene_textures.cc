// Scenes of textures, alpha test and blending.
#include "tests/support/scene_functions.h"
#include "tests/support/scene_images.h"
#include "tests/support/scene_math.h"

namespace usuzumi::scenes {
namespace {

using namespace command;

/// A rectangle in the plane z with coordinates from `from` at its top left to `to` at its bottom right; y down.
Mesh card(float x0, float y0, float x1, float y1, float z, TexCoord from, TexCoord to, Rgba8 colour = {}) {
  Mesh mesh = convex({{x0, y0, z}, {x0, y1, z}, {x1, y1, z}, {x1, y0, z}}, colour);
  for (const Vec3& p : mesh.positions)
    mesh.texture_coordinates.push_back({p.x == x0 ? from.s : to.s, p.y == y0 ? from.t : to.t});
  return mesh;
}

/// The unit sphere with the map's coordinates: s once around, t from pole to pole.
Mesh globe(std::uint32_t slices, std::uint32_t stacks) {
  Mesh mesh = sphere(slices, stacks);
  for (std::uint32_t r = 0; r <= stacks; ++r)
    for (std::uint32_t c = 0; c <= slices; ++c)
      mesh.texture_coordinates.push_back({static_cast<float>(c) / static_cast<float>(slices),
                                          static_cast<float>(r) / static_cast<float>(stacks)});
  return mesh;
}

void use_depth(SceneBuilder& b, bool write = true) {
  SetRasterState raster;
  raster.depth_test = 1;
  raster.depth_write = write ? 1 : 0;
  b.put(raster);
}

/// A floor from under the eye to far away, `repeats` of the image wide.
void draw_floor(SceneBuilder& b, float repeats, Rgba8 colour = {}) {
  Mesh mesh;
  for (const Vec3 p : {Vec3{-60, -1, -120}, Vec3{-60, -1, 0}, Vec3{60, -1, 0}, Vec3{60, -1, -120}}) {
    mesh.add_vertex(p, colour);
    mesh.texture_coordinates.push_back({p.x / 120 * repeats, p.z / 120 * repeats});
  }
  mesh.add_triangle(0, 1, 2);
  mesh.add_triangle(0, 2, 3);
  b.set_transform(perspective(0.9, b.aspect(), 0.5, 200) * rotation_x(0.12));
  b.draw_mesh(mesh);
}

void draw_globe(SceneBuilder& b) {
  set_texture(b, level_chain(globe_map(96, 48), 7), TextureFormat::kXrgb8888, TextureFilter::kBilinear,
              TextureWrap::kRepeat, TextureWrap::kClamp);
  b.put(SetLight{1, normalized({1, 0.8f, 1.4f}), {0.25f, 0.25f, 0.3f}, {0.85f, 0.8f, 0.7f}});
  b.set_transform(perspective(0.7, b.aspect(), 1, 20) * translation(0, 0, -3.4f) * rotation_x(0.4) * rotation_y(-0.6));
  SetRasterState raster;
  raster.cull = CullMode::kBack;
  raster.depth_test = 1;
  b.put(raster);
  b.draw_mesh(globe(32, 18));
}

}  // namespace

void build_textured_cards(SceneBuilder& b) {
  b.clear_to_background();
  use_depth(b);
  const TexelImage image = chequers(16, 16, 4);
  for (const bool left : {true, false}) {
    set_texture(b, {image}, TextureFormat::kXrgb8888, left ? TextureFilter::kNearest : TextureFilter::kBilinear,
                TextureWrap::kClamp, TextureWrap::kClamp);
    b.set_transform(perspective(0.8, b.aspect(), 0.5, 20) * translation(left ? -0.85f : 0.85f, 0, -2.9f) *
                    rotation_y(left ? 0.9 : -0.9) * rotation_x(0.25));
    b.draw_mesh(card(-1, -1, 1, 1, 0, {0, 1}, {1, 0}));
  }
}

void build_texture_wraps(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  const TexelImage image = chequers(13, 10, 3);
  for (std::uint32_t t = 0; t < 3; ++t)
    for (std::uint32_t s = 0; s < 3; ++s) {
      set_texture(b, {image}, TextureFormat::kRgb565,
                  (s + t) % 2 == 0 ? TextureFilter::kBilinear : TextureFilter::kNearest, static_cast<TextureWrap>(s),
                  static_cast<TextureWrap>(t));
      const float x = 4 + 64 * static_cast<float>(s), y = 4 + 52 * static_cast<float>(t);
      b.draw_mesh(card(x, y, x + 60, y + 48, 0.5f, {-1.3f, -1.2f}, {2.2f, 2.3f}));
    }
}

void build_texture_levels(SceneBuilder& b) {
  b.clear_to_background();
  use_depth(b);
  set_texture(b, level_chain(hills(64, 64), 7), TextureFormat::kXrgb8888, TextureFilter::kBilinear);
  draw_floor(b, 24);
}

void build_alpha_mask(SceneBuilder& b) {
  b.clear_to_background();
  use_depth(b);
  b.put(SetFragmentState{1, 128, BlendMode::kNone});
  const TexelImage holes = [] {
    TexelImage image = spot(16, 6);
    for (std::uint32_t& texel : image.texels) texel = argb(255 - (texel >> 24), 90, 200, 120);
    return image;
  }();
  // Two fences that pierce each other: the hidden parts of one show through the holes of the other.
  for (const bool first : {true, false}) {
    set_texture(b, {holes}, TextureFormat::kArgb8888, first ? TextureFilter::kNearest : TextureFilter::kBilinear);
    b.set_transform(perspective(0.8, b.aspect(), 0.5, 20) * translation(0, 0, -3.2f) * rotation_y(first ? 0.6 : -0.6));
    b.draw_mesh(card(-1.4f, -1, 1.4f, 1, 0, {0, 3}, {4, 0}, first ? rgba8(255, 255, 255) : rgba8(255, 160, 90)));
  }
}

void build_blending(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  b.draw_mesh(card(0, 0, 200, 140, 0.9f, {}, {}, rgba8(60, 80, 110)));  // nothing blends with the background
  use_depth(b);
  draw_globe(b);
  b.put(SetLight{});
  b.set_pixel_transform();
  b.put(SetFragmentState{0, 0, BlendMode::kAlpha});
  use_depth(b, false);
  // Panes before and behind the globe (it lies about depth 0.75), without a texture, alpha running along one.
  b.put(SetTexture{});
  b.draw_mesh(card(10, 10, 120, 80, 0.85f, {}, {}, rgba8(255, 60, 40, 150)));
  Mesh pane = card(60, 40, 190, 110, 0.2f, {}, {});
  for (std::size_t i = 0; i < 4; ++i)
    pane.colours[i] = pane.positions[i].x < 100 ? rgba8(40, 255, 120, 0) : rgba8(40, 120, 255, 255);
  b.draw_mesh(pane);
  // Soft spots, one over the other.
  set_texture(b, {spot(32, 12)}, TextureFormat::kArgb8888, TextureFilter::kBilinear, TextureWrap::kClamp,
              TextureWrap::kClamp);
  for (std::uint32_t i = 0; i < 5; ++i) {
    const float x = 20 + 26 * static_cast<float>(i);
    b.draw_mesh(card(x, 76, x + 56, 132, 0.1f, {}, {1, 1}, rgba8(255, 250 - 40 * i, 40 * i, 200)));
  }
}

void build_texture_formats(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  std::uint32_t i = 0;
  for (const auto format : {TextureFormat::kRgb565, TextureFormat::kXrgb8888, TextureFormat::kArgb8888})
    for (const auto& [width, height] :
         {std::pair{31u, 17u}, std::pair{1u, 9u}, std::pair{7u, 1u}, std::pair{33u, 32u}}) {
      const float x = 4 + 49 * static_cast<float>(i % 4), y = 4 + 38 * static_cast<float>(i / 4);
      set_texture(b, level_chain(hills(width, height), 1 + i % 3), format,
                  i % 2 == 0 ? TextureFilter::kNearest : TextureFilter::kBilinear, TextureWrap::kMirror);
      b.draw_mesh(card(x, y, x + 45, y + 34, 0.5f, {0.1f, 0.2f}, {1.6f, 1.3f}, rgba8(255, 230, 200)));
      ++i;
    }
  SetRasterState raster;
  raster.point_size = 9;
  raster.line_width = 5;
  b.put(raster);
  set_texture(b, {hills(32, 32)}, TextureFormat::kXrgb8888, TextureFilter::kBilinear);
  Mesh points, lines;
  for (std::uint32_t k = 0; k < 10; ++k) {
    const float at = static_cast<float>(k);
    points.add_vertex({12 + 18 * at, 126, 0.5f}, {});
    points.texture_coordinates.push_back({at / 10, 0.3f});
    lines.add_vertex({8 + 18 * at, 138, 0.5f}, {});
    lines.texture_coordinates.push_back({at / 5, at / 7});
  }
  b.draw_vertices(points, Topology::kPoints);
  b.draw_vertices(lines, Topology::kLines);
}

void build_globe(SceneBuilder& b) {
  b.clear_to_background();
  draw_globe(b);
}

void build_textured_room(SceneBuilder& b) {
  b.clear_to_background();
  use_depth(b);
  set_texture(b, level_chain(hills(32, 32), 6), TextureFormat::kRgb565, TextureFilter::kBilinear, TextureWrap::kMirror);
  draw_floor(b, 24, rgba8(230, 240, 255));
  draw_globe(b);
}

}  // namespace usuzumi::scenes
