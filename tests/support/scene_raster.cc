// Scenes of clears, triangles, topologies, shading, culling, scissor and targets.
#include "tests/support/scene_functions.h"
#include "tests/support/scene_math.h"

namespace usuzumi::scenes {
namespace {

using namespace command;

constexpr Rgba8 kRed = rgba8(230, 60, 50), kGreen = rgba8(70, 200, 90), kBlue = rgba8(60, 110, 230),
                kWhite = rgba8(250, 250, 250), kAmber = rgba8(255, 176, 0);

void use_shading(SceneBuilder& b, ShadeModel model) {
  SetRasterState raster;
  raster.shade_model = model;
  b.put(raster);
}

float to_float(std::uint32_t v) { return static_cast<float>(v); }

// A hexagon in perspective's colours around `centre`, drawn as triangles by index.
Mesh colour_hexagon(Vec3 centre, float radius) {
  Mesh mesh;
  mesh.add_vertex(centre, kWhite);
  for (std::uint32_t i = 0; i < 6; ++i) {
    const double angle = 2 * kPi * i / 6 + 0.1;
    const Vec3 out{static_cast<float>(sine(angle)), static_cast<float>(cosine(angle)), 0};
    mesh.add_vertex(centre + out * radius, colour_wheel(i / 6.0));
    mesh.add_triangle(0, i + 1, (i + 1) % 6 + 1);
  }
  return mesh;
}

}  // namespace

void build_clear(SceneBuilder& b) { b.put(Clear{kClearColour, rgba8(200, 120, 40), 1}); }

void build_scissored_clear(SceneBuilder& b) {
  const auto clear_in = [&](SetScissor scissor, Rgba8 colour) {
    b.put(scissor);
    b.put(Clear{kClearColour, colour, 1});
  };
  clear_in({8, 8, 40, 24}, kRed);
  clear_in({33, 19, 41, 23}, kGreen);
  clear_in({80, 50, 4000, 4000}, kBlue);   // reaches beyond the target: clipped
  clear_in({4000, 4000, 10, 10}, kWhite);  // wholly beyond: nothing
  clear_in({10, 40, 0, 10}, kWhite);       // empty: nothing
  clear_in({5, 60, 1, 1}, kWhite);
}

void build_single_triangle(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  Mesh mesh;
  mesh.add_vertex({80.25f, 10.5f, 0.5f}, kRed);
  mesh.add_vertex({12.75f, 101.125f, 0.5f}, kGreen);
  mesh.add_vertex({148.5f, 87.875f, 0.5f}, kBlue);
  b.draw_vertices(mesh, Topology::kTriangles);
}

// Edges that run exactly through pixel centres and corners, each shared by two triangles: the top-left rule decides
// every pixel on them, and no pixel may be left or taken twice.
void build_shared_edges(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  use_shading(b, ShadeModel::kFlat);
  const auto fan = [&](Vec3 centre, float radius) {
    Mesh mesh;
    mesh.add_vertex(centre, kWhite);
    const float around[9][2] = {{1, 0}, {1, -1}, {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}, {0, 1}, {1, 1}, {1, 0}};
    for (std::uint32_t i = 0; i < 9; ++i)
      mesh.add_vertex(centre + Vec3{around[i][0] * radius, around[i][1] * radius, 0}, colour_wheel(i % 8 / 8.0));
    b.draw_vertices(mesh, Topology::kTriangleFan);
  };
  fan({32, 32, 0.5f}, 24);         // on pixel corners
  fan({96.5f, 32.5f, 0.5f}, 24);   // on pixel centres
  fan({32.5f, 96, 0.5f}, 23.5f);   // one of each
  fan({96.25f, 96.75f, 0.5f}, 20.125f);
}

// A ribbon; with back faces culled it has no holes only if every second triangle of a strip turns its winding round.
void build_triangle_strip(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  SetRasterState raster;
  raster.shade_model = ShadeModel::kFlat;
  raster.cull = CullMode::kBack;
  b.put(raster);
  Mesh mesh;
  for (std::uint32_t i = 0; i <= 24; ++i) {
    const float x = 8 + 6 * to_float(i), y = 60 + static_cast<float>(30 * sine(i * 0.5));
    mesh.add_vertex({x, y - 18, 0.5f}, colour_wheel(i / 25.0));
    mesh.add_vertex({x, y + 18, 0.5f}, i % 2 == 0 ? kWhite : kBlue);
  }
  b.draw_vertices(mesh, Topology::kTriangleStrip);
}

void build_triangle_fan(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  Mesh mesh;
  mesh.add_vertex({64, 64, 0.5f}, kWhite);
  for (std::uint32_t i = 0; i <= 20; ++i) {
    const double angle = 2 * kPi * (i % 20) / 20;
    mesh.add_vertex({64 + static_cast<float>(50 * cosine(angle)), 64 + static_cast<float>(50 * sine(angle)), 0.5f},
                    colour_wheel(i % 20 / 20.0));
  }
  b.draw_vertices(mesh, Topology::kTriangleFan);
}

// Vertices shared by index, and draws that begin in the middle of the indices, each topology once.
void build_indexed_u16(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  Mesh mesh;
  for (std::uint32_t y = 0; y < 5; ++y)
    for (std::uint32_t x = 0; x < 7; ++x)
      mesh.add_vertex({10 + 20 * to_float(x), 8 + 20 * to_float(y), 0.5f}, colour_wheel((x * 5 + y * 3) % 7 / 7.0));
  b.set_streams(mesh);
  const BusAddress indices = b.store(std::vector<std::uint16_t>{
      99, 99, 0, 7, 1, 1, 7, 8, 9, 2, 10,                    // a triangle list from index 2 on
      14, 21, 15, 22, 16, 23, 17, 24,                        // a strip
      25, 19, 18, 24, 31, 32, 33, 26}                        // a fan
  );
  b.put(Draw{Topology::kTriangles, IndexFormat::kU16, indices, 2, 9});
  b.put(Draw{Topology::kTriangleStrip, IndexFormat::kU16, indices, 11, 8});
  b.put(Draw{Topology::kTriangleFan, IndexFormat::kU16, indices, 19, 8});
}

// 70,000 vertices, of which only 32-bit indices reach the last.
void build_indexed_u32(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  constexpr std::uint32_t kColumns = 350, kRows = 200;
  Mesh mesh;
  for (std::uint32_t y = 0; y < kRows; ++y)
    for (std::uint32_t x = 0; x < kColumns; ++x)
      mesh.add_vertex({to_float(x) * 0.5f, to_float(y) * 0.5f, 0.5f}, colour_wheel((x / 10 + y / 10) % 12 / 12.0));
  for (std::uint32_t y = 20; y + 10 < kRows; y += 20)
    for (std::uint32_t x = 10; x + 10 < kColumns; x += 15) {
      const std::uint32_t v = y * kColumns + x;
      mesh.add_triangle(v, v + 10 * kColumns + 3, v + 9);
    }
  const std::uint32_t last = kColumns * kRows - 1;
  mesh.add_triangle(last, last - 30, last - 14 * kColumns);
  b.draw_mesh(mesh);
}

// The same hexagons flat and Gouraud: flat takes the last vertex of each triangle.
void build_flat_and_gouraud(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  use_shading(b, ShadeModel::kFlat);
  b.draw_mesh(colour_hexagon({52, 54, 0.5f}, 46));
  use_shading(b, ShadeModel::kGouraud);
  b.draw_mesh(colour_hexagon({148, 54, 0.5f}, 46));
}

// Columns: cull none, back, front; each with counter-clockwise, then clockwise as front. Rows: triangles wound
// counter-clockwise, then clockwise, as seen on the panel.
void build_culling(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  for (std::uint32_t column = 0; column < 6; ++column) {
    SetRasterState raster;
    raster.cull = static_cast<CullMode>(column / 2);
    raster.front_face = static_cast<FrontFace>(column % 2);
    b.put(raster);
    const float x = 4 + 22 * to_float(column);
    Mesh mesh;
    mesh.add_vertex({x + 9, 4, 0.5f}, kGreen);
    mesh.add_vertex({x, 26, 0.5f}, kGreen);
    mesh.add_vertex({x + 18, 26, 0.5f}, kGreen);
    mesh.add_vertex({x + 9, 34, 0.5f}, kAmber);
    mesh.add_vertex({x + 18, 56, 0.5f}, kAmber);
    mesh.add_vertex({x, 56, 0.5f}, kAmber);
    b.draw_vertices(mesh, Topology::kTriangles);
  }
}

void build_scissored_drawing(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  const SetScissor windows[] = {{5, 5, 37, 41},       {63, 17, 50, 64}, {17, 63, 33, 31},
                                {90, 90, 1000, 1000}, {120, 3, 1, 60},  {50, 50, 0, 0}};
  for (const SetScissor& window : windows) {
    b.put(window);
    b.draw_mesh(colour_hexagon({64, 56, 0.5f}, 70));
  }
}

// Triangles thinner than a pixel, smaller than a pixel, and of no area at all.
void build_slivers(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  use_shading(b, ShadeModel::kFlat);
  RandomSequence random(7);
  Mesh slivers;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const Vec3 from{random.between(4, 156), random.between(4, 70), 0.5f},
        to{random.between(4, 156), random.between(4, 70), 0.5f};
    for (const Vec3& p : {from, to, to + Vec3{random.between(-0.9f, 0.9f), random.between(-0.9f, 0.9f), 0}})
      slivers.add_vertex(p, colour_wheel(i / 40.0));
  }
  b.draw_vertices(slivers, Topology::kTriangles);
  Mesh dust;
  for (std::uint32_t i = 0; i < 600; ++i) {
    const Vec3 at{random.between(4, 156), random.between(74, 116), 0.5f};
    for (int corner = 0; corner < 3; ++corner)
      dust.add_vertex(at + Vec3{random.between(-0.8f, 0.8f), random.between(-0.8f, 0.8f), 0},
                      colour_wheel(i % 12 / 12.0));
  }
  b.draw_vertices(dust, Topology::kTriangles);
  Mesh nothing;  // three corners in one place, and three in a row
  for (const Vec3& p : {Vec3{20, 20, 0.5f}, Vec3{20, 20, 0.5f}, Vec3{20, 20, 0.5f}, Vec3{10, 10, 0.5f},
                        Vec3{50, 50, 0.5f}, Vec3{90, 90, 0.5f}})
    nothing.add_vertex(p, kWhite);
  b.draw_vertices(nothing, Topology::kTriangles);
}

// Every step of the target's colours: bands of red, green, blue and grey from none to full.
void build_colour_ramp(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  const Rgba8 full[] = {rgba8(255, 0, 0), rgba8(0, 255, 0), rgba8(0, 0, 255), rgba8(255, 255, 255)};
  for (std::uint32_t i = 0; i < 4; ++i) {
    const float top = 4 + 14 * to_float(i), right = to_float(b.width()) - 5;
    Mesh mesh;
    mesh.add_vertex({5, top, 0.5f}, rgba8(0, 0, 0));
    mesh.add_vertex({5, top + 12, 0.5f}, rgba8(0, 0, 0));
    mesh.add_vertex({right, top, 0.5f}, full[i]);
    mesh.add_vertex({right, top + 12, 0.5f}, full[i]);
    b.draw_vertices(mesh, Topology::kTriangleStrip);
  }
  b.draw_mesh(colour_hexagon({to_float(b.width()) / 2, 92, 0.5f}, 30));
}

void build_one_pixel(SceneBuilder& b) {
  b.clear_to_background();
  b.set_pixel_transform();
  Mesh mesh;
  mesh.add_vertex({-7, -7, 0.5f}, kAmber);
  mesh.add_vertex({-7, 9, 0.5f}, kAmber);
  mesh.add_vertex({9, -7, 0.5f}, kAmber);
  b.draw_vertices(mesh, Topology::kTriangles);
}

// The second list clears nothing: it goes on with the first one's colours and depths, in front of some and behind
// others.
void build_two_lists(SceneBuilder& b) {
  SetRasterState raster;
  raster.depth_test = 1;
  b.clear_to_background();
  b.set_pixel_transform();
  b.put(raster);
  b.draw_mesh(colour_hexagon({50, 60, 0.5f}, 44));
  b.next_list();
  b.set_pixel_transform();
  b.put(raster);
  b.draw_mesh(colour_hexagon({80, 44, 0.75f}, 30));
  b.draw_mesh(colour_hexagon({90, 84, 0.25f}, 30));
}

}  // namespace usuzumi::scenes
