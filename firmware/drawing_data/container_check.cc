#include "firmware/drawing_data/container_check.h"

#include <bit>
#include <cmath>

#include "firmware/drawing_data/appearance_check.h"
#include "firmware/drawing_data/drawing_data.h"
#include "firmware/drawing_data/solids_check.h"
#include "firmware/layers/layer_format.h"
#include "hal/crc32.h"

namespace usuzumi::firmware {
namespace {

using format::kAbsent;

constexpr std::uint32_t kCrcStart = 24;  // the first byte under the CRC: section_count

/// Checks the record at `offset`, which must end at or before `end`.
Status check_record(const Words& words, std::uint32_t offset, std::uint32_t end) {
  if (end - offset < kRecordHeadBytes) return damaged("mesh record is cut off: byte offset follows", offset);
  const std::uint32_t vertices = words.at(offset);
  if (vertices == 0) return damaged("mesh has no vertices, at byte offset", offset);
  if (vertices > (end - offset - kRecordHeadBytes) / kVertexBytes)
    return damaged("mesh has more vertices than the data has bytes for, at byte offset", offset);
  if (words.at(offset + 4) >= kLevelCount) return damaged("thinning level is not 0 to 5, at byte offset", offset + 4);
  // Magnitudes as integers: they order as the numbers do, infinity and NaN above all.
  constexpr auto kMaxMagnitude = std::bit_cast<std::uint32_t>(kMaxCoordinate);
  const std::uint32_t first = offset + kRecordHeadBytes;
  for (std::uint32_t at = first; at < first + kVertexBytes * vertices; at += 4) {
    const std::uint32_t magnitude = words.at(at) & 0x7FFFFFFFu;
    if (magnitude <= kMaxMagnitude) continue;
    return damaged(magnitude < 0x7F800000u ? "coordinate is beyond 1e8 or -1e8, at byte offset"
                                           : "coordinate is not a finite number, at byte offset",
                   at);
  }
  return ok_status();
}

Range* range_of(Sections& sections, format::SectionType type) {
  switch (type) {
    case format::SectionType::kRecords: return &sections.records;
    case format::SectionType::kMeshes: return &sections.meshes;
    case format::SectionType::kIndices: return &sections.indices;
    case format::SectionType::kNormals: return &sections.normals;
    case format::SectionType::kColours: return &sections.colours;
    case format::SectionType::kNames: return &sections.names;
    case format::SectionType::kBoard: return &sections.board;
    case format::SectionType::kTextureCoordinates: return &sections.texture_coordinates;
    case format::SectionType::kMaterials: return &sections.materials;
    case format::SectionType::kTextures: return &sections.textures;
    case format::SectionType::kTexels: return &sections.texels;
    case format::SectionType::kMethods: return &sections.methods;
    case format::SectionType::kEdgeValues: return &sections.edge_values;
    case format::SectionType::kLayers: return &sections.layers;
    case format::SectionType::kGroups: return &sections.groups;
    case format::SectionType::kSolids: return &sections.solids;
  }
  return nullptr;
}

Status check_header(const Words& words, std::size_t rom_bytes) {
  if (rom_bytes < sizeof(format::Header))
    return damaged("file ends inside the header; bytes present", static_cast<std::uint32_t>(rom_bytes));
  const auto header = words.object<format::Header>(0);
  if (header.byte_order != format::kByteOrderMark)
    return damaged("byte-order mark is wrong: pack for a little-endian device, at byte offset", 4);
  if (header.version_major != format::kVersionMajor)
    return unsupported("container is of another major version: pack it again with this release, at byte offset", 8);
  if (header.flags != 0) return unsupported("container has flags this release does not know, at byte offset", 12);
  if (header.file_bytes > rom_bytes)
    return damaged("file is truncated: its header promises more, at byte offset",
                   static_cast<std::uint32_t>(rom_bytes));
  if (header.file_bytes < rom_bytes)
    return damaged("file is too long: it should end at byte offset", header.file_bytes);
  if (header.file_bytes % 4 != 0) return damaged("file size is not a multiple of 4, at byte offset", 16);
  return ok_status();
}

Status read_sections(const Words& words, std::uint32_t file_bytes, Sections& sections) {
  const auto count = words.object<format::Header>(0).section_count;
  constexpr std::uint32_t kTable = sizeof(format::Header);
  if (count > (file_bytes - kTable) / sizeof(format::Section))
    return damaged("section table runs past the end of the file, at byte offset", kCrcStart);
  const std::uint32_t table_end = kTable + count * static_cast<std::uint32_t>(sizeof(format::Section));
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t at = kTable + i * static_cast<std::uint32_t>(sizeof(format::Section));
    const auto section = words.object<format::Section>(at);
    Range* range = range_of(sections, section.type);
    if (range == nullptr) return unsupported("section of a kind this release does not know, at byte offset", at);
    if (range->end != 0) return damaged("section appears twice, at byte offset", at);
    if (section.offset % 4 != 0 || section.bytes % 4 != 0 || section.offset < table_end ||
        section.offset > file_bytes || section.bytes > file_bytes - section.offset)
      return damaged("section lies outside the file or is not aligned to 4 bytes, at byte offset", at);
    *range = {section.offset, section.offset + section.bytes};
  }
  if (sections.records.end == 0) return damaged("section RECD is missing, at byte offset", kTable);
  if (sections.meshes.end == 0) return damaged("section MSHD is missing, at byte offset", kTable);
  return ok_status();
}

/// Checks that every index of a kIndexed mesh is below its vertex count.
template <class Index>
Status check_indices(const Words& words, const format::MeshDescriptor& d, std::uint32_t vertices) {
  const auto indices = words.array<Index>(d.index_offset, d.index_count);
  for (std::uint32_t i = 0; i < d.index_count; ++i)
    if (indices[i] >= vertices)
      return damaged("index refers to a vertex that the mesh does not have, at byte offset",
                     d.index_offset + i * static_cast<std::uint32_t>(sizeof(Index)));
  return ok_status();
}

Status check_topology(const Words& words, const Sections& sections, const format::MeshDescriptor& d,
                      std::uint32_t vertices, std::uint32_t at) {
  if (d.topology > format::Topology::kIndexed)
    return damaged("unknown topology, in the mesh descriptor at byte offset", at);
  if (d.topology == format::Topology::kIndexed) {
    if ((d.index_bytes != 2 && d.index_bytes != 4) || d.index_count % 3 != 0 ||
        !sections.indices.holds(d.index_offset, std::uint64_t{d.index_count} * d.index_bytes))
      return damaged(
          "indices are not 2 or 4 bytes, not three a face, or outside section INDX, in the mesh descriptor at byte "
          "offset",
          at);
    return d.index_bytes == 2 ? check_indices<std::uint16_t>(words, d, vertices)
                              : check_indices<std::uint32_t>(words, d, vertices);
  }
  if (d.index_offset != kAbsent || d.index_count != 0)
    return damaged("mesh has indices though its topology takes none, in the mesh descriptor at byte offset", at);
  if (d.topology == format::Topology::kList && vertices % 3 != 0)
    return damaged("triangle list whose vertex count is no multiple of 3, in the mesh descriptor at byte offset", at);
  return ok_status();
}

Status check_descriptor(const Words& words, const Sections& sections, std::uint32_t at, std::uint32_t record_offset) {
  const auto d = words.object<format::MeshDescriptor>(at);
  if (d.record_offset != record_offset)
    return damaged("mesh descriptor and record do not belong together, descriptor at byte offset", at);
  const std::uint32_t vertices = words.at(record_offset);
  Status status = check_topology(words, sections, d, vertices, at);
  if (!status.ok()) return status;
  if (d.normal_offset != kAbsent && !sections.normals.holds(d.normal_offset, std::uint64_t{vertices} * 4))
    return damaged("normals lie outside section NRML, in the mesh descriptor at byte offset", at);
  if (d.colour_offset != kAbsent && !sections.colours.holds(d.colour_offset, std::uint64_t{vertices} * 4))
    return damaged("colours lie outside section COLR, in the mesh descriptor at byte offset", at);
  if (!sections.names.holds_text(d.name_offset, d.name_bytes))
    return damaged("name lies outside section NAME, in the mesh descriptor at byte offset", at);
  if (d.quota_kind > format::QuotaKind::kMillionths ||
      (d.quota_kind == format::QuotaKind::kMillionths && d.quota > 1'000'000))
    return damaged("face quota is of unknown kind or above 100 %, in the mesh descriptor at byte offset", at);
  if (!std::isfinite(d.area_threshold_px))
    return damaged("area threshold is not a finite number, in the mesh descriptor at byte offset", at);
  if ((d.flags & ~(format::kFlagTelltale | format::kFlagTwoSided | format::kFlagGroups)) != 0)
    return unsupported("mesh flags of a later release, in the mesh descriptor at byte offset", at);
  if (d.layer_offset != 0 && !sections.layers.holds(d.layer_offset, sizeof(format::LayerChainHeader)))
    return damaged("layers lie outside section LAYR, in the mesh descriptor at byte offset", at);
  status = check_method(words, sections, d, vertices, at);
  return status.ok() ? check_appearance(words, sections, d, vertices, at) : status;
}

Status check_meshes(const Words& words, const Sections& sections) {
  constexpr auto kSize = static_cast<std::uint32_t>(sizeof(format::MeshDescriptor));
  const std::uint32_t mesh_max = words.at(sections.records.begin);
  if (std::uint64_t{mesh_max} * kSize != sections.meshes.end - sections.meshes.begin)
    return damaged("section MSHD does not have one descriptor per mesh, at byte offset", sections.meshes.begin);
  std::uint32_t record = sections.records.begin + 4;
  for (std::uint32_t n = 0; n < mesh_max; ++n) {
    Status status = check_descriptor(words, sections, sections.meshes.begin + n * kSize, record);
    if (!status.ok()) return status;
    record += record_bytes(words.at(record));
  }
  return ok_status();
}

}  // namespace

Status check_records(const Words& words, std::uint32_t begin, std::uint32_t end, bool may_be_none) {
  if (end - begin < 4) return damaged("no room for mesh-max at byte offset", begin);
  const std::uint32_t mesh_max = words.at(begin);
  if (mesh_max == 0 && !may_be_none) return damaged("mesh-max is 0: there is nothing to draw, at byte offset", begin);
  if (mesh_max > format::kMaxMeshes)
    return damaged("mesh-max is above 65535 (or this is no drawing data), at byte offset", begin);
  std::uint32_t offset = begin + 4;
  for (std::uint32_t n = 0; n < mesh_max; ++n) {
    Status status = check_record(words, offset, end);
    if (!status.ok()) return status;
    offset += record_bytes(words.at(offset));
  }
  return offset == end ? ok_status() : damaged("bytes are left over after the last mesh, at byte offset", offset);
}

Status check_container(std::span<const std::byte> rom, Sections& sections) {
  const Words words(rom);
  Status status = check_header(words, rom.size());
  if (!status.ok()) return status;
  if (crc32(kCrc32Start, rom.subspan(kCrcStart)) != words.object<format::Header>(0).crc32)
    return damaged("CRC-32 does not match: the file is corrupt, checksum at byte offset", 20);
  status = read_sections(words, static_cast<std::uint32_t>(rom.size()), sections);
  if (status.ok())
    status = check_records(words, sections.records.begin, sections.records.end, sections.solids.bytes() > 0);
  if (status.ok()) status = check_textures(words, sections);
  if (status.ok()) status = check_materials(words, sections);
  if (status.ok()) status = check_meshes(words, sections);
  if (status.ok()) status = check_solids(words, sections);
  return status;
}

}  // namespace usuzumi::firmware
