#include "sim/pack/appearance_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "sim/pack/method_settings.h"

namespace usuzumi::sim {
namespace {

using firmware::DrawingData;
using firmware::MaterialView;
using firmware::MeshView;
using firmware::Method;
using firmware::TextureView;
using json = nlohmann::ordered_json;
namespace format = firmware::format;

constexpr std::array<const char*, 4> kFormatNames{"none", "rgb565", "xrgb8888", "argb8888"};
constexpr std::array<const char*, 2> kFilterNames{"nearest", "bilinear"};
constexpr std::array<const char*, 3> kWrapNames{"repeat", "clamp", "mirror"};
constexpr std::array<const char*, 3> kAlphaNames{"opaque", "mask", "blend"};

template <class List, class Enum>
const char* name_of(const List& names, Enum value) {
  return names[static_cast<std::size_t>(value)];
}

/// Numbers in reports count from 1, as meshes do.
json number_json(std::uint32_t number) { return number == format::kAbsent ? json(nullptr) : json(number + 1); }

std::vector<std::pair<std::string, std::string>> settings_of(const MeshView& mesh) {
  if (mesh.method == Method::kEdgeRemoval) return spelled_settings(mesh.edge_removal());
  if (mesh.method == Method::kVertexDeletion) return spelled_settings(mesh.vertex_deletion());
  return {};
}

struct EdgeValueCount {
  std::size_t valued = 0, locked = 0;
};
EdgeValueCount count_edge_values(const MeshView& mesh) {
  EdgeValueCount n;
  for (float v : mesh.edge_values) {
    if (v > 0) ++n.valued;
    if (v == firmware::kLockedEdgeValue) ++n.locked;
  }
  return n;
}

json settings_json(const MeshView& mesh) {
  json out = json::object();
  for (const auto& [name, value] : settings_of(mesh)) {
    const json number = json::parse(value, nullptr, false);
    out[name] = number.is_number() ? number : json(value);
  }
  return out.empty() ? json(nullptr) : out;
}

std::string texture_lines(const DrawingData& data) {
  if (data.texture_count() == 0) return "";
  std::string out =
      fmt::format("{:>7}  {:<9}  {:<8}  {:>6}  {:>10}  {}\n", "texture", "size", "format", "levels", "bytes", "name");
  for (std::uint32_t n = 0; n < data.texture_count(); ++n) {
    const TextureView t = data.texture(n);
    out += fmt::format("{:>7}  {:<9}  {:<8}  {:>6}  {:>10}  {}\n", n + 1, fmt::format("{}x{}", t.width, t.height),
                       name_of(kFormatNames, t.format), t.level_count, t.texels.size(), t.name.empty() ? "-" : t.name);
  }
  return out;
}

std::string material_lines(const DrawingData& data) {
  if (data.material_count() == 0) return "";
  std::string out = fmt::format("{:>8}  {:>7}  {:<8}  {:<14}  {}\n", "material", "texture", "filter", "wrap", "alpha");
  for (std::uint32_t n = 0; n < data.material_count(); ++n) {
    const MaterialView m = data.material(n);
    const bool textured = m.texture.present();
    out += fmt::format(
        "{:>8}  {:>7}  {:<8}  {:<14}  {}\n", n + 1, textured ? fmt::format("{}", m.texture.number + 1) : "-",
        textured ? name_of(kFilterNames, m.filter) : "-",
        textured ? fmt::format("{},{}", name_of(kWrapNames, m.wrap_s), name_of(kWrapNames, m.wrap_t)) : "-",
        m.alpha_mode == format::AlphaMode::kMask ? fmt::format("mask from {}", m.alpha_reference)
                                                 : name_of(kAlphaNames, m.alpha_mode));
  }
  return out;
}

std::string method_line(const MeshView& mesh) {
  std::string out = fmt::format("mesh {}: method {}", mesh.number + 1, method_name(mesh.method));
  if (mesh.method_settings != nullptr) {
    std::vector<std::string> words;
    for (const auto& [name, value] : settings_of(mesh)) words.push_back(fmt::format("{} {}", name, value));
    out += fmt::format(": {}", fmt::join(words, ", "));
  }
  if (!mesh.edge_values.empty()) {
    const EdgeValueCount n = count_edge_values(mesh);
    out += fmt::format("; {} vertices with an edge value, {} locked", n.valued, n.locked);
  }
  return out + '\n';
}

}  // namespace

std::string colour_label(Rgba8 c) {
  return c.a() == 255 ? fmt::format("#{:02x}{:02x}{:02x}", c.r(), c.g(), c.b())
                      : fmt::format("#{:02x}{:02x}{:02x}{:02x}", c.r(), c.g(), c.b(), c.a());
}

void add_appearance(json& j, const MeshView& mesh) {
  j["texture_coordinates"] = !mesh.texture_coordinates.empty();
  j["material"] = number_json(mesh.material.number);
  j["groups"] = json::array();
  for (std::uint32_t g = 0; !mesh.groups.empty() && g < mesh.group_count(); ++g) {
    const format::FaceGroup group = mesh.group(g);
    j["groups"].push_back({{"face_end", group.face_end},
                           {"vertex_end", group.vertex_end},
                           {"material", number_json(group.material)},
                           {"base_colour", colour_label(Rgba8{group.base_colour})}});
  }
  j["method"] = method_name(mesh.method);
  j["method_settings"] = settings_json(mesh);
  const EdgeValueCount n = count_edge_values(mesh);
  j["edge_values"] = mesh.edge_values.empty() ? json(nullptr) : json{{"valued", n.valued}, {"locked", n.locked}};
}

json materials_json(const DrawingData& data) {
  json all = json::array();
  for (std::uint32_t n = 0; n < data.material_count(); ++n) {
    const MaterialView m = data.material(n);
    all.push_back({{"number", n + 1},
                   {"texture", number_json(m.texture.number)},
                   {"filter", name_of(kFilterNames, m.filter)},
                   {"wrap", {name_of(kWrapNames, m.wrap_s), name_of(kWrapNames, m.wrap_t)}},
                   {"alpha_mode", name_of(kAlphaNames, m.alpha_mode)},
                   {"alpha_reference", m.alpha_reference}});
  }
  return all;
}

json textures_json(const DrawingData& data) {
  json all = json::array();
  for (std::uint32_t n = 0; n < data.texture_count(); ++n) {
    const TextureView t = data.texture(n);
    all.push_back({{"number", n + 1},
                   {"name", std::string(t.name)},
                   {"width", t.width},
                   {"height", t.height},
                   {"format", name_of(kFormatNames, t.format)},
                   {"levels", t.level_count},
                   {"bytes", t.texels.size()}});
  }
  return all;
}

std::string material_label(const MeshView& mesh) {
  std::vector<std::string> numbers;
  for (std::uint32_t g = 0; g < mesh.group_count(); ++g) {
    const std::uint32_t material = mesh.group(g).material;
    numbers.push_back(material == format::kAbsent ? "-" : fmt::format("{}", material + 1));
  }
  return fmt::format("{}", fmt::join(numbers, ","));
}

std::string appearance_text(const DrawingData& data) {
  std::string out = texture_lines(data) + material_lines(data);
  data.for_each_mesh([&](const MeshView& mesh) {
    if (mesh.method != Method::kQem || !mesh.edge_values.empty()) out += method_line(mesh);
  });
  return out;
}

}  // namespace usuzumi::sim
