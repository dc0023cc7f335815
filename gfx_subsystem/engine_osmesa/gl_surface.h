// The targets of a list as an OpenGL framebuffer: loaded from VRAM before the first drawing that needs the old picture,
// stored to VRAM when the list leaves them.
#pragma once

#include <cstdint>
#include <vector>

#include "gfx_subsystem/engine/state.h"
#include "gfx_subsystem/engine_osmesa/gl.h"

namespace usuzumi::gfx {

/// Row 0 of the framebuffer is the panel's top row, so that OpenGL's y rises where the panel's falls; draw with clip y
/// negated. The context is current in every call, the destructor's too.
class GlSurface {
 public:
  GlSurface() = default;
  ~GlSurface();
  GlSurface(const GlSurface&) = delete;
  GlSurface& operator=(const GlSurface&) = delete;

  /// Makes the state's targets the ones drawn to. Targets left behind are stored first.
  Status select(const EngineState& state);

  /// To be called before planes change: `whole` when every pixel of them is about to be overwritten, which spares the
  /// load.
  void prepare_colour(bool whole);
  void prepare_depth(bool whole);

  /// Writes the changed planes to VRAM and forgets the targets: the CPU may change VRAM between lists.
  void store();

 private:
  struct Plane {
    bool loaded = false;   // the texture holds the picture
    bool changed = false;  // ... and VRAM does not yet
  };

  bool same_targets(const EngineState& state) const;
  Status allocate_textures();
  void delete_textures();
  void load_rgb565();
  void store_rgb565();
  void load_depth24();
  void store_depth24();

  GLuint framebuffer_ = 0, colour_texture_ = 0, depth_texture_ = 0;
  std::uint32_t texture_width_ = 0, texture_height_ = 0;
  command::PixelFormat texture_format_ = command::PixelFormat::kXrgb8888;
  command::DepthFormat texture_depth_format_ = command::DepthFormat::kNone;

  command::SetColourTarget colour_target_;
  command::SetDepthTarget depth_target_;
  std::span<std::byte> colour_memory_, depth_memory_;  // empty between lists
  Plane colour_, depth_;
  std::vector<std::uint16_t> channels_;     // RGB565 on its way, 4 per pixel
  std::vector<std::uint32_t> depth_words_;  // 24-bit depths on their way
};

}  // namespace usuzumi::gfx
