#include "firmware/device/scene_commands.h"

#include <cstring>

#include "firmware/solids/solid_placement.h"

namespace usuzumi::firmware {
namespace {

/// Points and lines stand for whole meshes; two pixels keep them visible without making them more than a mark.
constexpr float kMarkSize = 2;

template <class... Packets>
constexpr std::uint32_t words_of = ((1 + command::kPayloadWords<Packets>) + ...);

constexpr std::uint32_t kFrameWords = words_of<command::SetColourTarget, command::SetDepthTarget, command::Clear,
                                               command::SetTransform, command::SetLight> +
                                      2;
constexpr std::uint32_t kDrawWords = words_of<command::SetRasterState, command::SetVertexStreams, command::Draw>;

void put_frame_state(command::Writer& list, const View& view, const Lighting& lighting, const FrameTarget& target) {
  const bool depth = target.depth_format != command::DepthFormat::kNone;
  list.put(
      command::SetColourTarget{target.picture, target.picture_stride_bytes, view.width, view.height, target.format});
  if (depth) list.put(command::SetDepthTarget{target.depth, target.depth_stride_bytes, target.depth_format});
  list.put(command::Clear{command::kClearColour | (depth ? command::kClearDepth : 0u), lighting.background, 1});
  list.put(command::SetTransform{view.model_to_clip});
  list.put(command::SetLight{1, lighting.to_light, lighting.ambient, lighting.diffuse});
}

bool same(const auto& a, const auto& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

bool blends(const MaterialView& material) { return material.alpha_mode == format::AlphaMode::kBlend; }

command::SetFragmentState fragment_state_of(const MaterialView& material) {
  switch (material.alpha_mode) {
    case format::AlphaMode::kOpaque: break;
    case format::AlphaMode::kMask: return {1, material.alpha_reference, command::BlendMode::kNone};
    case format::AlphaMode::kBlend: return {0, 0, command::BlendMode::kAlpha};
  }
  return {};
}

Status unreachable(const char* message, const MeshView& mesh) {
  return {StatusCode::kFailedPrecondition, message, mesh.number};
}

/// Writes the draws, and of texture and fragment state what differs from what was written last.
class SceneWriter {
 public:
  SceneWriter(const Thinning& thinning, const AddressTranslation& bus, bool depth, command::Writer& list)
      : thinning_(thinning), data_(thinning.data()), copy_(thinning.copy()), bus_(bus), depth_(depth), list_(list) {}

  /// Those parts of the present meshes that are blended, or all others.
  Status put_meshes(bool blended);
  /// Every solid in sight, by the member that its size asks for.
  Status put_solids(const SolidsToDraw& solids, const View& view);
  /// Whether put_meshes() has come across anything that is blended.
  bool any_blended() const { return any_blended_; }

 private:
  Status put_mesh(const MeshView& mesh, bool blended);
  Status put_layered(const MeshView& mesh, bool blended);
  Status put_group(const MeshView& mesh, const format::FaceGroup& group, bool blended, std::uint32_t first,
                   std::uint32_t count);
  Status put_texture(const MeshView& mesh, const MaterialView& material);
  void put_plain();
  Status put_solid(const SolidMembers& members, std::uint32_t n, Member member, const DrawnMember& drawn);
  Status add_streams_of(const MeshView& mesh, BusAddress block, command::SetVertexStreams& streams) const;

  const Thinning& thinning_;
  const DrawingData& data_;
  const RamCopy& copy_;
  const AddressTranslation& bus_;
  bool depth_;
  command::Writer& list_;
  command::SetTexture texture_;  // as the engine has it now
  command::SetFragmentState fragment_;
  bool any_blended_ = false;
};

Status SceneWriter::put_meshes(bool blended) {
  std::uint32_t record = data_.first_record();
  for (std::uint32_t n = 0; n < copy_.mesh_max(); ++n, record = data_.next_record(record)) {
    if (!copy_.present(n)) continue;
    const Status status = put_mesh(data_.mesh_at(n, record), blended);
    if (!status.ok()) return status;
  }
  return ok_status();
}

Status SceneWriter::put_mesh(const MeshView& mesh, bool blended) {
  const CopyMesh& copy = copy_.mesh(mesh.number);
  const std::span<const std::uint32_t> words = copy_.group_words(mesh.number);
  const bool indexed = copy.index_format != command::IndexFormat::kNone;
  if (copy.layered) return put_layered(mesh, blended);
  if (mesh.groups.empty() || !indexed) {  // a point or a line has the material of its vertex
    const std::uint32_t group = words.empty() || words[0] >= mesh.group_count() ? 0 : words[0];
    return put_group(mesh, mesh.group(group), blended, 0, indexed ? copy.index_count : copy.vertex_count);
  }
  std::uint32_t first = 0;
  for (std::uint32_t g = 0; g < mesh.group_count(); ++g) {
    const format::FaceGroup group = mesh.group(g);
    const std::uint32_t end = 3 * (g < words.size() ? words[g] : group.face_end);
    const Status status = end > first ? put_group(mesh, group, blended, first, end - first) : ok_status();
    if (!status.ok()) return status;
    first = end;
  }
  return ok_status();
}

/// Of each group's slots the live ones, which are the first.
Status SceneWriter::put_layered(const MeshView& mesh, bool blended) {
  const std::span<const std::uint32_t> live = copy_.group_words(mesh.number);
  const LayerChainView chain = thinning_.layers(mesh.number)->view();
  for (std::uint32_t g = 0; g < mesh.group_count(); ++g) {
    if (live[g] == 0) continue;
    const Status status = put_group(mesh, mesh.group(g), blended, 3 * chain.group_begin(g), 3 * live[g]);
    if (!status.ok()) return status;
  }
  return ok_status();
}

Status SceneWriter::put_group(const MeshView& mesh, const format::FaceGroup& group, bool blended, std::uint32_t first,
                              std::uint32_t count) {
  const MaterialView material = data_.material(group.material);
  any_blended_ = any_blended_ || blends(material);
  if (blends(material) != blended) return ok_status();
  const CopyMesh& copy = copy_.mesh(mesh.number);
  const BusAddress block = bus_.bus_address(copy_.block(mesh.number));
  if (block == 0) return unreachable("RAM copy lies outside the bus; mesh number", mesh);

  Status status = put_texture(mesh, material);
  if (!status.ok()) return status;
  const command::SetFragmentState fragment = fragment_state_of(material);
  if (!same(fragment, fragment_)) list_.put(fragment);
  fragment_ = fragment;

  command::SetRasterState raster;
  raster.cull = copy.two_sided ? command::CullMode::kNone : command::CullMode::kBack;
  raster.depth_test = depth_ ? 1 : 0;
  raster.depth_write = blended ? 0 : 1;
  raster.point_size = raster.line_width = kMarkSize;
  list_.put(raster);
  command::SetVertexStreams streams;
  streams.constant_colour = {group.base_colour};
  status = add_streams_of(mesh, block, streams);
  if (!status.ok()) return status;
  list_.put(streams);
  command::Draw draw{copy.topology, copy.index_format, 0, first, count};
  if (copy.index_format != command::IndexFormat::kNone) draw.index_address = block + copy.index_offset;
  list_.put(draw);
  return ok_status();
}

Status SceneWriter::put_texture(const MeshView& mesh, const MaterialView& material) {
  command::SetTexture texture;
  const TextureView& image = material.texture;
  if (image.present()) {
    const BusAddress base = bus_.bus_address(image.texels.data());
    if (base == 0)
      return unreachable("texture lies where the 3D engine does not reach: map the ROM to the bus; mesh number", mesh);
    texture = {image.format,    base,            image.width,     image.height, image.level_count,
               material.filter, material.wrap_s, material.wrap_t};
  }
  if (!same(texture, texture_)) list_.put(texture);
  texture_ = texture;
  return ok_status();
}

/// No texture, no blending.
void SceneWriter::put_plain() {
  if (!same(command::SetTexture{}, texture_)) list_.put(command::SetTexture{});
  if (!same(command::SetFragmentState{}, fragment_)) list_.put(command::SetFragmentState{});
  texture_ = {};
  fragment_ = {};
}

Status SceneWriter::put_solids(const SolidsToDraw& solids, const View& view) {
  SolidMembers& members = solids.members;
  if (members.count() == 0) return ok_status();
  put_plain();
  const Thresholds thresholds = thresholds_fall(solids.settings.thresholds) ? solids.settings.thresholds : Thresholds{};
  const Eye eye = eye_of(view.model_to_clip);
  for (std::uint32_t n = 0; n < members.count(); ++n) {
    const format::Solid& solid = members.solid(n);
    const SolidView seen = look_at(solid, view, solids.settings.clip_margin);
    if (seen.clipped) {
      ++solids.report.clipped;
      continue;
    }
    const Member member = seen.at_the_eye ? Member::kHigh : member_of(seen.size_px, thresholds);
    const DrawnMember drawn = members.choose(n, member, eye.from(SolidPlacement::of(solid).origin));
    const Status status = put_solid(members, n, member, drawn);
    if (!status.ok()) return status;
    ++solids.report.drawn[static_cast<std::uint32_t>(member)];
    solids.report.faces += drawn.faces;
  }
  return ok_status();
}

Status SceneWriter::put_solid(const SolidMembers& members, std::uint32_t n, Member member, const DrawnMember& drawn) {
  if (drawn.index_count == 0) return ok_status();
  const BusAddress positions = bus_.bus_address(members.positions().data());
  const BusAddress normals = bus_.bus_address(members.normals().data());
  const BusAddress indices = bus_.bus_address(members.indices().data());
  if (positions == 0 || normals == 0 || indices == 0)
    return {StatusCode::kFailedPrecondition, "members of solids lie outside the bus; solid number", n};
  command::SetRasterState raster;
  raster.cull = member == Member::kRough ? command::CullMode::kNone : command::CullMode::kBack;
  raster.depth_test = depth_ ? 1 : 0;
  raster.point_size = raster.line_width = kMarkSize;
  list_.put(raster);
  command::SetVertexStreams streams;
  streams.vertex_count = drawn.vertex_count;
  streams.positions = positions + drawn.first_vertex * static_cast<std::uint32_t>(sizeof(Vec3));
  streams.normals = normals + drawn.first_vertex * static_cast<std::uint32_t>(sizeof(PackedNormal));
  streams.constant_colour = {members.solid(n).colour};
  list_.put(streams);
  command::Draw draw{command::Topology::kTriangles, command::IndexFormat::kU16, indices, drawn.first_index,
                     drawn.index_count};
  list_.put(draw);
  return ok_status();
}

/// The streams in ROM where the copy leaves them there, and those in the copy's block.
Status SceneWriter::add_streams_of(const MeshView& mesh, BusAddress block, command::SetVertexStreams& streams) const {
  const CopyMesh& copy = copy_.mesh(mesh.number);
  streams.vertex_count = copy.vertex_count;
  streams.positions = block;
  if (copy.vertices_in_rom) {
    const auto address_of = [&](auto stream) { return stream.empty() ? 0 : bus_.bus_address(stream.data()); };
    streams.positions = address_of(mesh.positions);
    streams.normals = address_of(mesh.normals);
    streams.colours = address_of(mesh.colours);
    if (mesh.textured) streams.texture_coordinates = address_of(mesh.texture_coordinates);
    if (streams.positions == 0)
      return unreachable("vertices lie where the 3D engine does not reach: map the ROM to the bus; mesh number", mesh);
  }
  if (copy.normal_offset != kNoStream) streams.normals = block + copy.normal_offset;
  if (copy.colour_offset != kNoStream) streams.colours = block + copy.colour_offset;
  if (copy.texture_coordinate_offset != kNoStream)
    streams.texture_coordinates = block + copy.texture_coordinate_offset;
  return ok_status();
}

}  // namespace

std::uint32_t scene_command_words(const DrawingData& data) {
  std::uint32_t draws = 0, textured = 0, alpha = 0;
  data.for_each_mesh([&](const MeshView& mesh) {
    for (std::uint32_t g = 0; g < mesh.group_count(); ++g) {
      const MaterialView material = data.material(mesh.group(g).material);
      ++draws;
      if (material.texture.present()) ++textured;
      if (material.alpha_mode != format::AlphaMode::kOpaque) ++alpha;
    }
  });
  // A state that differs from the default is set at most once by each draw that has it, and taken back at most once
  // after it.
  const auto solids = static_cast<std::uint32_t>(data.solids().solids.size());
  draws += solids;
  const std::uint32_t plain =
      solids > 0 ? words_of<command::SetTexture> + words_of<command::SetFragmentState> : 0;
  return kFrameWords + plain + draws * kDrawWords + 2 * textured * words_of<command::SetTexture> +
         2 * alpha * words_of<command::SetFragmentState>;
}

Result<std::span<const std::uint32_t>> write_scene(const Thinning& thinning, const View& view, const Lighting& lighting,
                                                   const FrameTarget& target, const AddressTranslation& bus,
                                                   std::span<std::uint32_t> words, const SolidsToDraw* solids) {
  command::Writer list(words);
  put_frame_state(list, view, lighting, target);
  SceneWriter scene(thinning, bus, target.depth_format != command::DepthFormat::kNone, list);
  Status status = scene.put_meshes(false);
  if (status.ok() && solids != nullptr) status = scene.put_solids(*solids, view);
  if (status.ok() && scene.any_blended()) status = scene.put_meshes(true);
  if (!status.ok()) return status;
  return list.finish();
}

}  // namespace usuzumi::firmware
