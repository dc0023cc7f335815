#include "firmware/drawing_data/drawing_data.h"

#include <cstddef>

#include "firmware/drawing_data/container_check.h"
#include "firmware/drawing_data/mesh_layers.h"
#include "firmware/drawing_data/solids_check.h"

namespace usuzumi::firmware {
namespace {

using format::kAbsent;

/// The section's letters without the zeros behind them.
std::string_view board_name(std::span<const std::byte> rom, const Range& section) {
  std::string_view name(reinterpret_cast<const char*>(rom.data()) + section.begin, section.end - section.begin);
  while (!name.empty() && name.back() == '\0') name.remove_suffix(1);
  return name;
}

MeshView bare_view(const Words& words, std::uint32_t n, std::uint32_t record_offset) {
  MeshView view;
  view.number = n;
  view.level = static_cast<Level>(words.at(record_offset + 4));
  view.positions = words.array<Vec3>(record_offset + kRecordHeadBytes, words.at(record_offset));
  view.flags = format::kFlagTwoSided;  // the winding of a bare strip says nothing about its outside
  return view;
}

}  // namespace

Result<DrawingData> DrawingData::open(std::span<const std::byte> rom) {
  if (reinterpret_cast<std::uintptr_t>(rom.data()) % 4 != 0)
    return Status{StatusCode::kInvalidArgument, "drawing data must begin at a multiple of 4 bytes", 0};
  if (rom.empty())
    return damaged("there are no drawing data: the file is empty or the flash erased; bytes present", 0);
  if (rom.size() < 4)
    return damaged("file is too short for drawing data; bytes present", static_cast<std::uint32_t>(rom.size()));
  if (rom.size() > format::kMaxFileBytes) return unsupported("drawing data is larger than 1 GiB", 0);
  const Words words(rom);
  const auto size = static_cast<std::uint32_t>(rom.size());
  DrawingData data;
  data.rom_ = rom;

  if (words.at(0) == __builtin_bswap32(format::kMagic))
    return damaged("container is big-endian: pack for a little-endian device, at byte offset", 0);
  if (words.at(0) != format::kMagic) {
    if (size % 4 != 0)
      return damaged("neither a container (no magic USZ1) nor bare data (size is no multiple of 4); bytes", size);
    const Status status = check_records(words, 0, size);
    if (!status.ok()) return status;
    data.mesh_max_ = words.at(0);
    return data;
  }

  Sections sections;
  const Status status = check_container(rom, sections);
  if (!status.ok()) return status;
  data.bare_ = false;
  data.board_ = board_name(rom, sections.board);
  data.mesh_max_ = words.at(sections.records.begin);
  data.first_record_ = sections.records.begin + 4;
  data.descriptors_offset_ = sections.meshes.begin;
  data.materials_offset_ = sections.materials.begin;
  data.material_count_ = sections.materials.bytes() / static_cast<std::uint32_t>(sizeof(format::Material));
  data.layers_end_ = sections.layers.end;
  data.textures_offset_ = sections.textures.begin;
  data.texture_count_ = sections.textures.bytes() / static_cast<std::uint32_t>(sizeof(format::Texture));
  data.solids_ = solids_of(words, sections);
  const Status layers = data.check_layers();
  if (!layers.ok()) return layers;
  return data;
}

Status DrawingData::check_layers() const {
  for (std::uint32_t n = 0; n < mesh_max_; ++n) {
    const MeshView mesh = mesh_at(n, 0);
    if (mesh.layers.empty()) continue;
    Status status = check_mesh_layers(mesh);
    if (status.ok()) continue;
    status.where += static_cast<std::uint32_t>(mesh.layers.data() - rom_.data());
    return status;
  }
  return ok_status();
}

std::uint32_t DrawingData::next_record(std::uint32_t record_offset) const {
  return record_offset + record_bytes(Words(rom_).at(record_offset));
}

MeshView DrawingData::mesh(std::uint32_t n) const {
  if (!bare_) return mesh_at(n, 0);
  std::uint32_t offset = first_record_;
  for (std::uint32_t i = 0; i < n; ++i) offset = next_record(offset);
  return mesh_at(n, offset);
}

MeshView DrawingData::mesh_at(std::uint32_t n, std::uint32_t record_offset) const {
  const Words words(rom_);
  if (bare_) return bare_view(words, n, record_offset);
  const auto d = words.object<format::MeshDescriptor>(descriptors_offset_ +
                                                      n * static_cast<std::uint32_t>(sizeof(format::MeshDescriptor)));
  MeshView view = bare_view(words, n, d.record_offset);
  const auto vertices = static_cast<std::uint32_t>(view.positions.size());
  view.topology = d.topology;
  if (d.normal_offset != kAbsent) view.normals = words.array<PackedNormal>(d.normal_offset, vertices);
  if (d.colour_offset != kAbsent) view.colours = words.array<Rgba8>(d.colour_offset, vertices);
  if (d.topology == format::Topology::kIndexed)
    view.indices = rom_.subspan(d.index_offset, std::size_t{d.index_count} * d.index_bytes);
  view.index_bytes = d.index_bytes;
  view.index_count = d.index_count;
  view.base_colour = {d.base_colour};
  view.quota_kind = d.quota_kind;
  view.quota = d.quota;
  view.area_threshold_px = d.area_threshold_px;
  view.flags = d.flags;
  view.name = text(d.name_offset, d.name_bytes);
  if (d.texture_coordinate_offset != kAbsent)
    view.texture_coordinates = words.array<TexCoord>(d.texture_coordinate_offset, vertices);
  if ((d.flags & format::kFlagGroups) != 0)
    view.groups = words.array<format::FaceGroup>(d.material + 4, words.at(d.material));
  else
    view.material = material(d.material);
  view.textured = view.material.texture.present();
  for (const format::FaceGroup& group : view.groups)
    view.textured = view.textured || material(group.material).texture.present();
  view.method = static_cast<Method>(d.method);
  if (d.method_settings_offset != 0) view.method_settings = rom_.data() + d.method_settings_offset;
  if (d.edge_value_offset != 0) view.edge_values = words.array<float>(d.edge_value_offset, vertices);
  if (d.layer_offset != 0) view.layers = rom_.subspan(d.layer_offset, layers_end_ - d.layer_offset);
  return view;
}

std::string_view DrawingData::text(std::uint32_t offset, std::uint32_t bytes) const {
  if (offset == kAbsent) return {};
  return {reinterpret_cast<const char*>(rom_.data()) + offset, bytes};
}

TextureView DrawingData::texture(std::uint32_t n) const {
  const auto t = Words(rom_).object<format::Texture>(textures_offset_ +
                                                     n * static_cast<std::uint32_t>(sizeof(format::Texture)));
  TextureView view;
  view.number = n;
  view.format = static_cast<command::TextureFormat>(t.format);
  view.width = t.width;
  view.height = t.height;
  view.level_count = t.level_count;
  view.texels = rom_.subspan(
      t.texel_offset, static_cast<std::size_t>(texture_bytes(view.format, t.width, t.height, t.level_count)));
  view.name = text(t.name_offset, t.name_bytes);
  return view;
}

MaterialView DrawingData::material(std::uint32_t n) const {
  if (n == kAbsent) return {};
  const auto m = Words(rom_).object<format::Material>(materials_offset_ +
                                                      n * static_cast<std::uint32_t>(sizeof(format::Material)));
  MaterialView view;
  view.number = n;
  if (m.texture != kAbsent) view.texture = texture(m.texture);
  view.filter = static_cast<command::TextureFilter>(m.filter);
  view.wrap_s = static_cast<command::TextureWrap>(m.wrap_s);
  view.wrap_t = static_cast<command::TextureWrap>(m.wrap_t);
  view.alpha_mode = m.alpha_mode;
  view.alpha_reference = m.alpha_reference;
  return view;
}

}  // namespace usuzumi::firmware
