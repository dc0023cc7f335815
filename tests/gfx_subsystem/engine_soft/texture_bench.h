// What tests of textures share: images of known texels, and quads that carry them.
#pragma once

#include "gfx_subsystem/engine/texture_layout.h"
#include "tests/gfx_subsystem/engine_soft/test_bench.h"

namespace usuzumi::gfx::test {

/// Texels as alpha, red, green, blue; one level.
struct TestImage {
  std::uint32_t width, height;
  std::vector<std::uint32_t> texels;  // row by row
};

inline SetTexture upload_argb(Bench& b, const TestImage& image, TextureFilter filter,
                              TextureWrap wrap = TextureWrap::kClamp) {
  return {TextureFormat::kArgb8888, b.upload(image.texels), image.width, image.height, 1, filter, wrap, wrap};
}

/// Two triangles over the pixels' rectangle. st[0] is at its top left, the others follow clockwise.
struct TexturedQuad {
  float x0, y0, x1, y1;
  TexCoord st[4];
  float z = 0.5f;
  Rgba8 colour[4] = {{}, {}, {}, {}};
};

inline Bench& draw_quad(Bench& b, const TexturedQuad& q) {
  const std::vector<Vec3> p{{q.x0, q.y0, q.z}, {q.x1, q.y0, q.z}, {q.x1, q.y1, q.z}, {q.x0, q.y1, q.z}};
  SetVertexStreams s;
  s.vertex_count = 4;
  s.positions = b.upload(p);
  s.colours = b.upload(std::vector<Rgba8>(q.colour, q.colour + 4));
  s.texture_coordinates = b.upload(std::vector<TexCoord>(q.st, q.st + 4));
  return b.put(s).draw(Topology::kTriangleFan, 4);
}

/// The whole image over the rectangle.
inline TexturedQuad image_over(float x0, float y0, float x1, float y1) {
  return {x0, y0, x1, y1, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
}

/// Coordinates from a to b in both axes.
inline TexturedQuad image_part(float x0, float y0, float x1, float y1, float a, float b) {
  return {x0, y0, x1, y1, {{a, a}, {b, a}, {b, b}, {a, b}}};
}

/// Runs the check on every kernel variant.
template <class Check>
void on_every_kernel(Check check) {
  for (const auto* kernels : soft::all_kernels())
    if (kernels->supported()) {
      SCOPED_TRACE(kernels->name);
      EngineSetup setup;
      setup.kernels = kernels;
      check(setup);
    }
}

}  // namespace usuzumi::gfx::test
