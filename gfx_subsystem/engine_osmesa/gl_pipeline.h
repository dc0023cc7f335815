// One command of a list as OpenGL calls: state, clear, draw, count. The context is current in every call, the
// destructor's too.
#pragma once

#include <cstdint>

#include "gfx_subsystem/engine/state.h"
#include "gfx_subsystem/engine_osmesa/gl.h"
#include "gfx_subsystem/engine_osmesa/gl_texture.h"

namespace usuzumi::gfx {

class GlPipeline {
 public:
  GlPipeline() = default;
  ~GlPipeline();
  GlPipeline(const GlPipeline&) = delete;
  GlPipeline& operator=(const GlPipeline&) = delete;

  /// Compiles the shaders; once, before all else. kUnavailable where OpenGL refuses them.
  Status start();

  /// To be called before a list's first command.
  void begin_list() { texture_.begin_list(); }

  void clear(const EngineState& state, const command::Clear& clear);

  /// Draws, and returns how many pixels the primitives cover within target and scissor, before the depth test.
  std::uint64_t draw(const EngineState& state, const DrawCall& call);

 private:
  void apply_viewport(const command::SetViewport& viewport);
  void apply_raster_state(const command::SetRasterState& raster);
  void apply_depth_state(const command::SetRasterState& raster);
  void apply_blend_state(const command::SetFragmentState& fragment);
  void apply_uniforms(const EngineState& state);
  void apply_streams(const EngineState& state);
  void apply_texture_coordinates(const EngineState& state);
  std::uint64_t submit_counted(const DrawCall& call);

  GLuint program_ = 0, query_ = 0;
  GlTexture texture_;
  GLint textured_ = -1, blended_ = -1, alpha_reference_ = -1;
  GLint model_to_clip_ = -1, lit_ = -1, to_light_ = -1, ambient_ = -1, diffuse_ = -1;
};

}  // namespace usuzumi::gfx
