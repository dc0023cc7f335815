#include "gfx_subsystem/engine_soft/draw_setup.h"

#include <algorithm>
#include <cmath>

namespace usuzumi::gfx::soft {
namespace {

using namespace command;

/// First pixel whose centre is at or right of `edge`.
std::int32_t first_centre(float edge) { return static_cast<std::int32_t>(std::ceil(edge - 0.5f)); }

PixelRect clip_rect(const EngineState& s) {
  const auto& v = s.viewport;
  PixelRect r{static_cast<std::int32_t>(s.scissor.x), static_cast<std::int32_t>(s.scissor.y),
              static_cast<std::int32_t>(s.scissor.x + s.scissor.width),
              static_cast<std::int32_t>(s.scissor.y + s.scissor.height)};
  r.x0 = std::max(r.x0, first_centre(v.x));
  r.y0 = std::max(r.y0, first_centre(v.y));
  r.x1 = std::min(r.x1, first_centre(v.x + v.width));
  r.y1 = std::min(r.y1, first_centre(v.y + v.height));
  return r;
}

/// The guard band in units of clip.w. Capped so that guard * kMaxClipValue stays finite.
float guard(float centre, float half) {
  return std::min((kGuardPixels - std::fabs(centre)) / half, 1e6f);
}

TextureSetup texture_setup(const EngineState& s) {
  TextureSetup t{};
  if (s.texels.empty()) return t;
  t.texels = s.texels.data();
  t.width = static_cast<std::int32_t>(s.texture.width);
  t.height = static_cast<std::int32_t>(s.texture.height);
  t.level_count = s.texture.level_count;
  t.format = s.texture.format;
  t.filter = s.texture.filter;
  t.wrap_s = s.texture.wrap_s;
  t.wrap_t = s.texture.wrap_t;
  for (std::uint32_t i = 0; i < t.level_count; ++i) t.offset[i] = static_cast<std::int32_t>(level_offset(s.texture, i));
  return t;
}

}  // namespace

DrawSetup prepare_draw(const EngineState& s, const DrawCall& call) {
  DrawSetup d{};
  d.call = call;
  d.topology = call.draw.topology;

  d.streams = s.streams;
  d.positions = s.positions.data();
  d.normals = s.light.enabled != 0 ? s.normals.data() : nullptr;
  d.colours = s.colours.data();
  d.transform = s.transform.model_to_clip;

  const auto& v = s.viewport;
  const float half_width = v.width / 2, half_height = v.height / 2;
  const float centre_x = v.x + half_width, centre_y = v.y + half_height;
  d.depth_limit = s.depth_target.format == DepthFormat::kUnorm16   ? 65535.0f
                  : s.depth_target.format == DepthFormat::kUnorm24 ? 16777215.0f
                                                                   : 0.0f;
  d.scale[0] = half_width * kSubpixelOne;
  d.scale[1] = -half_height * kSubpixelOne;
  d.scale[2] = (v.far_depth - v.near_depth) / 2;
  d.offset[0] = centre_x * kSubpixelOne;
  d.offset[1] = centre_y * kSubpixelOne;
  d.offset[2] = (v.far_depth + v.near_depth) / 2;
  d.guard[0] = guard(centre_x, half_width);
  d.guard[1] = guard(centre_y, half_height);

  d.texture = texture_setup(s);
  d.texture_coordinates = s.texels.empty() ? nullptr : s.texture_coordinates.data();
  d.texels_per_pixel = s.texels.empty() ? 0 : s.texture.filter == TextureFilter::kBilinear ? 4 : 1;
  d.blend = s.fragment.blend == BlendMode::kAlpha;
  d.alpha_reference = s.fragment.alpha_test != 0 ? s.fragment.alpha_reference : 0;
  d.fragments = !s.texels.empty() || d.blend || d.alpha_reference != 0;

  d.rgb565 = s.colour_target.format == PixelFormat::kRgb565;
  const bool lanes565 = d.rgb565 && !d.fragments;
  const std::uint32_t levels[3] = {lanes565 ? 31u : 255u, lanes565 ? 63u : 255u, lanes565 ? 31u : 255u};
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t step = 65536 / (levels[k] + 1);
    d.lane_scale[k] = static_cast<float>(levels[k] * step) / 255.0f;
    d.lane_limit[k] = static_cast<float>(levels[k] * step);
    d.lane_half[k] = step / 2;
  }
  d.to_light = s.light.to_light;
  d.ambient = s.light.ambient;
  d.diffuse = s.light.diffuse;

  const auto& r = s.raster;
  d.clip = clip_rect(s);
  d.flat = r.shade_model == ShadeModel::kFlat;
  const bool clockwise_is_front = r.front_face == FrontFace::kClockwise;
  d.cull_positive = r.cull == (clockwise_is_front ? CullMode::kFront : CullMode::kBack);
  d.cull_negative = r.cull == (clockwise_is_front ? CullMode::kBack : CullMode::kFront);
  d.point_half_size = static_cast<std::int32_t>(r.point_size * kSubpixelHalf + 0.5f);
  d.line_half_width = static_cast<std::int32_t>(r.line_width * kSubpixelHalf + 0.5f);

  d.depth_test = r.depth_test != 0;
  d.depth_bias = r.depth_function == DepthFunction::kLess        ? 0
                 : r.depth_function == DepthFunction::kLessEqual ? 1
                                                                 : 1 << 30;
  d.depth_write = r.depth_write != 0 ? -1 : 0;
  return d;
}

std::uint32_t pack_pixel(PixelFormat format, Rgba8 c) {
  if (format == PixelFormat::kXrgb8888) return 0xFF000000u | c.r() << 16 | c.g() << 8 | c.b();
  const auto round_to = [](std::uint32_t value, std::uint32_t levels) { return (value * levels * 2 + 255) / 510; };
  return round_to(c.r(), 31) << 11 | round_to(c.g(), 63) << 5 | round_to(c.b(), 31);
}

}  // namespace usuzumi::gfx::soft
