// Everything constant over one draw call, worked out once from the engine's state.
#pragma once

#include <cstdint>

#include "gfx_subsystem/engine/state.h"
#include "gfx_subsystem/engine/texture_layout.h"
#include "gfx_subsystem/engine_soft/records.h"

namespace usuzumi::gfx::soft {

/// Pixels, from first to before last.
struct PixelRect {
  std::int32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool empty() const { return x0 >= x1 || y0 >= y1; }
};

/// How a draw samples its texture.
struct TextureSetup {
  const std::byte* texels;              // nullptr: no texture
  std::int32_t width, height;           // texels of level 0
  std::uint32_t level_count;
  command::TextureFormat format;
  command::TextureFilter filter;
  command::TextureWrap wrap_s, wrap_t;
  std::int32_t offset[kMaxTextureLevels];  // bytes from texels to the level
};

struct DrawSetup {
  DrawCall call;
  command::Topology topology;

  // Vertex stage.
  command::SetVertexStreams streams;
  const std::byte* positions;
  const std::byte* normals;             // nullptr: colours are not lit
  const std::byte* colours;             // nullptr: constant colour
  const std::byte* texture_coordinates;  // nullptr: none needed
  Mat4 transform;
  float scale[3], offset[3];            // 256 * window x, 256 * window y, depth in depth units, from clip / clip.w
  float depth_limit;                    // depth units of depth 1; 0 without a depth target
  float guard[2];                       // guard band: |clip.x| <= guard[0] * clip.w
  float lane_scale[3];                  // from 0..255 to lane units
  std::uint32_t lane_half[3];           // half a step of the target's channel
  float lane_limit[3];                  // lane units of 255
  Vec3 to_light, ambient, diffuse;

  // Primitives.
  PixelRect clip;                       // scissor, viewport and target
  bool flat;
  bool cull_positive, cull_negative;    // by the sign of the area
  bool rgb565;
  std::int32_t point_half_size, line_half_width;  // 24.8

  // Raster.
  bool depth_test;
  std::int32_t depth_bias;              // passes when depth < stored + bias: less 0, less or equal 1, always 2^30
  std::int32_t depth_write;             // -1 or 0

  // Fragments. Where there is a texture, an alpha test or blending, every triangle is Shading::kFragment, and lane
  // units are those of 8888 whatever the target.
  bool fragments;
  bool blend;
  std::uint32_t alpha_reference;        // fragments of less alpha are not drawn; 0 without alpha test
  std::uint32_t texels_per_pixel;       // 0, 1 or 4
  TextureSetup texture;
};

DrawSetup prepare_draw(const EngineState& state, const DrawCall& call);

/// Packs a colour the way planes are packed: rounded to nearest in every channel. XRGB8888 has 0xFF on top.
std::uint32_t pack_pixel(command::PixelFormat format, Rgba8 colour);

}  // namespace usuzumi::gfx::soft
