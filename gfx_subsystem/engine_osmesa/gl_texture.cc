#include "gfx_subsystem/engine_osmesa/gl_texture.h"

#include <cstdint>

#include "gfx_subsystem/engine/texture_layout.h"

namespace usuzumi::gfx {
namespace {

using namespace command;

constexpr GLint wrap_name(TextureWrap wrap) {
  switch (wrap) {
    case TextureWrap::kRepeat: return GL_REPEAT;
    case TextureWrap::kClamp: return GL_CLAMP_TO_EDGE;
    case TextureWrap::kMirror: return GL_MIRRORED_REPEAT;
  }
  return GL_REPEAT;
}

constexpr GLint filter_name(TextureFilter filter, bool levels) {
  if (filter == TextureFilter::kNearest) return levels ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST;
  return levels ? GL_LINEAR_MIPMAP_NEAREST : GL_LINEAR;
}

struct TexelFormat {
  GLint internal;
  GLenum format, type;
};
constexpr TexelFormat texel_format(TextureFormat f) {
  switch (f) {
    case TextureFormat::kRgb565: return {GL_RGB8, GL_RGB, GL_UNSIGNED_SHORT_5_6_5};
    case TextureFormat::kXrgb8888: return {GL_RGB8, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV};
    default: return {GL_RGBA8, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV};
  }
}

bool same_image(const SetTexture& a, const SetTexture& b) {
  return a.format == b.format && a.width == b.width && a.height == b.height && a.level_count == b.level_count;
}

}  // namespace

GlTexture::~GlTexture() {
  if (texture_ != 0) glDeleteTextures(1, &texture_);
}

void GlTexture::bind(const EngineState& state) {
  if (texture_ == 0) glGenTextures(1, &texture_);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture_);
  const SetTexture& t = state.texture;
  if (texels_.data() != state.texels.data() || !same_image(uploaded_, t)) upload(state);
  const auto set = [](GLenum parameter, GLint value) { glTexParameteri(GL_TEXTURE_2D, parameter, value); };
  set(GL_TEXTURE_BASE_LEVEL, 0);
  set(GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(t.level_count) - 1);
  set(GL_TEXTURE_MIN_FILTER, filter_name(t.filter, t.level_count > 1));
  set(GL_TEXTURE_MAG_FILTER, filter_name(t.filter, false));
  set(GL_TEXTURE_WRAP_S, wrap_name(t.wrap_s));
  set(GL_TEXTURE_WRAP_T, wrap_name(t.wrap_t));
}

/// Rows begin at multiples of 4 bytes, as OpenGL's default has it too; the surface's row length is none of ours.
void GlTexture::upload(const EngineState& state) {
  const SetTexture& t = state.texture;
  const TexelFormat f = texel_format(t.format);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  for (std::uint32_t i = 0; i < t.level_count; ++i)
    glTexImage2D(GL_TEXTURE_2D, static_cast<GLint>(i), f.internal, static_cast<GLsizei>(level_size(t.width, i)),
                 static_cast<GLsizei>(level_size(t.height, i)), 0, f.format, f.type,
                 state.texels.data() + level_offset(t, i));
  uploaded_ = t;
  texels_ = state.texels;
}

}  // namespace usuzumi::gfx
