#include "sim/pack/rom_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <string>

#include "hal/crc32.h"
#include "sim/common/error.h"
#include "sim/pack/strip.h"

namespace usuzumi::sim {
namespace {

namespace format = firmware::format;

/// Little-endian words in rising order, whatever the host's order is.
class Bytes {
 public:
  std::uint32_t size() const { return static_cast<std::uint32_t>(bytes_.size()); }
  void u16(std::uint32_t v) {
    bytes_.push_back(static_cast<std::byte>(v & 0xFF));
    bytes_.push_back(static_cast<std::byte>(v >> 8 & 0xFF));
  }
  void u32(std::uint32_t v) {
    u16(v & 0xFFFF);
    u16(v >> 16);
  }
  void f32(float v) { u32(std::bit_cast<std::uint32_t>(v)); }
  void text(const std::string& s) {
    for (char c : s) bytes_.push_back(static_cast<std::byte>(c));
  }
  void pad_to_word() { bytes_.resize((bytes_.size() + 3) / 4 * 4); }
  void append(const Bytes& other) { bytes_.insert(bytes_.end(), other.bytes_.begin(), other.bytes_.end()); }
  void set_u32(std::uint32_t offset, std::uint32_t v) {
    for (unsigned i = 0; i < 4; ++i) bytes_[offset + i] = static_cast<std::byte>(v >> (8 * i) & 0xFF);
  }
  std::span<const std::byte> from(std::uint32_t offset) const { return std::span(bytes_).subspan(offset); }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

void check_mesh_count(const Model& model) {
  if (model.meshes.empty()) throw Error(ExitCode::kBadInput, "nothing to pack: the input has no triangles");
  if (model.meshes.size() > format::kMaxMeshes)
    throw Error(ExitCode::kBadInput,
                fmt::format("{} meshes, but drawing data hold at most {}; join some in the modelling tool",
                            model.meshes.size(), format::kMaxMeshes));
}

/// Before anything is written: an upper bound of the file, so that no 32-bit offset can wrap.
void check_size(const Model& model) {
  std::uint64_t bytes = 0;
  for (const Mesh& mesh : model.meshes)
    bytes +=
        256 + mesh.name.size() + 20 * std::uint64_t{mesh.positions.size()} + 4 * std::uint64_t{mesh.indices.size()};
  if (bytes > format::kMaxFileBytes)
    throw Error(
        ExitCode::kBadInput,
        fmt::format("about {} MiB of drawing data, but the format ends at 1024 MiB; pack fewer or coarser models",
                    bytes >> 20));
}

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

/// Vertex colours that are all alike are a base colour.
bool uniform(std::span<const Rgba8> colours) {
  return std::all_of(colours.begin(), colours.end(), [&](Rgba8 c) { return c == colours.front(); });
}

/// The container's sections while they grow; descriptors hold offsets within their section until `place` is called.
struct Parts {
  Bytes records, indices, normals, colours, names;
  std::vector<format::MeshDescriptor> meshes;

  void add(const Mesh& mesh);
  void place(std::uint32_t records_at, std::uint32_t indices_at, std::uint32_t normals_at, std::uint32_t colours_at,
             std::uint32_t names_at);
};

void Parts::add(const Mesh& mesh) {
  format::MeshDescriptor d;
  d.record_offset = records.size();
  write_record(records, level_of(mesh), mesh.positions);

  d.topology = format::Topology::kIndexed;
  d.index_offset = indices.size();
  d.index_count = static_cast<std::uint32_t>(mesh.indices.size());
  d.index_bytes = mesh.positions.size() <= 65536 ? 2 : 4;
  for (std::uint32_t i : mesh.indices) d.index_bytes == 2 ? indices.u16(i) : indices.u32(i);
  indices.pad_to_word();

  if (!mesh.normals.empty()) {
    d.normal_offset = normals.size();
    for (const Vec3& n : mesh.normals) normals.u32(pack_normal(n).bits);
  }
  d.base_colour = mesh.base_colour.bits;
  if (!mesh.colours.empty() && uniform(mesh.colours)) {
    d.base_colour = mesh.colours.front().bits;
  } else if (!mesh.colours.empty()) {
    d.colour_offset = colours.size();
    for (Rgba8 c : mesh.colours) colours.u32(c.bits);
  }
  if (mesh.tags.quota) {
    d.quota_kind = mesh.tags.quota->kind;
    d.quota = mesh.tags.quota->value;
  }
  d.area_threshold_px = mesh.tags.area_threshold_px.value_or(-1.0f);
  d.flags =
      (mesh.tags.telltale.value_or(false) ? format::kFlagTelltale : 0) | (mesh.two_sided ? format::kFlagTwoSided : 0);
  d.name_offset = names.size();
  d.name_bytes = static_cast<std::uint32_t>(mesh.name.size());
  names.text(mesh.name);
  meshes.push_back(d);
}

void Parts::place(std::uint32_t records_at, std::uint32_t indices_at, std::uint32_t normals_at,
                  std::uint32_t colours_at, std::uint32_t names_at) {
  for (format::MeshDescriptor& d : meshes) {
    d.record_offset += records_at;
    d.index_offset += indices_at;
    if (d.normal_offset != format::kAbsent) d.normal_offset += normals_at;
    if (d.colour_offset != format::kAbsent) d.colour_offset += colours_at;
    d.name_offset += names_at;
  }
}

Bytes descriptor_bytes(std::span<const format::MeshDescriptor> meshes) {
  Bytes out;
  for (const format::MeshDescriptor& d : meshes) {
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

constexpr std::uint32_t kFileBytesAt = 16, kCrcAt = 20, kCrcStart = 24;  // of format::Header

void write_header(Bytes& out, std::uint32_t section_count) {
  const format::Header header;
  out.u32(header.magic);
  out.u32(header.byte_order);
  out.u16(header.version_minor);
  out.u16(header.version_major);
  out.u32(header.flags);
  out.u32(0);  // file_bytes and crc32 are filled in at the end
  out.u32(0);
  out.u32(section_count);
  out.u32(header.reserved);
}

}  // namespace

std::vector<std::byte> write_container(const Model& model, const std::string& board) {
  check_mesh_count(model);
  check_size(model);
  Parts parts;
  parts.records.u32(static_cast<std::uint32_t>(model.meshes.size()));
  for (const Mesh& mesh : model.meshes) parts.add(mesh);
  parts.names.pad_to_word();
  Bytes board_name;
  board_name.text(board);
  board_name.pad_to_word();

  struct Placed {
    format::SectionType type;
    const Bytes* bytes;
    std::uint32_t size, offset = 0;
  };
  const auto descriptor_size = static_cast<std::uint32_t>(parts.meshes.size() * sizeof(format::MeshDescriptor));
  Placed records{format::SectionType::kRecords, &parts.records, parts.records.size()};
  Placed meshes{format::SectionType::kMeshes, nullptr, descriptor_size};
  Placed indices{format::SectionType::kIndices, &parts.indices, parts.indices.size()};
  Placed normals{format::SectionType::kNormals, &parts.normals, parts.normals.size()};
  Placed colours{format::SectionType::kColours, &parts.colours, parts.colours.size()};
  Placed names{format::SectionType::kNames, &parts.names, parts.names.size()};
  Placed only_board{format::SectionType::kBoard, &board_name, board_name.size()};

  // Empty sections are not written; NAME is, so that a nameless mesh's name still lies somewhere.
  std::vector<Placed*> order{&records, &meshes};
  for (Placed* section : {&indices, &normals, &colours})
    if (section->size != 0) order.push_back(section);
  order.push_back(&names);
  if (!board.empty()) order.push_back(&only_board);
  auto offset = static_cast<std::uint32_t>(sizeof(format::Header) + order.size() * sizeof(format::Section));
  for (Placed* section : order) {
    section->offset = offset;
    offset += section->size;
  }
  parts.place(records.offset, indices.offset, normals.offset, colours.offset, names.offset);
  const Bytes descriptors = descriptor_bytes(parts.meshes);
  meshes.bytes = &descriptors;

  Bytes out;
  write_header(out, static_cast<std::uint32_t>(order.size()));
  for (const Placed* section : order) {
    out.u32(static_cast<std::uint32_t>(section->type));
    out.u32(section->offset);
    out.u32(section->size);
    out.u32(0);
  }
  for (const Placed* section : order) out.append(*section->bytes);
  out.set_u32(kFileBytesAt, out.size());
  out.set_u32(kCrcAt, crc32(kCrc32Start, out.from(kCrcStart)));
  return out.take();
}

std::vector<std::byte> write_bare(const Model& model) {
  check_mesh_count(model);
  check_size(model);
  Bytes out;
  out.u32(static_cast<std::uint32_t>(model.meshes.size()));
  for (const Mesh& mesh : model.meshes) write_record(out, level_of(mesh), triangle_strip(mesh));
  if (out.size() > format::kMaxFileBytes)
    throw Error(ExitCode::kBadInput,
                "the strips take more than 1024 MiB, where the format ends; pack fewer or coarser models");
  return out.take();
}

}  // namespace usuzumi::sim
