#include "gfx_subsystem/engine_osmesa/gl_surface.h"

#include <bit>
#include <cstring>

namespace usuzumi::gfx {
namespace {

using command::DepthFormat;
using command::PixelFormat;

// What glTexImage2D and glReadPixels call our formats. Bits 31-24 of an XRGB8888 pixel travel as alpha, those of a
// 24-bit depth as stencil, all unchanged. RGB565 is drawn in 16 bits per channel and rounded to the nearest step when
// stored: llvmpipe's own GL_RGB565 rounds to 8 bits and then cuts, up to a whole step off.
struct TransferFormat {
  GLint internal;
  GLenum format, type;
};
constexpr TransferFormat transfer(PixelFormat f) {
  return f == PixelFormat::kRgb565 ? TransferFormat{GL_RGBA16, GL_RGBA, GL_UNSIGNED_SHORT}
                                   : TransferFormat{GL_RGBA8, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV};
}
constexpr TransferFormat transfer(DepthFormat f) {
  return f == DepthFormat::kUnorm16 ? TransferFormat{GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT}
                                    : TransferFormat{GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8};
}

constexpr std::uint32_t kDepth24Mask = 0x00FFFFFFu;

// A channel of `max` + 1 steps to and from 16 bits, each to the nearest: there and back gives the same.
constexpr std::uint16_t to_16_bits(std::uint32_t v, std::uint32_t max) {
  return static_cast<std::uint16_t>((v * 65535 + max / 2) / max);
}
constexpr std::uint32_t from_16_bits(std::uint32_t v, std::uint32_t max) { return (v * max + 32767) / 65535; }

// Rows in VRAM are a whole number of pixels apart: strides are multiples of 4 bytes and pixels 2 or 4.
GLint row_pixels(std::uint32_t stride_bytes, std::uint32_t pixel_bytes) {
  return static_cast<GLint>(stride_bytes / pixel_bytes);
}

GLuint make_texture(const TransferFormat& t, GLsizei width, GLsizei height) {
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  glTexImage2D(GL_TEXTURE_2D, 0, t.internal, width, height, 0, t.format, t.type, nullptr);
  return texture;
}

void upload(GLuint texture, const TransferFormat& t, GLint row_length, std::uint32_t width, std::uint32_t height,
            const void* pixels) {
  glBindTexture(GL_TEXTURE_2D, texture);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, row_length);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height), t.format, t.type,
                  pixels);
}

void download(const TransferFormat& t, GLint row_length, std::uint32_t width, std::uint32_t height, void* pixels) {
  glPixelStorei(GL_PACK_ROW_LENGTH, row_length);
  glReadPixels(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height), t.format, t.type, pixels);
}

}  // namespace

GlSurface::~GlSurface() { delete_textures(); }

bool GlSurface::same_targets(const EngineState& state) const {
  const auto& c = state.colour_target;
  const auto& d = state.depth_target;
  return !colour_memory_.empty() && colour_memory_.data() == state.colour_memory.data() &&
         depth_memory_.data() == state.depth_memory.data() && c.width == colour_target_.width &&
         c.height == colour_target_.height && c.format == colour_target_.format &&
         c.stride_bytes == colour_target_.stride_bytes && d.format == depth_target_.format &&
         (d.format == DepthFormat::kNone || d.stride_bytes == depth_target_.stride_bytes);
}

Status GlSurface::select(const EngineState& state) {
  if (same_targets(state)) return ok_status();
  store();
  colour_target_ = state.colour_target;
  depth_target_ = state.depth_target;
  colour_memory_ = state.colour_memory;
  depth_memory_ = state.depth_memory;
  return allocate_textures();
}

Status GlSurface::allocate_textures() {
  if (framebuffer_ != 0 && texture_width_ == colour_target_.width && texture_height_ == colour_target_.height &&
      texture_format_ == colour_target_.format && texture_depth_format_ == depth_target_.format)
    return ok_status();
  delete_textures();
  texture_width_ = colour_target_.width;
  texture_height_ = colour_target_.height;
  texture_format_ = colour_target_.format;
  texture_depth_format_ = depth_target_.format;
  const auto width = static_cast<GLsizei>(texture_width_), height = static_cast<GLsizei>(texture_height_);
  glGenFramebuffers(1, &framebuffer_);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  colour_texture_ = make_texture(transfer(texture_format_), width, height);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_texture_, 0);
  if (texture_depth_format_ != DepthFormat::kNone) {
    depth_texture_ = make_texture(transfer(texture_depth_format_), width, height);
    const GLenum attachment =
        texture_depth_format_ == DepthFormat::kUnorm16 ? GL_DEPTH_ATTACHMENT : GL_DEPTH_STENCIL_ATTACHMENT;
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, depth_texture_, 0);
  }
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return ok_status();
  delete_textures();
  colour_memory_ = depth_memory_ = {};
  return {StatusCode::kResourceExhausted, "OSMesa cannot make a framebuffer of this size and format", 0};
}

void GlSurface::delete_textures() {
  if (framebuffer_ != 0) glDeleteFramebuffers(1, &framebuffer_);
  if (colour_texture_ != 0) glDeleteTextures(1, &colour_texture_);
  if (depth_texture_ != 0) glDeleteTextures(1, &depth_texture_);
  framebuffer_ = colour_texture_ = depth_texture_ = 0;
}

void GlSurface::prepare_colour(bool whole) {
  if (!colour_.loaded && !whole) {
    if (colour_target_.format == PixelFormat::kRgb565) {
      load_rgb565();
    } else {
      upload(colour_texture_, transfer(PixelFormat::kXrgb8888), row_pixels(colour_target_.stride_bytes, 4),
             colour_target_.width, colour_target_.height, colour_memory_.data());
    }
  }
  colour_ = {true, true};
}

void GlSurface::prepare_depth(bool whole) {
  if (!depth_.loaded && !whole) {
    if (depth_target_.format == DepthFormat::kUnorm24) {
      load_depth24();
    } else {
      upload(depth_texture_, transfer(depth_target_.format), row_pixels(depth_target_.stride_bytes, 2),
             colour_target_.width, colour_target_.height, depth_memory_.data());
    }
  }
  depth_ = {true, true};
}

void GlSurface::store() {
  if (colour_memory_.empty()) return;
  if (colour_.changed) {
    if (colour_target_.format == PixelFormat::kRgb565) {
      store_rgb565();
    } else {
      download(transfer(PixelFormat::kXrgb8888), row_pixels(colour_target_.stride_bytes, 4), colour_target_.width,
               colour_target_.height, colour_memory_.data());
    }
  }
  if (depth_.changed) {
    if (depth_target_.format == DepthFormat::kUnorm24) {
      store_depth24();
    } else {
      download(transfer(depth_target_.format), row_pixels(depth_target_.stride_bytes, 2), colour_target_.width,
               colour_target_.height, depth_memory_.data());
    }
  }
  colour_ = depth_ = {};
  colour_memory_ = depth_memory_ = {};
}

void GlSurface::load_rgb565() {
  channels_.resize(std::size_t{colour_target_.width} * colour_target_.height * 4);
  std::uint16_t* channel = channels_.data();
  for (std::uint32_t y = 0; y < colour_target_.height; ++y) {
    const std::byte* row = colour_memory_.data() + std::size_t{colour_target_.stride_bytes} * y;
    for (std::uint32_t x = 0; x < colour_target_.width; ++x) {
      std::uint16_t v;
      std::memcpy(&v, row + std::size_t{x} * 2, 2);
      *channel++ = to_16_bits(v >> 11, 31);
      *channel++ = to_16_bits((v >> 5) & 0x3Fu, 63);
      *channel++ = to_16_bits(v & 0x1Fu, 31);
      *channel++ = 0xFFFF;
    }
  }
  upload(colour_texture_, transfer(PixelFormat::kRgb565), 0, colour_target_.width, colour_target_.height,
         channels_.data());
}

void GlSurface::store_rgb565() {
  channels_.resize(std::size_t{colour_target_.width} * colour_target_.height * 4);
  download(transfer(PixelFormat::kRgb565), 0, colour_target_.width, colour_target_.height, channels_.data());
  const std::uint16_t* channel = channels_.data();
  for (std::uint32_t y = 0; y < colour_target_.height; ++y) {
    std::byte* row = colour_memory_.data() + std::size_t{colour_target_.stride_bytes} * y;
    for (std::uint32_t x = 0; x < colour_target_.width; ++x, channel += 4) {
      const auto v = static_cast<std::uint16_t>(from_16_bits(channel[0], 31) << 11 | from_16_bits(channel[1], 63) << 5 |
                                                from_16_bits(channel[2], 31));
      std::memcpy(row + std::size_t{x} * 2, &v, 2);
    }
  }
}

// VRAM has the depth in bits 23-0; OpenGL has it in bits 31-8 and the stencil below.
void GlSurface::load_depth24() {
  depth_words_.resize(std::size_t{colour_target_.width} * colour_target_.height);
  std::uint32_t* word = depth_words_.data();
  for (std::uint32_t y = 0; y < colour_target_.height; ++y) {
    const std::byte* row = depth_memory_.data() + std::size_t{depth_target_.stride_bytes} * y;
    for (std::uint32_t x = 0; x < colour_target_.width; ++x) {
      std::uint32_t v;
      std::memcpy(&v, row + std::size_t{x} * 4, 4);
      *word++ = std::rotl(v, 8);
    }
  }
  upload(depth_texture_, transfer(DepthFormat::kUnorm24), 0, colour_target_.width, colour_target_.height,
         depth_words_.data());
}

// A word whose depth has not changed keeps its bits 31-24; the others get zeros there.
void GlSurface::store_depth24() {
  depth_words_.resize(std::size_t{colour_target_.width} * colour_target_.height);
  download(transfer(DepthFormat::kUnorm24), 0, colour_target_.width, colour_target_.height, depth_words_.data());
  const std::uint32_t* word = depth_words_.data();
  for (std::uint32_t y = 0; y < colour_target_.height; ++y) {
    std::byte* row = depth_memory_.data() + std::size_t{depth_target_.stride_bytes} * y;
    for (std::uint32_t x = 0; x < colour_target_.width; ++x) {
      std::uint32_t old;
      std::memcpy(&old, row + std::size_t{x} * 4, 4);
      const std::uint32_t depth = *word++ >> 8;
      if (depth != (old & kDepth24Mask)) std::memcpy(row + std::size_t{x} * 4, &depth, 4);
    }
  }
}

}  // namespace usuzumi::gfx
