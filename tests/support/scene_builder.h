// Puts a scene's vertices into RAM and its commands into lists.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/command_list.h"
#include "tests/support/scene.h"
#include "tests/support/scene_memory.h"
#include "tests/support/scene_meshes.h"

namespace usuzumi::scenes {

class SceneBuilder {
 public:
  /// Every list begins with the packets that set the targets.
  SceneBuilder(SceneMemory& memory, const command::SetColourTarget& colour, const command::SetDepthTarget& depth,
               Rgba8 background);

  const command::SetColourTarget& target() const { return colour_; }
  std::uint32_t width() const { return colour_.width; }
  std::uint32_t height() const { return colour_.height; }
  double aspect() const { return static_cast<double>(width()) / height(); }

  template <class Packet>
  void put(const Packet& packet) {
    words_.push_back(command::header_word(command::OpcodeOf<Packet>::value, command::kPayloadWords<Packet>));
    const std::size_t at = words_.size();
    words_.resize(at + command::kPayloadWords<Packet>);
    std::memcpy(&words_[at], &packet, sizeof packet);
  }

  /// Clears colour to the background and depth, if there is any, to 1.
  void clear_to_background();

  void set_transform(const Mat4& model_to_clip) { put(command::SetTransform{model_to_clip}); }
  /// Vertices in pixels from here on (scene_math.h).
  void set_pixel_transform();

  /// Copies to RAM; the address is a multiple of 4.
  template <class T>
  BusAddress store(const std::vector<T>& data) {
    return store_bytes(std::as_bytes(std::span<const T>(data)));
  }

  /// The mesh's vertices as streams; `constant` where it has no colours.
  void set_streams(const Mesh& mesh, Rgba8 constant = {});
  /// The mesh's vertices in their order.
  void draw_vertices(const Mesh& mesh, command::Topology topology, Rgba8 constant = {});
  /// The mesh's triangles by 16-bit indices where they fit.
  void draw_mesh(const Mesh& mesh, Rgba8 constant = {});

  /// Ends this list and begins the next, with state as a list begins with and the same targets.
  void next_list();

  /// Ends the last list; all of them, in order.
  std::vector<std::vector<std::uint32_t>> finish();
  /// Bytes of RAM stored so far.
  std::size_t ram_used() const { return ram_used_; }

 private:
  BusAddress store_bytes(std::span<const std::byte> bytes);
  void begin_list();
  void end_list();

  SceneMemory& memory_;
  command::SetColourTarget colour_;
  command::SetDepthTarget depth_;
  Rgba8 background_;
  std::size_t ram_used_ = 0;
  std::vector<std::uint32_t> words_;
  std::vector<std::vector<std::uint32_t>> lists_;
};

}  // namespace usuzumi::scenes
