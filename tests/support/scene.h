// The numbered golden scenes: each a picture that an engine draws from command lists, small enough to keep as PNG.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gfx_subsystem/engine/engine.h"
#include "hal/command_list.h"

namespace usuzumi::scenes {

class SceneBuilder;

/// What a scene draws into.
struct TargetSpec {
  std::uint32_t width = 0, height = 0;
  command::PixelFormat format = command::PixelFormat::kXrgb8888;
  command::DepthFormat depth = command::DepthFormat::kNone;
  std::uint32_t row_padding_bytes = 0;  // beyond the row rounded up to 4 bytes
};

struct Scene {
  const char* name;  // "07-indexed-u32": the number, then words; names the PNG and the line in the manifest
  const char* note;  // what the scene proves
  TargetSpec target;
  void (*build)(SceneBuilder&);
};

/// All scenes in the order of their numbers.
std::span<const Scene> all_scenes();

/// Rows from the top, each width * 3 bytes R, G, B.
struct RgbPicture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  const std::uint8_t* pixel(std::uint32_t x, std::uint32_t y) const { return &rgb[(std::size_t{y} * width + x) * 3]; }
  friend bool operator==(const RgbPicture&, const RgbPicture&) = default;
};

/// CRC-32 of the R, G, B bytes in scan order: what the manifest holds and what the panel's picture must give as well.
std::uint32_t picture_crc32(const RgbPicture& picture);

/// Five and six bits become eight by repeating the upper ones below, as the display controller sends them.
RgbPicture picture_of(const TargetSpec& target, std::uint32_t stride_bytes, std::span<const std::byte> colour_plane);

struct SceneDrawing {
  Status status;
  RgbPicture picture;
  std::vector<std::byte> colour_plane, depth_plane;  // as left in VRAM, with the padding of rows
  gfx::EngineCounters counters;                      // of all lists together
  bool strayed = false;  // a byte of VRAM outside the targets' pixels changed
};

inline constexpr Rgba8 kBackground = rgba8(24, 28, 36);

/// Draws the scene in fresh memory. VRAM's pixels are `background` at first, and so is what the scene clears to unless the
/// clear is what it shows: pixels equal over two backgrounds are those the scene covers.
SceneDrawing draw_scene(const Scene& scene, gfx::Engine& engine, Rgba8 background = kBackground);

}  // namespace usuzumi::scenes
