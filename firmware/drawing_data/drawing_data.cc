#include "firmware/drawing_data/drawing_data.h"

#include <bit>
#include <cstddef>
#include <cstring>

#include "hal/crc32.h"

namespace usuzumi::firmware {
namespace {

using format::kAbsent;

/// Words of the ROM by byte offset; callers have checked the bounds.
class Words {
 public:
  explicit Words(std::span<const std::byte> rom) : rom_(rom) {}
  std::uint32_t at(std::uint32_t offset) const {
    std::uint32_t v;
    std::memcpy(&v, rom_.data() + offset, 4);
    return v;
  }
  template <class T>
  T object(std::uint32_t offset) const {
    T v;
    std::memcpy(&v, rom_.data() + offset, sizeof v);
    return v;
  }
  template <class T>
  std::span<const T> array(std::uint32_t offset, std::uint32_t count) const {
    return {reinterpret_cast<const T*>(rom_.data() + offset), count};  // 4-byte aligned by the format and by open()
  }

 private:
  std::span<const std::byte> rom_;
};

constexpr std::uint32_t kRecordHeadBytes = 8;   // vertex count, level
constexpr std::uint32_t kVertexBytes = 12;
constexpr std::uint32_t kCrcStart = 24;         // the first byte under the CRC: section_count

Status damaged(const char* message, std::uint32_t offset) { return {StatusCode::kDataLoss, message, offset}; }
Status unsupported(const char* message, std::uint32_t offset) { return {StatusCode::kUnsupported, message, offset}; }

std::uint32_t record_bytes(std::uint32_t vertex_count) { return kRecordHeadBytes + vertex_count * kVertexBytes; }

/// Checks the record at `offset`, which must end at or before `end`.
Status check_record(const Words& words, std::uint32_t offset, std::uint32_t end) {
  if (end - offset < kRecordHeadBytes) return damaged("mesh record is cut off: byte offset follows", offset);
  const std::uint32_t vertices = words.at(offset);
  if (vertices == 0) return damaged("mesh has no vertices, at byte offset", offset);
  if (vertices > (end - offset - kRecordHeadBytes) / kVertexBytes)
    return damaged("mesh has more vertices than the data has bytes for, at byte offset", offset);
  if (words.at(offset + 4) >= kLevelCount) return damaged("thinning level is not 0 to 5, at byte offset", offset + 4);
  // Magnitudes as integers: they order as the numbers do, infinity and NaN above all.
  constexpr auto kMaxMagnitude = std::bit_cast<std::uint32_t>(format::kMaxCoordinate);
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

/// Walks the records of the bare layout in [begin, end): mesh-max and as many records, nothing left over.
Status check_records(const Words& words, std::uint32_t begin, std::uint32_t end) {
  if (end - begin < 4) return damaged("no room for mesh-max at byte offset", begin);
  const std::uint32_t mesh_max = words.at(begin);
  if (mesh_max == 0) return damaged("mesh-max is 0: there is nothing to draw, at byte offset", begin);
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

struct Range {
  std::uint32_t begin = 0, end = 0;  // byte offsets; empty where the section is absent
  /// Whether `bytes` at `offset` (a multiple of 4) lie inside.
  bool holds(std::uint32_t offset, std::uint64_t bytes) const {
    return offset % 4 == 0 && offset >= begin && offset <= end && bytes <= end - offset;
  }
};

/// The container's section table, resolved.
struct Sections {
  Range records, meshes, indices, normals, colours, names, board;

  Range* of(format::SectionType type) {
    switch (type) {
      case format::SectionType::kRecords: return &records;
      case format::SectionType::kMeshes: return &meshes;
      case format::SectionType::kIndices: return &indices;
      case format::SectionType::kNormals: return &normals;
      case format::SectionType::kColours: return &colours;
      case format::SectionType::kNames: return &names;
      case format::SectionType::kBoard: return &board;
      default: break;
    }
    return nullptr;
  }
};

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
    Range* range = sections.of(section.type);
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
  if (d.name_offset == kAbsent ? d.name_bytes != 0
                               : (d.name_offset < sections.names.begin || d.name_offset > sections.names.end ||
                                  d.name_bytes > sections.names.end - d.name_offset))
    return damaged("name lies outside section NAME, in the mesh descriptor at byte offset", at);
  if (d.quota_kind > format::QuotaKind::kMillionths ||
      (d.quota_kind == format::QuotaKind::kMillionths && d.quota > 1'000'000))
    return damaged("face quota is of unknown kind or above 100 %, in the mesh descriptor at byte offset", at);
  if (!std::isfinite(d.area_threshold_px))
    return damaged("area threshold is not a finite number, in the mesh descriptor at byte offset", at);
  if (d.method > format::Method::kQem)
    return unsupported("thinning method of a later release, in the mesh descriptor at byte offset", at);
  if ((d.flags & ~(format::kFlagTelltale | format::kFlagTwoSided)) != 0)
    return unsupported("mesh flags of a later release, in the mesh descriptor at byte offset", at);
  if (d.texture_coordinate_offset != kAbsent || d.material != kAbsent)
    return unsupported("textures need a later release, in the mesh descriptor at byte offset", at);
  if (d.method_settings_offset != 0 || d.edge_value_offset != 0 || d.layer_offset != 0)
    return unsupported("method settings and layers need a later release, in the mesh descriptor at byte offset", at);
  return ok_status();
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
    Status status = check_records(words, 0, size);
    if (!status.ok()) return status;
    data.mesh_max_ = words.at(0);
    return data;
  }

  Status status = check_header(words, rom.size());
  if (!status.ok()) return status;
  if (crc32(kCrc32Start, rom.subspan(kCrcStart)) != words.object<format::Header>(0).crc32)
    return damaged("CRC-32 does not match: the file is corrupt, checksum at byte offset", 20);
  Sections sections;
  status = read_sections(words, size, sections);
  if (status.ok()) status = check_records(words, sections.records.begin, sections.records.end);
  if (status.ok()) status = check_meshes(words, sections);
  if (!status.ok()) return status;
  data.bare_ = false;
  data.board_ = board_name(rom, sections.board);
  data.mesh_max_ = words.at(sections.records.begin);
  data.first_record_ = sections.records.begin + 4;
  data.descriptors_offset_ = sections.meshes.begin;
  return data;
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
  if (d.name_offset != kAbsent) view.name = {reinterpret_cast<const char*>(rom_.data()) + d.name_offset, d.name_bytes};
  return view;
}

std::uint32_t MeshView::face_count() const {
  const auto vertices = static_cast<std::uint32_t>(positions.size());
  switch (topology) {
    case format::Topology::kStrip:
    case format::Topology::kFan: return vertices < 3 ? 0 : vertices - 2;
    case format::Topology::kList: return vertices / 3;
    case format::Topology::kIndexed: return index_count / 3;
  }
  return 0;
}

void MeshView::face(std::uint32_t f, std::uint32_t out[3]) const {
  switch (topology) {
    case format::Topology::kStrip:
      out[0] = f + (f & 1);
      out[1] = f + 1 - (f & 1);
      out[2] = f + 2;
      return;
    case format::Topology::kFan:
      out[0] = 0;
      out[1] = f + 1;
      out[2] = f + 2;
      return;
    case format::Topology::kList:
      for (std::uint32_t k = 0; k < 3; ++k) out[k] = 3 * f + k;
      return;
    case format::Topology::kIndexed:
      for (std::uint32_t k = 0; k < 3; ++k) {
        std::uint32_t index = 0;
        std::memcpy(&index, indices.data() + (3 * std::size_t{f} + k) * index_bytes, index_bytes);
        out[k] = index;
      }
      return;
  }
}

bool MeshView::proper_face(std::uint32_t f, std::uint32_t out[3]) const {
  face(f, out);
  const Vec3 &a = positions[out[0]], &b = positions[out[1]], &c = positions[out[2]];
  return a != b && b != c && c != a;
}

std::uint32_t MeshView::proper_face_count() const {
  std::uint32_t count = 0, corners[3];
  for (std::uint32_t f = 0; f < face_count(); ++f)
    if (proper_face(f, corners)) ++count;
  return count;
}

}  // namespace usuzumi::firmware
