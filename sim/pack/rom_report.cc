#include "sim/pack/rom_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "firmware/drawing_data/drawing_data.h"
#include "hal/crc32.h"
#include "sim/pack/appearance_report.h"
#include "sim/pack/layer_report.h"
#include "sim/pack/solid_report.h"

namespace usuzumi::sim {
namespace {

using json = nlohmann::ordered_json;
namespace format = firmware::format;
using firmware::DrawingData;
using firmware::MeshView;

constexpr std::array<const char*, 4> kTopologyNames{"strip", "list", "fan", "indexed"};
constexpr std::array<const char*, firmware::kLevelCount> kLevelLabels{"0 unset",    "1 keep",  "2 delete",
                                                                      "3 collapse", "4 point", "5 line"};

struct Box {
  Vec3 low, high;
};
Box bounding_box(std::span<const Vec3> positions) {
  Box box{positions.front(), positions.front()};
  for (const Vec3& p : positions) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

std::string quota_label(const MeshView& mesh) {
  switch (mesh.quota_kind) {
    case format::QuotaKind::kNone: return "-";
    case format::QuotaKind::kFaces: return fmt::format("{}", mesh.quota);
    case format::QuotaKind::kMillionths: return fmt::format("{:g}%", mesh.quota / 10'000.0);
  }
  return "-";
}

json mesh_json(const MeshView& mesh) {
  const Box box = bounding_box(mesh.positions);
  json j;
  j["number"] = mesh.number + 1;
  j["name"] = std::string(mesh.name);
  j["level"] = static_cast<std::uint32_t>(mesh.level);
  j["topology"] = kTopologyNames[static_cast<std::size_t>(mesh.topology)];
  j["vertices"] = mesh.positions.size();
  j["faces"] = mesh.proper_face_count();
  j["index_bytes"] = mesh.index_bytes;
  if (mesh.quota_kind == format::QuotaKind::kNone) j["face_quota"] = nullptr;
  else if (mesh.quota_kind == format::QuotaKind::kFaces) j["face_quota"] = mesh.quota;
  else j["face_quota"] = quota_label(mesh);
  j["area_threshold_px"] = mesh.area_threshold_px < 0 ? json(nullptr) : json(mesh.area_threshold_px);
  j["telltale"] = mesh.telltale();
  j["two_sided"] = mesh.two_sided();
  j["normals"] = !mesh.normals.empty();
  j["vertex_colours"] = !mesh.colours.empty();
  j["base_colour"] = colour_label(mesh.base_colour);
  add_appearance(j, mesh);
  j["layers"] = layers_json(mesh);
  j["bounding_box"] = {{"min", {box.low.x, box.low.y, box.low.z}}, {"max", {box.high.x, box.high.y, box.high.z}}};
  return j;
}

std::string mesh_line(const MeshView& mesh, std::size_t name_width) {
  const Box box = bounding_box(mesh.positions);
  const std::string flags = fmt::format("{}{}{}{}{}", mesh.normals.empty() ? '-' : 'n',
                                        mesh.colours.empty() ? '-' : 'c', mesh.texture_coordinates.empty() ? '-' : 'x',
                                        mesh.two_sided() ? '2' : '-', mesh.telltale() ? 't' : '-');
  return fmt::format(
      "{:>5}  {:<{}}  {:<10}  {:<8}  {:>9}  {:>9}  {:>8}  {:>8}  {:<5}  {:<9}  {:<8}  {:.4g},{:.4g},{:.4g} to "
      "{:.4g},{:.4g},{:.4g}\n",
      mesh.number + 1, mesh.name.empty() ? "-" : mesh.name, name_width, level_label(static_cast<unsigned>(mesh.level)),
      kTopologyNames[static_cast<std::size_t>(mesh.topology)], mesh.positions.size(), mesh.proper_face_count(),
      quota_label(mesh), mesh.area_threshold_px < 0 ? "-" : fmt::format("{:g}", mesh.area_threshold_px), flags,
      mesh.colours.empty() ? colour_label(mesh.base_colour) : "by vertex", material_label(mesh), box.low.x, box.low.y,
      box.low.z, box.high.x, box.high.y, box.high.z);
}

/// What a ROM without a stored checksum can be told by, or the stored one, which open() has found right.
std::uint32_t crc_of(const DrawingData& data) {
  return data.bare() ? crc32(kCrc32Start, data.bytes()) : crc32(kCrc32Start, data.bytes().subspan(24));
}

struct Totals {
  std::uint64_t vertices = 0, faces = 0;
  std::size_t name_width = 4;
};

Totals totals_of(const DrawingData& data) {
  Totals t;
  data.for_each_mesh([&](const MeshView& mesh) {
    t.vertices += mesh.positions.size();
    t.faces += mesh.proper_face_count();
    t.name_width = std::max(t.name_width, std::min<std::size_t>(mesh.name.size(), 32));
  });
  return t;
}

/// "1.0" of a container.
std::string version_of(std::span<const std::byte> rom) {
  format::Header header;
  std::memcpy(&header, rom.data(), sizeof header);
  return fmt::format("{}.{}", header.version_major, header.version_minor);
}

std::string describe_json(const DrawingData& data, const std::string& file, const Totals& totals) {
  json j;
  j["file"] = file;
  j["sound"] = true;
  j["format"] = data.bare() ? "bare" : "container";
  j["version"] = data.bare() ? json(nullptr) : json(version_of(data.bytes()));
  j["bytes"] = data.bytes().size();
  j["crc32"] = fmt::format("{:08x}", crc_of(data));
  j["board"] = data.board().empty() ? json(nullptr) : json(std::string(data.board()));
  j["mesh_max"] = data.mesh_max();
  j["vertices"] = totals.vertices;
  j["faces"] = totals.faces;
  j["textures"] = textures_json(data);
  j["materials"] = materials_json(data);
  j["meshes"] = json::array();
  data.for_each_mesh([&](const MeshView& mesh) { j["meshes"].push_back(mesh_json(mesh)); });
  j["solids"] = solids_json(data);
  return j.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string describe_text(const DrawingData& data, const std::string& file, const Totals& totals) {
  std::string out =
      fmt::format("{}: {}{}, {} bytes, CRC-32 {:08x}, {} meshes, {} vertices, {} faces; sound\n", file,
                  data.bare() ? std::string("bare drawing data") : "container version " + version_of(data.bytes()),
                  data.board().empty() ? "" : fmt::format(" for board {} alone", data.board()), data.bytes().size(),
                  crc_of(data), data.mesh_max(), totals.vertices, totals.faces);
  if (data.mesh_max() > 0) {
    out += fmt::format("{:>5}  {:<{}}  {:<10}  {:<8}  {:>9}  {:>9}  {:>8}  {:>8}  {:<5}  {:<9}  {:<8}  {}\n", "mesh",
                       "name", totals.name_width, "level", "topology", "vertices", "faces", "quota", "area px", "flags",
                       "colour", "material", "bounding box");
    data.for_each_mesh([&](const MeshView& mesh) { out += mesh_line(mesh, totals.name_width); });
    out += "flags: n normals, c vertex colours, x texture coordinates, 2 two-sided, t telltale\n";
  }
  out += appearance_text(data);
  out += layers_text(data);
  out += solids_text(data);
  return out;
}

}  // namespace

const char* level_label(unsigned level) { return level < kLevelLabels.size() ? kLevelLabels[level] : "?"; }

std::string unsound_line(std::span<const std::byte> rom, const std::string& file, const Status& status) {
  std::uint32_t magic = 0;
  if (rom.size() >= sizeof magic) std::memcpy(&magic, rom.data(), sizeof magic);
  if (magic == format::kMagic)
    return fmt::format("{}: unsound: {} {}; pack it again", file, status.message, status.where);
  return fmt::format(
      "{}: neither a container nor sound bare drawing data: {} {}; name a ROM image, as usuzumi pack writes", file,
      status.message, status.where);
}

RomReport describe_rom(std::span<const std::byte> rom, const std::string& file) {
  RomReport report;
  const Result<DrawingData> opened = DrawingData::open(rom);
  if (!opened.ok()) {
    const Status& status = opened.status();
    report.error = unsound_line(rom, file, status);
    json j;
    j["file"] = file;
    j["sound"] = false;
    j["bytes"] = rom.size();
    j["error"] = status.message;
    j["offset"] = status.where;
    report.json = j.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
    return report;
  }
  const Totals totals = totals_of(*opened);
  report.sound = true;
  report.text = describe_text(*opened, file, totals);
  report.json = describe_json(*opened, file, totals);
  return report;
}

}  // namespace usuzumi::sim
