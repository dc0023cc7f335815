#include "firmware/drawing_data/appearance_check.h"

#include <bit>
#include <cmath>

#include "firmware/drawing_data/mesh_view.h"

namespace usuzumi::firmware {
namespace {

using format::kAbsent;

constexpr auto kMaterialBytes = static_cast<std::uint32_t>(sizeof(format::Material));
constexpr auto kTextureBytes = static_cast<std::uint32_t>(sizeof(format::Texture));

Status check_texture(const Words& words, const Sections& sections, std::uint32_t at) {
  const auto t = words.object<format::Texture>(at);
  if (t.format < static_cast<std::uint32_t>(command::TextureFormat::kRgb565) ||
      t.format > static_cast<std::uint32_t>(command::TextureFormat::kArgb8888))
    return unsupported("texture of a format this release does not know, at byte offset", at);
  if (t.width < 1 || t.width > format::kMaxTextureSize || t.height < 1 || t.height > format::kMaxTextureSize)
    return damaged("width or height of a texture is not 1 to 4096, at byte offset", at);
  const std::uint32_t larger = t.width > t.height ? t.width : t.height;
  if (t.level_count < 1 || t.level_count > static_cast<std::uint32_t>(std::bit_width(larger)))
    return damaged("texture has no level or more than down to 1 x 1 texels, at byte offset", at);
  const auto texel_format = static_cast<command::TextureFormat>(t.format);
  if (!sections.texels.holds(t.texel_offset, texture_bytes(texel_format, t.width, t.height, t.level_count)))
    return damaged("texels lie outside section TEXL or are not aligned to 4 bytes, of the texture at byte offset", at);
  if (!sections.names.holds_text(t.name_offset, t.name_bytes))
    return damaged("name lies outside section NAME, of the texture at byte offset", at);
  if (t.reserved != 0) return unsupported("texture has settings of a later release, at byte offset", at);
  return ok_status();
}

Status check_material(const Words& words, std::uint32_t texture_count, std::uint32_t at) {
  const auto m = words.object<format::Material>(at);
  if (m.texture != kAbsent && m.texture >= texture_count)
    return damaged("material has a texture that is not there, at byte offset", at);
  if (m.filter > static_cast<std::uint32_t>(command::TextureFilter::kBilinear) ||
      m.wrap_s > static_cast<std::uint32_t>(command::TextureWrap::kMirror) ||
      m.wrap_t > static_cast<std::uint32_t>(command::TextureWrap::kMirror))
    return unsupported("material has a filter or wrapping that this release does not know, at byte offset", at);
  if (m.alpha_mode > format::AlphaMode::kBlend)
    return unsupported("material has an alpha mode that this release does not know, at byte offset", at);
  if (m.alpha_reference > 255) return damaged("material's alpha reference is not 0 to 255, at byte offset", at);
  if (m.reserved[0] != 0 || m.reserved[1] != 0)
    return unsupported("material has settings of a later release, at byte offset", at);
  return ok_status();
}

static_assert(static_cast<std::uint32_t>(Method::kEdgeRemoval) ==
                  static_cast<std::uint32_t>(format::Method::kEdgeRemoval) &&
              static_cast<std::uint32_t>(Method::kHalfEdge) == static_cast<std::uint32_t>(format::Method::kHalfEdge) &&
              static_cast<std::uint32_t>(Method::kVertexDeletion) ==
                  static_cast<std::uint32_t>(format::Method::kVertexDeletion));

bool weight(float value) { return std::isfinite(value) && value >= 0; }

Status check_edge_removal(const EdgeRemovalSettings& s, std::uint32_t at) {
  for (const float value : {s.a, s.b, s.neighbour_weight, s.computed_weight, s.user_weight, s.boundary_limit})
    if (!weight(value)) return damaged("setting of edge removal is negative or no finite number, at byte offset", at);
  if (s.placement > EdgePlacement::kMidpoint || s.boundary_answer > BoundaryAnswer::kLimitMovement)
    return unsupported("edge removal has a placement or boundary answer of a later release, at byte offset", at);
  if (s.reserved[0] != 0 || s.reserved[1] != 0)
    return unsupported("edge removal has settings of a later release, at byte offset", at);
  return ok_status();
}

Status check_vertex_deletion(const VertexDeletionSettings& s, std::uint32_t at) {
  for (const float value : {s.area, s.move, s.normal, s.largest, s.boundary_area, s.limit_area, s.limit_move,
                            s.limit_normal, s.limit_largest, s.protrusion_penalty})
    if (!weight(value))
      return damaged("setting of vertex deletion is negative or no finite number, at byte offset", at);
  return ok_status();
}

Status check_settings(const Words& words, const Sections& sections, const format::MeshDescriptor& d,
                      std::uint32_t at) {
  const std::uint32_t settings = d.method_settings_offset;
  if (settings == 0) return ok_status();
  if (d.method != format::Method::kEdgeRemoval && d.method != format::Method::kVertexDeletion)
    return damaged("mesh has settings for a method that has none, in the mesh descriptor at byte offset", at);
  if (!sections.methods.holds(settings, sizeof(EdgeRemovalSettings)))
    return damaged("settings lie outside section METH, in the mesh descriptor at byte offset", at);
  return d.method == format::Method::kEdgeRemoval
             ? check_edge_removal(words.object<EdgeRemovalSettings>(settings), settings)
             : check_vertex_deletion(words.object<VertexDeletionSettings>(settings), settings);
}

/// That material number `material` of the mesh is there, and that a texture finds coordinates.
Status check_mesh_material(const Words& words, const Sections& sections, const format::MeshDescriptor& d,
                           std::uint32_t material, std::uint32_t at) {
  if (material == kAbsent) return ok_status();
  if (material >= sections.materials.bytes() / kMaterialBytes)
    return damaged("mesh has a material that is not there, in the mesh descriptor at byte offset", at);
  const auto m = words.object<format::Material>(sections.materials.begin + material * kMaterialBytes);
  if (m.texture != kAbsent && d.texture_coordinate_offset == kAbsent)
    return damaged(
        "mesh has a texture but no texture coordinates: unwrap it or take the texture away, in the mesh descriptor at "
        "byte offset",
        at);
  return ok_status();
}

std::uint32_t index_at(const Words& words, const format::MeshDescriptor& d, std::uint32_t i) {
  const std::uint32_t word = words.at(d.index_offset + (i * d.index_bytes & ~3u));
  return d.index_bytes == 4 ? word : (word >> (i % 2 * 16) & 0xFFFFu);
}

/// One group, which begins where the one before it ends.
Status check_group(const Words& words, const format::MeshDescriptor& d, const format::FaceGroup& before,
                   const format::FaceGroup& group, std::uint32_t vertices, std::uint32_t group_at) {
  if (group.face_end < before.face_end || group.face_end > d.index_count / 3 || group.vertex_end < before.vertex_end ||
      group.vertex_end > vertices)
    return damaged("groups of faces or vertices overlap or leave their mesh, group at byte offset", group_at);
  for (std::uint32_t i = 3 * before.face_end; i < 3 * group.face_end; ++i) {
    const std::uint32_t v = index_at(words, d, i);
    if (v < before.vertex_end || v >= group.vertex_end)
      return damaged("face has a vertex of another group, group at byte offset", group_at);
  }
  return ok_status();
}

/// The indices have been checked against the mesh's vertices.
Status check_groups(const Words& words, const Sections& sections, const format::MeshDescriptor& d,
                    std::uint32_t vertices, std::uint32_t at) {
  constexpr auto kGroupBytes = static_cast<std::uint32_t>(sizeof(format::FaceGroup));
  if (d.topology != format::Topology::kIndexed)
    return damaged("mesh has groups but no indices, in the mesh descriptor at byte offset", at);
  if (!sections.groups.holds(d.material, 4) ||
      !sections.groups.holds(d.material + 4, std::uint64_t{words.at(d.material)} * kGroupBytes))
    return damaged("groups lie outside section GRUP, in the mesh descriptor at byte offset", at);
  format::FaceGroup before{0, 0, kAbsent, 0};
  const std::uint32_t end = d.material + 4 + words.at(d.material) * kGroupBytes;
  for (std::uint32_t group_at = d.material + 4; group_at < end; group_at += kGroupBytes) {
    const auto group = words.object<format::FaceGroup>(group_at);
    Status status = check_group(words, d, before, group, vertices, group_at);
    if (status.ok()) status = check_mesh_material(words, sections, d, group.material, at);
    if (!status.ok()) return status;
    before = group;
  }
  if (before.face_end != d.index_count / 3 || before.vertex_end != vertices)
    return damaged("groups do not cover all faces and vertices, in the mesh descriptor at byte offset", at);
  return ok_status();
}

}  // namespace

Status check_textures(const Words& words, const Sections& sections) {
  if (sections.textures.bytes() % kTextureBytes != 0)
    return damaged("section TEXT is no whole number of textures, at byte offset", sections.textures.begin);
  for (std::uint32_t at = sections.textures.begin; at < sections.textures.end; at += kTextureBytes) {
    const Status status = check_texture(words, sections, at);
    if (!status.ok()) return status;
  }
  return ok_status();
}

Status check_materials(const Words& words, const Sections& sections) {
  if (sections.materials.bytes() % kMaterialBytes != 0)
    return damaged("section MATL is no whole number of materials, at byte offset", sections.materials.begin);
  const std::uint32_t texture_count = sections.textures.bytes() / kTextureBytes;
  for (std::uint32_t at = sections.materials.begin; at < sections.materials.end; at += kMaterialBytes) {
    const Status status = check_material(words, texture_count, at);
    if (!status.ok()) return status;
  }
  return ok_status();
}

Status check_appearance(const Words& words, const Sections& sections, const format::MeshDescriptor& d,
                        std::uint32_t vertices, std::uint32_t at) {
  const Status status = (d.flags & format::kFlagGroups) != 0 ? check_groups(words, sections, d, vertices, at)
                                                             : check_mesh_material(words, sections, d, d.material, at);
  const std::uint32_t coordinates = d.texture_coordinate_offset;
  if (!status.ok() || coordinates == kAbsent) return status;
  if (!sections.texture_coordinates.holds(coordinates, std::uint64_t{vertices} * sizeof(TexCoord)))
    return damaged("texture coordinates lie outside section TXCO, in the mesh descriptor at byte offset", at);
  // Magnitudes as integers: they order as the numbers do, infinity and NaN above all.
  constexpr auto kMaxMagnitude = std::bit_cast<std::uint32_t>(kMaxTextureCoordinate);
  for (std::uint32_t i = 0; i < 2 * vertices; ++i)
    if ((words.at(coordinates + 4 * i) & 0x7FFFFFFFu) > kMaxMagnitude)
      return damaged("texture coordinate is beyond 10000 or -10000 or no number, at byte offset", coordinates + 4 * i);
  return ok_status();
}

Status check_method(const Words& words, const Sections& sections, const format::MeshDescriptor& d,
                    std::uint32_t vertices, std::uint32_t at) {
  if (d.method > format::Method::kVertexDeletion)
    return unsupported("thinning method of a later release, in the mesh descriptor at byte offset", at);
  const Status status = check_settings(words, sections, d, at);
  if (!status.ok() || d.edge_value_offset == 0) return status;
  const std::uint32_t first = d.edge_value_offset;
  if (!sections.edge_values.holds(first, std::uint64_t{vertices} * 4))
    return damaged("edge values lie outside section EDGV, in the mesh descriptor at byte offset", at);
  for (std::uint32_t i = 0; i < vertices; ++i) {
    const float value = words.object<float>(first + 4 * i);
    if (!weight(value) && value != kLockedEdgeValue)
      return damaged("edge value is neither -1 (locked) nor a finite number from 0 up, at byte offset", first + 4 * i);
  }
  return ok_status();
}

}  // namespace usuzumi::firmware
