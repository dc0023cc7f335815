// A small target in VRAM, a list built packet by packet, and the engine under test, one for the whole program.
#pragma once

#include <cstring>
#include <vector>

#include "gfx_subsystem/engine_osmesa/osmesa_engine.h"
#include "hal/command_list.h"
#include "tests/support/scene_math.h"
#include "tests/support/scene_memory.h"

namespace usuzumi::gfx {

using namespace command;
using scenes::SceneMemory;

inline OsmesaEngine& shared_engine() {
  static OsmesaEngine engine;
  return engine;
}

class Bench {
 public:
  static constexpr std::uint32_t kWidth = 16, kHeight = 12;
  static constexpr std::uint32_t kDepthOffset = 0x4000;

  explicit Bench(PixelFormat format = PixelFormat::kXrgb8888, DepthFormat depth_format = DepthFormat::kNone,
                 std::uint32_t padding_bytes = 0)
      : memory(1 << 16, 1 << 16),
        colour{SceneMemory::kVramBase, kWidth * bytes_per_pixel(format) + padding_bytes, kWidth, kHeight, format},
        depth{SceneMemory::kVramBase + kDepthOffset, kWidth * bytes_per_depth(depth_format) + padding_bytes,
              depth_format} {
    begin();
  }

  void begin() {
    words.clear();
    put(colour);
    if (depth.format != DepthFormat::kNone) put(depth);
  }

  template <class Packet>
  void put(const Packet& packet) {
    std::uint32_t payload[kPayloadWords<Packet>];
    std::memcpy(payload, &packet, sizeof packet);
    words.push_back(header_word(OpcodeOf<Packet>::value, kPayloadWords<Packet>));
    words.insert(words.end(), std::begin(payload), std::end(payload));
  }

  void set_pixel_transform() { put(SetTransform{scenes::pixels_to_clip(kWidth, kHeight)}); }

  template <class T>
  BusAddress store(const std::vector<T>& data) {
    const std::size_t at = ram_used_;
    std::memcpy(memory.ram().data() + at, data.data(), data.size() * sizeof(T));
    ram_used_ = (at + data.size() * sizeof(T) + 3) / 4 * 4;
    return SceneMemory::kRamBase + static_cast<BusAddress>(at);
  }

  void draw(Topology topology, const std::vector<Vec3>& positions, Rgba8 colour_of_all) {
    SetVertexStreams streams;
    streams.vertex_count = static_cast<std::uint32_t>(positions.size());
    streams.positions = store(positions);
    streams.constant_colour = colour_of_all;
    put(streams);
    put(Draw{topology, IndexFormat::kNone, 0, 0, streams.vertex_count});
  }

  /// Covers the pixels [x, x + width) x [y, y + height), under the pixel transform.
  void rectangle(float x, float y, float width, float height, float at_depth, Rgba8 colour_of_all) {
    draw(Topology::kTriangleStrip,
         {{x, y, at_depth}, {x, y + height, at_depth}, {x + width, y, at_depth}, {x + width, y + height, at_depth}},
         colour_of_all);
  }

  ExecutionReport run(Engine& engine = shared_engine()) {
    words.push_back(header_word(Opcode::kEnd, 0));
    return engine.execute(words, memory);
  }

  std::uint32_t pixel(std::uint32_t x, std::uint32_t y) {
    return read(0, colour.stride_bytes, bytes_per_pixel(colour.format), x, y);
  }
  std::uint32_t depth_at(std::uint32_t x, std::uint32_t y) {
    return read(kDepthOffset, depth.stride_bytes, bytes_per_depth(depth.format), x, y);
  }
  void set_depth(std::uint32_t x, std::uint32_t y, std::uint32_t value) {
    const std::uint32_t size = bytes_per_depth(depth.format);
    std::memcpy(memory.vram().data() + kDepthOffset + y * depth.stride_bytes + x * size, &value, size);
  }
  std::size_t count_pixels(std::uint32_t value) {
    std::size_t n = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x) n += pixel(x, y) == value ? 1u : 0u;
    return n;
  }

  SceneMemory memory;
  SetColourTarget colour;
  SetDepthTarget depth;
  std::vector<std::uint32_t> words;

 private:
  std::uint32_t read(std::size_t plane, std::uint32_t stride, std::uint32_t size, std::uint32_t x, std::uint32_t y) {
    std::uint32_t v = 0;
    std::memcpy(&v, memory.vram().data() + plane + y * stride + x * size, size);
    return v;
  }

  std::size_t ram_used_ = 0;
};

}  // namespace usuzumi::gfx
