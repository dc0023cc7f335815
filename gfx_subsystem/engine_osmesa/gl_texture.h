// The texture of a list's draws as an OpenGL texture, on unit 0.
#pragma once

#include "gfx_subsystem/engine/state.h"
#include "gfx_subsystem/engine_osmesa/gl.h"

namespace usuzumi::gfx {

/// The context is current in every call, the destructor's too.
class GlTexture {
 public:
  GlTexture() = default;
  ~GlTexture();
  GlTexture(const GlTexture&) = delete;
  GlTexture& operator=(const GlTexture&) = delete;

  /// The CPU may change texels between lists: what was uploaded is not trusted any more.
  void begin_list() { texels_ = {}; }

  /// Binds the state's texture, uploading it unless it was the last one; only where there is one.
  void bind(const EngineState& state);

 private:
  void upload(const EngineState& state);

  GLuint texture_ = 0;
  command::SetTexture uploaded_;
  std::span<const std::byte> texels_;  // of which uploaded_ is the description; empty: none
};

}  // namespace usuzumi::gfx
