#include "firmware/device/scene_commands.h"

namespace usuzumi::firmware {
namespace {

/// Points and lines stand for whole meshes; two pixels keep them visible without making them more than a mark.
constexpr float kMarkSize = 2;

template <class... Packets>
constexpr std::uint32_t words_of = ((1 + command::kPayloadWords<Packets>) + ...);

constexpr std::uint32_t kFrameWords = words_of<command::SetColourTarget, command::SetDepthTarget, command::Clear,
                                               command::SetTransform, command::SetLight> +
                                      2;
constexpr std::uint32_t kMeshWords = words_of<command::SetRasterState, command::SetVertexStreams, command::Draw>;

void put_frame_state(command::Writer& list, const View& view, const Lighting& lighting, const FrameTarget& target) {
  const bool depth = target.depth_format != command::DepthFormat::kNone;
  list.put(
      command::SetColourTarget{target.picture, target.picture_stride_bytes, view.width, view.height, target.format});
  if (depth) list.put(command::SetDepthTarget{target.depth, target.depth_stride_bytes, target.depth_format});
  list.put(command::Clear{command::kClearColour | (depth ? command::kClearDepth : 0u), lighting.background, 1});
  list.put(command::SetTransform{view.model_to_clip});
  list.put(command::SetLight{1, lighting.to_light, lighting.ambient, lighting.diffuse});
}

command::SetVertexStreams streams_of(const CopyMesh& mesh, BusAddress block) {
  command::SetVertexStreams streams;
  streams.vertex_count = mesh.vertex_count;
  streams.positions = block;
  if (mesh.normal_offset != 0xFFFFFFFF) streams.normals = block + mesh.normal_offset;
  if (mesh.colour_offset != 0xFFFFFFFF) streams.colours = block + mesh.colour_offset;
  streams.constant_colour = mesh.base_colour;
  return streams;
}

void put_mesh(command::Writer& list, const CopyMesh& mesh, BusAddress block, bool depth) {
  command::SetRasterState raster;
  raster.cull = mesh.two_sided ? command::CullMode::kNone : command::CullMode::kBack;
  raster.depth_test = depth ? 1 : 0;
  raster.point_size = raster.line_width = kMarkSize;
  list.put(raster);
  list.put(streams_of(mesh, block));
  command::Draw draw{mesh.topology, mesh.index_format, 0, 0, mesh.vertex_count};
  if (mesh.index_format != command::IndexFormat::kNone) {
    draw.index_address = block + mesh.index_offset;
    draw.count = mesh.index_count;
  }
  list.put(draw);
}

}  // namespace

std::uint32_t scene_command_words(std::uint32_t meshes) { return kFrameWords + meshes * kMeshWords; }

Result<std::span<const std::uint32_t>> write_scene(const RamCopy& copy, const View& view, const Lighting& lighting,
                                                   const FrameTarget& target, const AddressTranslation& bus,
                                                   std::span<std::uint32_t> words) {
  command::Writer list(words);
  put_frame_state(list, view, lighting, target);
  for (std::uint32_t n = 0; n < copy.mesh_max(); ++n) {
    if (!copy.present(n)) continue;
    const BusAddress block = bus.bus_address(copy.block(n));
    if (block == 0) return Status{StatusCode::kFailedPrecondition, "RAM copy lies outside the bus; mesh number", n};
    put_mesh(list, copy.mesh(n), block, target.depth_format != command::DepthFormat::kNone);
  }
  return list.finish();
}

}  // namespace usuzumi::firmware
