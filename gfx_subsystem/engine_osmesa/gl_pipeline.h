// One command of a list as OpenGL calls: state, clear, draw, count. The context is current in every call, the
// destructor's too.
#pragma once

#include <cstdint>

#include "gfx_subsystem/engine/state.h"
#include "gfx_subsystem/engine_osmesa/gl.h"

namespace usuzumi::gfx {

class GlPipeline {
 public:
  GlPipeline() = default;
  ~GlPipeline();
  GlPipeline(const GlPipeline&) = delete;
  GlPipeline& operator=(const GlPipeline&) = delete;

  /// Compiles the shaders; once, before all else. kUnavailable where OpenGL refuses them.
  Status start();

  void clear(const EngineState& state, const command::Clear& clear);

  /// Draws, and returns how many pixels the primitives cover within target and scissor, before the depth test.
  std::uint64_t draw(const EngineState& state, const DrawCall& call);

 private:
  void apply_viewport(const command::SetViewport& viewport);
  void apply_raster_state(const command::SetRasterState& raster);
  void apply_depth_state(const command::SetRasterState& raster);
  void apply_uniforms(const EngineState& state);
  void apply_streams(const EngineState& state);
  std::uint64_t submit_counted(const DrawCall& call);

  GLuint program_ = 0, query_ = 0;
  GLint model_to_clip_ = -1, lit_ = -1, to_light_ = -1, ambient_ = -1, diffuse_ = -1;
};

}  // namespace usuzumi::gfx
