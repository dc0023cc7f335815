// The numbered golden scenes: each a picture that an engine draws from command lists, small enough to keep as PNG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "gfx_subsystem/engine/engine.h"
#include "hal/command_list.h"
#include "sim/image/image.h"

namespace usuzumi::scenes {

class SceneBuilder;

/// What a scene draws into.
struct TargetSpec {
  std::uint32_t width = 0, height = 0;
  command::PixelFormat format = command::PixelFormat::kXrgb8888;
  command::DepthFormat depth = command::DepthFormat::kNone;
  std::uint32_t row_padding_bytes = 0;  // beyond the row rounded up to 4 bytes
};

/// How far another engine's colours may be from ours: pixels out of a thousand by more than `channel` of 255.
struct PeerTolerance {
  std::uint32_t channel = 2, per_mille = 5;
};

struct Scene {
  const char* name;  // "07-indexed-u32": the number, then words; names the PNG and the line in the manifest
  const char* note;  // what the scene proves
  TargetSpec target;
  std::function<void(SceneBuilder&)> build;
  PeerTolerance peer = {};
};

/// All scenes in the order of their numbers.
std::span<const Scene> all_scenes();

/// Five and six bits become eight by repeating the upper ones below, as the display controller sends them.
sim::Image picture_of(const TargetSpec& target, std::uint32_t stride_bytes, std::span<const std::byte> colour_plane);

/// One plane's place in VRAM.
struct Plane {
  std::size_t offset = 0, bytes = 0;
  std::uint32_t stride = 0, row_bytes = 0;  // bytes; all zero where there is no such plane
};

/// A scene as an engine gets it: what lies in RAM from SceneMemory::kRamBase on, the command lists, and where in VRAM
/// they draw.
struct SceneRecording {
  std::vector<std::byte> ram;
  std::vector<std::vector<std::uint32_t>> lists;
  Plane colour, depth;
  std::size_t vram_bytes = 0;
  std::uint32_t background_pixel = 0;  // what every pixel holds before the first list
};

struct SceneDrawing {
  Status status;
  sim::Image picture;
  std::vector<std::byte> colour_plane, depth_plane;  // as left in VRAM, with the padding of rows
  gfx::EngineCounters counters;                      // of all lists together
  bool strayed = false;  // a byte of VRAM outside the targets' pixels changed
};

inline constexpr Rgba8 kBackground = rgba8(24, 28, 36);
/// Differs from kBackground in every channel, in 16 bits too.
inline constexpr Rgba8 kOtherBackground = rgba8(230, 226, 219);

/// VRAM's pixels are `background` at first, and so is what the scene clears to unless the clear is what it shows:
/// pixels equal over two backgrounds are those the scene covers.
SceneRecording record_scene(const Scene& scene, Rgba8 background = kBackground);
/// Draws the scene in fresh memory.
SceneDrawing draw_scene(const Scene& scene, gfx::Engine& engine, Rgba8 background = kBackground);

}  // namespace usuzumi::scenes
