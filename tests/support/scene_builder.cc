#include "tests/support/scene_builder.h"

#include <cassert>

#include "tests/support/scene_math.h"

namespace usuzumi::scenes {

SceneBuilder::SceneBuilder(SceneMemory& memory, const command::SetColourTarget& colour,
                           const command::SetDepthTarget& depth, Rgba8 background)
    : memory_(memory), colour_(colour), depth_(depth), background_(background) {
  begin_list();
}

void SceneBuilder::clear_to_background() {
  const bool has_depth = depth_.format != command::DepthFormat::kNone;
  put(command::Clear{command::kClearColour | (has_depth ? command::kClearDepth : 0), background_, 1});
}

void SceneBuilder::set_pixel_transform() { set_transform(pixels_to_clip(width(), height())); }

void SceneBuilder::set_streams(const Mesh& mesh, Rgba8 constant) {
  command::SetVertexStreams streams;
  streams.vertex_count = static_cast<std::uint32_t>(mesh.positions.size());
  streams.positions = store(mesh.positions);
  if (!mesh.normals.empty()) streams.normals = store(mesh.normals);
  if (!mesh.colours.empty()) streams.colours = store(mesh.colours);
  streams.constant_colour = constant;
  if (!mesh.texture_coordinates.empty()) streams.texture_coordinates = store(mesh.texture_coordinates);
  put(streams);
}

void SceneBuilder::draw_vertices(const Mesh& mesh, command::Topology topology, Rgba8 constant) {
  set_streams(mesh, constant);
  put(command::Draw{topology, command::IndexFormat::kNone, 0, 0, static_cast<std::uint32_t>(mesh.positions.size())});
}

void SceneBuilder::draw_mesh(const Mesh& mesh, Rgba8 constant) {
  set_streams(mesh, constant);
  command::Draw draw{command::Topology::kTriangles, command::IndexFormat::kU32, 0, 0,
                     static_cast<std::uint32_t>(mesh.indices.size())};
  if (mesh.positions.size() <= 0x10000) {
    draw.index_format = command::IndexFormat::kU16;
    draw.index_address = store(std::vector<std::uint16_t>(mesh.indices.begin(), mesh.indices.end()));
  } else {
    draw.index_address = store(mesh.indices);
  }
  put(draw);
}

void SceneBuilder::next_list() {
  end_list();
  begin_list();
}

std::vector<std::vector<std::uint32_t>> SceneBuilder::finish() {
  end_list();
  return std::move(lists_);
}

BusAddress SceneBuilder::store_bytes(std::span<const std::byte> bytes) {
  assert(bytes.size() <= memory_.ram().size() - ram_used_ && "scene needs more RAM than draw_scene gives");
  const std::size_t at = ram_used_;
  std::memcpy(memory_.ram().data() + at, bytes.data(), bytes.size());
  ram_used_ += (bytes.size() + 3) / 4 * 4;
  return SceneMemory::kRamBase + static_cast<BusAddress>(at);
}

void SceneBuilder::begin_list() {
  put(colour_);
  if (depth_.format != command::DepthFormat::kNone) put(depth_);
}

void SceneBuilder::end_list() {
  words_.push_back(command::header_word(command::Opcode::kEnd, 0));
  lists_.push_back(std::move(words_));
  words_.clear();
}

}  // namespace usuzumi::scenes
