#include "sim/pack/rom_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "hal/crc32.h"
#include "sim/common/error.h"
#include "sim/pack/rom_bytes.h"
#include "sim/pack/rom_sections.h"
#include "sim/pack/strip.h"

namespace usuzumi::sim {
namespace {

namespace format = firmware::format;

void check_mesh_count(const Model& model) {
  if (model.meshes.empty() && model.solids.empty())
    throw Error(ExitCode::kBadInput, "nothing to pack: the input has no triangles");
  if (model.meshes.size() > format::kMaxMeshes)
    throw Error(ExitCode::kBadInput,
                fmt::format("{} meshes, but drawing data hold at most {}; join some in the modelling tool",
                            model.meshes.size(), format::kMaxMeshes));
}

/// Before anything is written: an upper bound of the file, so that no 32-bit offset can wrap.
void check_size(const Model& model) {
  std::uint64_t bytes = 0;
  for (const Mesh& mesh : model.meshes)
    bytes += 512 + mesh.name.size() + 32 * std::uint64_t{mesh.positions.size()} +
             4 * std::uint64_t{mesh.indices.size()} + 16 * std::uint64_t{mesh.parts.size()} + mesh.layer_chain.size();
  for (const Solid& solid : model.solids) bytes += 128 + solid.name.size();
  for (const Picture& picture : model.textures)  // 4 bytes a texel; all levels are at most twice the first
    bytes += 512 + picture.name.size() + 8 * std::uint64_t{picture.texels.size()};
  if (bytes > format::kMaxFileBytes)
    throw Error(
        ExitCode::kBadInput,
        fmt::format("about {} MiB of drawing data, but the format ends at 1024 MiB; pack fewer or coarser models",
                    bytes >> 20));
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

command::TextureFormat stored_format(const Picture& picture, TexelChoice choice) {
  constexpr std::uint32_t kOpaque = 255;
  const bool opaque =
      std::all_of(picture.texels.begin(), picture.texels.end(), [](Rgba8 c) { return c.a() == kOpaque; });
  if (!opaque || choice == TexelChoice::kArgb8888) return command::TextureFormat::kArgb8888;
  return choice == TexelChoice::kRgb565 ? command::TextureFormat::kRgb565 : command::TextureFormat::kXrgb8888;
}

std::vector<std::byte> write_container(const Model& model, const RomOptions& options) {
  check_mesh_count(model);
  check_size(model);
  const std::vector<RomSections::Placed> sections =
      RomSections(model, options).place(sizeof(format::Header), sizeof(format::Section));
  Bytes out;
  write_header(out, static_cast<std::uint32_t>(sections.size()));
  for (const RomSections::Placed& section : sections) {
    out.u32(static_cast<std::uint32_t>(section.type));
    out.u32(section.offset);
    out.u32(section.bytes.size());
    out.u32(0);
  }
  for (const RomSections::Placed& section : sections) out.append(section.bytes);
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
