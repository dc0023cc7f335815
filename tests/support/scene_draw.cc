// Runs a scene on an engine and watches what it does to VRAM.
#include <algorithm>
#include <cstring>

#include "tests/support/scene.h"
#include "tests/support/scene_builder.h"
#include "tests/support/scene_memory.h"

namespace usuzumi::scenes {
namespace {

using namespace command;

// Arbitrary, and no depth or colour of a scene.
constexpr std::byte kUntouched{0xA5};
constexpr std::size_t kRamBytes = std::size_t{4} << 20;
constexpr std::uint32_t kGuardBytes = 4096;  // before, between and after the planes

std::uint32_t round_up4(std::uint32_t v) { return (v + 3) / 4 * 4; }

std::uint32_t pixel_bits(PixelFormat format, Rgba8 c) {
  if (format == PixelFormat::kRgb565) return (c.r() >> 3) << 11 | (c.g() >> 2) << 5 | c.b() >> 3;
  return 0xFF000000u | c.r() << 16 | c.g() << 8 | c.b();
}

Plane place(std::size_t offset, std::uint32_t row_bytes, const TargetSpec& t) {
  const std::uint32_t stride = row_bytes == 0 ? 0 : round_up4(row_bytes) + t.row_padding_bytes;
  return {offset, std::size_t{stride} * t.height, stride, row_bytes};
}

// Calls visit(first byte, bytes) for each row's pixels.
template <class Visit>
void for_each_row(const Plane& plane, std::uint32_t height, Visit visit) {
  for (std::uint32_t y = 0; y < height && plane.row_bytes > 0; ++y)
    visit(plane.offset + std::size_t{y} * plane.stride, plane.row_bytes);
}

void fill_background(std::span<std::byte> vram, const SceneRecording& scene, const TargetSpec& t) {
  const std::uint32_t size = bytes_per_pixel(t.format);
  for_each_row(scene.colour, t.height, [&](std::size_t at, std::uint32_t bytes) {
    for (std::uint32_t i = 0; i < bytes; i += size) std::memcpy(&vram[at + i], &scene.background_pixel, size);
  });
}

bool outside_pixels_untouched(std::vector<std::byte> vram, const SceneRecording& scene, const TargetSpec& t) {
  const auto forgive = [&](std::size_t at, std::uint32_t bytes) {
    std::memset(&vram[at], static_cast<int>(kUntouched), bytes);
  };
  for_each_row(scene.colour, t.height, forgive);
  for_each_row(scene.depth, t.height, forgive);
  for (std::byte b : vram)
    if (b != kUntouched) return false;
  return true;
}

void add(gfx::EngineCounters& sum, const gfx::EngineCounters& c) {
  sum.command_words += c.command_words;
  sum.vertices_transformed += c.vertices_transformed;
  sum.primitives_in += c.primitives_in;
  sum.faces_in += c.faces_in;
  sum.faces_drawn += c.faces_drawn;
  sum.pixels_tested += c.pixels_tested;
  sum.pixels_cleared += c.pixels_cleared;
}

}  // namespace

sim::Image picture_of(const TargetSpec& target, std::uint32_t stride_bytes, std::span<const std::byte> colour_plane) {
  sim::Image picture(target.width, target.height);
  const std::uint32_t size = bytes_per_pixel(target.format);
  for (std::uint32_t y = 0; y < target.height; ++y) {
    for (std::uint32_t x = 0; x < target.width; ++x) {
      std::uint32_t v = 0;
      std::memcpy(&v, &colour_plane[std::size_t{y} * stride_bytes + std::size_t{x} * size], size);
      if (target.format == PixelFormat::kRgb565) {
        const std::uint32_t r = v >> 11, g = (v >> 5) & 0x3F, b = v & 0x1F;
        v = (r << 3 | r >> 2) << 16 | (g << 2 | g >> 4) << 8 | (b << 3 | b >> 2);
      }
      picture.at(x, y) = v & 0xFFFFFF;
    }
  }
  return picture;
}

SceneRecording record_scene(const Scene& scene, Rgba8 background) {
  const TargetSpec& t = scene.target;
  SceneRecording recording;
  recording.colour = place(kGuardBytes, t.width * bytes_per_pixel(t.format), t);
  recording.depth = place(recording.colour.offset + recording.colour.bytes + kGuardBytes,
                          t.width * bytes_per_depth(t.depth), t);
  recording.vram_bytes = recording.depth.offset + recording.depth.bytes + kGuardBytes;
  recording.background_pixel = pixel_bits(t.format, background);

  const auto address = [](const Plane& p) { return SceneMemory::kVramBase + static_cast<BusAddress>(p.offset); };
  SceneMemory memory(kRamBytes, 0);
  SceneBuilder builder(memory, {address(recording.colour), recording.colour.stride, t.width, t.height, t.format},
                       {address(recording.depth), recording.depth.stride, t.depth}, background);
  scene.build(builder);
  recording.lists = builder.finish();
  const auto used = memory.ram().first(builder.ram_used());
  recording.ram.assign(used.begin(), used.end());
  return recording;
}

SceneDrawing draw_scene(const Scene& scene, gfx::Engine& engine, Rgba8 background) {
  const TargetSpec& t = scene.target;
  const SceneRecording recording = record_scene(scene, background);
  SceneMemory memory(recording.ram.size(), recording.vram_bytes);
  std::copy(recording.ram.begin(), recording.ram.end(), memory.ram().begin());
  std::memset(memory.vram().data(), static_cast<int>(kUntouched), memory.vram().size());
  fill_background(memory.vram(), recording, t);

  SceneDrawing drawing;
  for (const auto& list : recording.lists) {
    const gfx::ExecutionReport report = engine.execute(list, memory);
    add(drawing.counters, report.counters);
    if (drawing.status.ok()) drawing.status = report.status;
  }
  const auto vram = memory.vram();
  const auto copy = [&](const Plane& p) {
    const auto bytes = vram.subspan(p.offset, p.bytes);
    return std::vector<std::byte>(bytes.begin(), bytes.end());
  };
  drawing.colour_plane = copy(recording.colour);
  drawing.depth_plane = copy(recording.depth);
  drawing.picture = picture_of(t, recording.colour.stride, drawing.colour_plane);
  drawing.strayed = !outside_pixels_untouched({vram.begin(), vram.end()}, recording, t);
  return drawing;
}

}  // namespace usuzumi::scenes
