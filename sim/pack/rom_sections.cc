#include "sim/pack/rom_sections.h"

#include <algorithm>
#include <utility>

#include "firmware/solids/view_candidates.h"
#include "sim/pack/method_settings.h"
#include "sim/pack/texture_levels.h"

namespace usuzumi::sim {

namespace format = firmware::format;

namespace {

constexpr std::uint32_t kNotThere = format::kAbsent;  // until place() writes 0 for it

/// Vertex colours that are all alike are a base colour.
bool uniform(std::span<const Rgba8> colours) {
  return std::all_of(colours.begin(), colours.end(), [&](Rgba8 c) { return c == colours.front(); });
}

std::uint32_t number_or_absent(const std::optional<std::uint32_t>& number) { return number.value_or(format::kAbsent); }

/// `at` from the file's start, where it is an offset in a section that begins at `section`.
void shift(std::uint32_t& at, std::uint32_t section) {
  if (at != format::kAbsent) at += section;
}
/// The same of offsets that are 0 where there is none.
void shift_or_zero(std::uint32_t& at, std::uint32_t section) { at = at == kNotThere ? 0 : at + section; }

}  // namespace

void write_record(Bytes& out, std::uint32_t level, std::span<const Vec3> positions) {
  out.u32(static_cast<std::uint32_t>(positions.size()));
  out.u32(level);
  for (const Vec3& p : positions) {
    out.f32(p.x);
    out.f32(p.y);
    out.f32(p.z);
  }
}

std::uint32_t level_of(const Mesh& mesh) { return mesh.tags.level.value_or(0); }

RomSections::RomSections(const Model& model, const RomOptions& options) {
  records_.u32(static_cast<std::uint32_t>(model.meshes.size()));
  for (const Mesh& mesh : model.meshes) add_mesh(mesh);
  for (const Material& material : model.materials) add_material(material);
  for (const Picture& picture : model.textures) add_texture(picture, options);
  add_solids(model);
  names_.pad_to_word();
  board_.text(options.board);
  board_.pad_to_word();
}

void RomSections::add_mesh(const Mesh& mesh) {
  format::MeshDescriptor d;
  d.record_offset = records_.size();
  write_record(records_, level_of(mesh), mesh.positions);
  add_faces(mesh, d);
  add_vertex_data(mesh, d);
  if (mesh.tags.quota) {
    d.quota_kind = mesh.tags.quota->kind;
    d.quota = mesh.tags.quota->value;
  }
  d.area_threshold_px = mesh.tags.area_threshold_px.value_or(-1.0f);
  d.flags =
      (mesh.tags.telltale.value_or(false) ? format::kFlagTelltale : 0) | (mesh.two_sided ? format::kFlagTwoSided : 0);
  add_appearance(mesh, d);
  add_method(mesh, d);
  add_layers(mesh, d);
  d.name_offset = names_.size();
  d.name_bytes = static_cast<std::uint32_t>(mesh.name.size());
  names_.text(mesh.name);
  meshes_.push_back(d);
}

void RomSections::add_faces(const Mesh& mesh, format::MeshDescriptor& d) {
  d.topology = format::Topology::kIndexed;
  d.index_offset = indices_.size();
  d.index_count = static_cast<std::uint32_t>(mesh.indices.size());
  d.index_bytes = mesh.positions.size() <= 65536 ? 2 : 4;
  for (std::uint32_t i : mesh.indices) d.index_bytes == 2 ? indices_.u16(i) : indices_.u32(i);
  indices_.pad_to_word();
}

void RomSections::add_vertex_data(const Mesh& mesh, format::MeshDescriptor& d) {
  if (!mesh.normals.empty()) {
    d.normal_offset = normals_.size();
    for (const Vec3& n : mesh.normals) normals_.u32(pack_normal(n).bits);
  }
  d.base_colour = mesh.base_colour.bits;
  if (!mesh.colours.empty() && mesh.parts.empty() && uniform(mesh.colours)) {
    d.base_colour = mesh.colours.front().bits;
  } else if (!mesh.colours.empty()) {
    d.colour_offset = colours_.size();
    for (Rgba8 c : mesh.colours) colours_.u32(c.bits);
  }
  if (!mesh.texture_coordinates.empty()) {
    d.texture_coordinate_offset = texture_coordinates_.size();
    for (const TexCoord& c : mesh.texture_coordinates) {
      texture_coordinates_.f32(c.s);
      texture_coordinates_.f32(c.t);
    }
  }
}

void RomSections::add_appearance(const Mesh& mesh, format::MeshDescriptor& d) {
  d.material = number_or_absent(mesh.material);
  if (mesh.parts.empty()) return;
  d.flags |= format::kFlagGroups;
  d.material = groups_.size();
  groups_.u32(static_cast<std::uint32_t>(mesh.parts.size()));
  for (const MeshPart& part : mesh.parts) {
    groups_.u32(part.face_end);
    groups_.u32(part.vertex_end);
    groups_.u32(number_or_absent(part.material));
    groups_.u32(part.base_colour.bits);
  }
}

/// Equal settings lie in ROM once.
void RomSections::add_method(const Mesh& mesh, format::MeshDescriptor& d) {
  const firmware::Method method = mesh.tags.method.value_or(firmware::Method::kQem);
  d.method = static_cast<format::Method>(method);
  d.method_settings_offset = d.edge_value_offset = kNotThere;
  if (mesh.tags.settings) {
    const auto words = setting_words(method, *mesh.tags.settings);
    const auto [at, fresh] = settings_.try_emplace(words, methods_.size());
    if (fresh)
      for (std::uint32_t word : words) methods_.u32(word);
    d.method_settings_offset = at->second;
  }
  if (mesh.edge_values.empty()) return;
  d.edge_value_offset = edge_values_.size();
  for (float value : mesh.edge_values) edge_values_.f32(value);
}

void RomSections::add_layers(const Mesh& mesh, format::MeshDescriptor& d) {
  d.layer_offset = mesh.layer_chain.empty() ? kNotThere : layers_.size();
  layers_.raw(mesh.layer_chain);
}

void RomSections::add_solids(const Model& model) {
  if (model.solids.empty()) return;
  const std::span<const Vec3> candidates =
      model.view_candidates.empty() ? std::span<const Vec3>(firmware::kDefaultCandidates) : model.view_candidates;
  solids_.u32(static_cast<std::uint32_t>(model.solids.size()));
  solids_.u32(static_cast<std::uint32_t>(candidates.size()));
  const format::SolidDetail& d = model.solid_detail;
  for (const auto& members : {d.sphere_around, d.sphere_rows, d.hemisphere_around, d.hemisphere_rows, d.round_sides})
    for (std::uint32_t m = 0; m < format::kFacedMembers; ++m) solids_.u32(members[m]);
  solids_.u32(0);
  for (const Vec3& c : candidates) {
    solids_.f32(c.x);
    solids_.f32(c.y);
    solids_.f32(c.z);
  }
  for (const Solid& solid : model.solids) {
    solids_.u32(static_cast<std::uint32_t>(solid.kind));
    for (const float size : solid.size) solids_.f32(size);
    for (const float m : solid.to_model) solids_.f32(m);
    solids_.u32(solid.colour.bits);
    if (!solid.name.empty()) solid_names_.push_back(solids_.size());
    solids_.u32(solid.name.empty() ? format::kAbsent : names_.size());
    solids_.u32(static_cast<std::uint32_t>(solid.name.size()));
    names_.text(solid.name);
  }
}

void RomSections::add_material(const Material& material) {
  materials_.u32(number_or_absent(material.texture));
  materials_.u32(static_cast<std::uint32_t>(material.filter));
  materials_.u32(static_cast<std::uint32_t>(material.wrap_s));
  materials_.u32(static_cast<std::uint32_t>(material.wrap_t));
  materials_.u32(static_cast<std::uint32_t>(material.alpha_mode));
  materials_.u32(material.alpha_reference);
  materials_.u32(0);
  materials_.u32(0);
}

void RomSections::add_texture(const Picture& picture, const RomOptions& options) {
  const command::TextureFormat texel_format = stored_format(picture, options.texels);
  format::Texture t;
  t.texel_offset = texels_.size();
  t.format = static_cast<std::uint32_t>(texel_format);
  t.width = picture.width;
  t.height = picture.height;
  const std::vector<Picture> levels =
      levels_of(picture, options.mips ? full_level_count(picture.width, picture.height) : 1);
  t.level_count = static_cast<std::uint32_t>(levels.size());
  for (const Picture& level : levels) texels_.raw(texels_of(level, texel_format));
  if (!picture.name.empty()) {
    t.name_offset = names_.size();
    t.name_bytes = static_cast<std::uint32_t>(picture.name.size());
    names_.text(picture.name);
  }
  textures_.push_back(t);
}

Bytes RomSections::descriptor_bytes() const {
  Bytes out;
  for (const format::MeshDescriptor& d : meshes_) {
    out.u32(d.record_offset);
    out.u32(static_cast<std::uint32_t>(d.topology));
    out.u32(d.index_offset);
    out.u32(d.index_count);
    out.u32(d.index_bytes);
    out.u32(d.normal_offset);
    out.u32(d.colour_offset);
    out.u32(d.base_colour);
    out.u32(static_cast<std::uint32_t>(d.quota_kind));
    out.u32(d.quota);
    out.f32(d.area_threshold_px);
    out.u32(static_cast<std::uint32_t>(d.method));
    out.u32(d.flags);
    out.u32(d.name_offset);
    out.u32(d.name_bytes);
    out.u32(d.texture_coordinate_offset);
    out.u32(d.material);
    out.u32(d.method_settings_offset);
    out.u32(d.edge_value_offset);
    out.u32(d.layer_offset);
  }
  return out;
}

Bytes RomSections::texture_bytes(std::uint32_t texels_at, std::uint32_t names_at) const {
  Bytes out;
  for (format::Texture t : textures_) {
    shift(t.texel_offset, texels_at);
    shift(t.name_offset, names_at);
    for (std::uint32_t word :
         {t.texel_offset, t.format, t.width, t.height, t.level_count, t.name_offset, t.name_bytes, t.reserved})
      out.u32(word);
  }
  return out;
}

std::vector<RomSections::Placed> RomSections::place(std::uint32_t first_section, std::uint32_t table_entry) {
  using Type = format::SectionType;
  // Sizes count first: MSHD and TEXT are written again when all offsets are known.
  std::vector<Placed> all;
  const auto add = [&](Type type, Bytes bytes) {
    if (bytes.size() != 0 || type == Type::kNames || type == Type::kMeshes) all.push_back({type, std::move(bytes), 0});
  };
  add(Type::kRecords, std::move(records_));
  add(Type::kMeshes, descriptor_bytes());
  add(Type::kIndices, std::move(indices_));
  add(Type::kNormals, std::move(normals_));
  add(Type::kColours, std::move(colours_));
  add(Type::kTextureCoordinates, std::move(texture_coordinates_));
  add(Type::kMaterials, std::move(materials_));
  add(Type::kGroups, std::move(groups_));
  add(Type::kTextures, texture_bytes(0, 0));
  add(Type::kTexels, std::move(texels_));
  add(Type::kMethods, std::move(methods_));
  add(Type::kEdgeValues, std::move(edge_values_));
  add(Type::kLayers, std::move(layers_));
  add(Type::kSolids, solids_);
  add(Type::kNames, std::move(names_));
  add(Type::kBoard, std::move(board_));

  auto offset = static_cast<std::uint32_t>(first_section + all.size() * table_entry);
  std::map<Type, std::uint32_t> at;
  for (Placed& section : all) {
    at[section.type] = section.offset = offset;
    offset += section.bytes.size();
  }
  for (format::MeshDescriptor& d : meshes_) {
    d.record_offset += at[Type::kRecords];
    d.index_offset += at[Type::kIndices];
    shift(d.normal_offset, at[Type::kNormals]);
    shift(d.colour_offset, at[Type::kColours]);
    shift(d.texture_coordinate_offset, at[Type::kTextureCoordinates]);
    if ((d.flags & format::kFlagGroups) != 0) d.material += at[Type::kGroups];
    shift_or_zero(d.method_settings_offset, at[Type::kMethods]);
    shift_or_zero(d.edge_value_offset, at[Type::kEdgeValues]);
    shift_or_zero(d.layer_offset, at[Type::kLayers]);
    d.name_offset += at[Type::kNames];
  }
  for (Placed& section : all) {
    if (section.type == Type::kMeshes) section.bytes = descriptor_bytes();
    if (section.type == Type::kSolids)
      for (const std::uint32_t entry : solid_names_)
        section.bytes.set_u32(entry, solids_.u32_at(entry) + at[Type::kNames]);
    if (section.type == Type::kTextures) section.bytes = texture_bytes(at[Type::kTexels], at[Type::kNames]);
  }
  return all;
}

}  // namespace usuzumi::sim
