// The engine's state as a command list has set it, with every address resolved and every value checked: what both
// engines draw from.
#pragma once

#include <cstddef>
#include <span>

#include "hal/command_list.h"

namespace usuzumi::gfx {

struct EngineState {
  command::SetColourTarget colour_target;
  // height * stride bytes (the last row may end at its last pixel); empty: no target.
  std::span<std::byte> colour_memory;
  command::SetDepthTarget depth_target;
  std::span<std::byte> depth_memory;   // empty: no depth target
  command::SetScissor scissor;         // clipped to the target
  command::SetViewport viewport;
  command::SetTransform transform;
  command::SetLight light;
  command::SetRasterState raster;
  command::SetVertexStreams streams;
  std::span<const std::byte> positions, normals, colours, texture_coordinates;  // resolved; all but positions may be
                                                                                // empty
  command::SetTexture texture;
  std::span<const std::byte> texels;  // all levels (texture_layout.h); empty: no texture
  command::SetFragmentState fragment;
};

/// One checked draw. Indices are proven < streams.vertex_count before a consumer sees them.
struct DrawCall {
  command::Draw draw;
  std::span<const std::byte> indices;  // from `first` on; empty when draw.index_format is kNone
  std::uint32_t min_vertex = 0;        // range of vertices the draw refers to
  std::uint32_t max_vertex = 0;
  std::uint32_t word = 0;              // the packet's word in the list

  /// Vertex number of the draw's i-th vertex, i < draw.count.
  std::uint32_t vertex(std::uint32_t i) const {
    switch (draw.index_format) {
      case command::IndexFormat::kU16: {
        std::uint16_t v;
        std::memcpy(&v, indices.data() + 2 * std::size_t{i}, 2);
        return v;
      }
      case command::IndexFormat::kU32: {
        std::uint32_t v;
        std::memcpy(&v, indices.data() + 4 * std::size_t{i}, 4);
        return v;
      }
      case command::IndexFormat::kNone: break;
    }
    return draw.first + i;
  }
};

/// Triangles a draw submits.
constexpr std::uint32_t face_count(command::Topology topology, std::uint32_t count) {
  switch (topology) {
    case command::Topology::kTriangles: return count / 3;
    case command::Topology::kTriangleStrip:
    case command::Topology::kTriangleFan: return count < 3 ? 0 : count - 2;
    default: return 0;
  }
}

/// Receives what the decoder has proven sound, in list order. A status that is not ok stops the list.
class CommandSink {
 public:
  virtual Status clear(const EngineState& state, const command::Clear& clear) = 0;
  virtual Status draw(const EngineState& state, const DrawCall& call) = 0;

 protected:
  ~CommandSink() = default;
};

/// Walks a list from its first word to kEnd. Stops at the first fault with the word's number in `where`.
/// `command_words` receives the words consumed.
Status decode(std::span<const std::uint32_t> list, BusMemory& memory, CommandSink& sink, std::uint64_t& command_words);

}  // namespace usuzumi::gfx
