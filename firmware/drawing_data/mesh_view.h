// A mesh, its material and its texture as they lie in ROM. Everything here has been checked by DrawingData::open().
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/drawing_data/format.h"
#include "firmware/simplify/simplify.h"
#include "hal/command_list.h"
#include "hal/vec.h"

namespace usuzumi::firmware {

/// Bytes of an image of `level_count` levels, laid out as command::SetTexture says: rows padded to 4 bytes, levels
/// without gaps. Sizes up to format::kMaxTextureSize.
constexpr std::uint64_t texture_bytes(command::TextureFormat format, std::uint32_t width, std::uint32_t height,
                                      std::uint32_t level_count) {
  std::uint64_t bytes = 0;
  for (std::uint32_t level = 0; level < level_count; ++level) {
    const std::uint32_t columns = width >> level > 1 ? width >> level : 1;
    const std::uint32_t rows = height >> level > 1 ? height >> level : 1;
    bytes += std::uint64_t{rows} * ((columns * command::bytes_per_texel(format) + 3) / 4 * 4);
  }
  return bytes;
}

struct TextureView {
  std::uint32_t number = format::kAbsent;  // in the drawing data, from 0
  command::TextureFormat format = command::TextureFormat::kNone;
  std::uint32_t width = 0, height = 0;     // texels, of level 0
  std::uint32_t level_count = 0;
  std::span<const std::byte> texels;       // all levels; begins at a multiple of 4 in memory
  std::string_view name;                   // empty where it has none

  bool present() const { return format != command::TextureFormat::kNone; }
};

/// The default is what a mesh without a material is drawn with.
struct MaterialView {
  std::uint32_t number = format::kAbsent;  // in the drawing data, from 0
  TextureView texture;
  command::TextureFilter filter = command::TextureFilter::kBilinear;
  command::TextureWrap wrap_s = command::TextureWrap::kRepeat, wrap_t = command::TextureWrap::kRepeat;
  format::AlphaMode alpha_mode = format::AlphaMode::kOpaque;
  std::uint32_t alpha_reference = 128;     // 0..255, of AlphaMode::kMask
};

/// Thinning level as stored; unset is treated as keep ([0022]).
enum class Level : std::uint32_t { kUnset = 0, kKeep = 1, kDelete = 2, kCollapse = 3, kPoint = 4, kLine = 5 };
inline constexpr std::uint32_t kLevelCount = 6;

/// One mesh as it lies in ROM. Spans point into the ROM; every index was checked.
struct MeshView {
  std::uint32_t number = 0;  // from 0; the patent counts from 1
  Level level = Level::kUnset;
  format::Topology topology = format::Topology::kStrip;
  std::span<const Vec3> positions;
  std::span<const PackedNormal> normals;   // empty or as many as positions
  std::span<const Rgba8> colours;          // empty or as many as positions
  std::span<const std::byte> indices;      // kIndexed: index_count * index_bytes
  std::uint32_t index_bytes = 0;
  std::uint32_t index_count = 0;
  Rgba8 base_colour{};
  format::QuotaKind quota_kind = format::QuotaKind::kNone;
  std::uint32_t quota = 0;
  float area_threshold_px = -1;
  std::uint32_t flags = 0;
  std::string_view name;                   // empty in bare data
  std::span<const TexCoord> texture_coordinates;  // empty or as many as positions
  bool textured = false;                   // a material has a texture: there are texture coordinates
  std::span<const float> edge_values;      // the same; each >= 0 or kLockedEdgeValue
  MaterialView material;                   // of a mesh without groups
  std::span<const format::FaceGroup> groups;  // the materials of a mesh that has several; empty: `material`
  Method method = Method::kQem;            // of level 3
  const std::byte* method_settings = nullptr;  // 40 checked bytes in ROM, where the author has given any
  std::span<const std::byte> layers;       // its chain (firmware/layers/layer_chain.h), of_checked(); empty: none

  /// The author's, where `method` is theirs; the defaults otherwise.
  EdgeRemovalSettings edge_removal() const;
  VertexDeletionSettings vertex_deletion() const;

  bool telltale() const { return (flags & format::kFlagTelltale) != 0; }
  /// At least 1: a mesh without groups is one itself.
  std::uint32_t group_count() const { return groups.empty() ? 1 : static_cast<std::uint32_t>(groups.size()); }
  /// g < group_count(). Its material's number may be kAbsent. Where a group's material has a texture,
  /// texture_coordinates are there.
  format::FaceGroup group(std::uint32_t g) const;
  bool two_sided() const { return (flags & format::kFlagTwoSided) != 0; }
  /// Faces as the topology counts them, the joins between the runs of a strip included.
  std::uint32_t face_count() const;
  /// Vertex numbers of face f < face_count(), wound as drawn: odd faces of a strip have their first two swapped.
  void face(std::uint32_t f, std::uint32_t out[3]) const;
  /// The same; false where two corners stand at one place. A join repeats a place, not a vertex number, in data without
  /// indices; such a face draws nothing, and whoever thins or counts faces leaves it out.
  bool proper_face(std::uint32_t f, std::uint32_t out[3]) const;
  /// Faces with their corners at three places. Looks at every face.
  std::uint32_t proper_face_count() const;
  /// The proper faces as a triangle list, which `indices` have just room for, and where each group's end among them;
  /// `material_groups` are as many as groups, or none.
  void write_proper_faces(std::span<std::uint32_t> indices, std::span<MaterialGroup> material_groups = {}) const;
};

}  // namespace usuzumi::firmware
