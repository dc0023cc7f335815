#include "sim/pack/gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "sim/common/error.h"
#include "sim/common/files.h"
#include "sim/pack/gltf_uri.h"
#include "sim/pack/tag_values.h"

namespace usuzumi::sim {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// The importer follows nested values by recursion; nothing real is nested deeper.
constexpr int kDeepestJson = 200;
constexpr std::uint32_t kGlbMagic = 0x46546C67, kJsonChunk = 0x4E4F534A;
constexpr std::size_t kGlbHeaderBytes = 12, kChunkHeaderBytes = 8, kGlb1HeaderBytes = 20;

/// Extensions that change nothing of the geometry, or that are read here; a file may require them.
constexpr std::array<std::string_view, 6> kHarmlessPrefixes{
    "KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_", "KHR_lights_punctual", "KHR_technique_webgl"};

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw Error(ExitCode::kBadInput, fmt::format("{}: {}", path.string(), why));
}

std::uint32_t word(const std::vector<std::byte>& bytes, std::size_t at) {
  std::uint32_t v = 0;
  for (unsigned i = 0; i < 4; ++i) v |= std::to_integer<std::uint32_t>(bytes[at + i]) << (8 * i);
  return v;
}

std::string_view text_of(const std::vector<std::byte>& bytes, std::size_t at, std::size_t size) {
  return {reinterpret_cast<const char*>(bytes.data()) + at, size};
}

/// The JSON of a binary glTF, its container checked. Sets the version of the container.
std::string_view glb_json(const fs::path& path, GltfFile& file) {
  const auto& b = file.bytes;
  if (b.size() < kGlb1HeaderBytes) refuse(path, "the file ends inside its header; export it again");
  const std::uint32_t version = word(b, 4), length = word(b, 8), json_bytes = word(b, 12);
  if (version != 1 && version != 2)
    refuse(path, fmt::format("binary glTF of version {}, but 1 and 2 are read; export it as glTF 2.0", version));
  if (length > b.size())
    refuse(path, fmt::format("truncated: {} bytes of {}; copy or export it again", b.size(), length));
  file.version_major = static_cast<int>(version);
  if (version == 2 && word(b, 16) != kJsonChunk) refuse(path, "its first chunk is not JSON; export it again");
  // Version 1 has a 20-byte header that ends in length and format.
  const std::size_t start = kGlbHeaderBytes + kChunkHeaderBytes;
  if (json_bytes > b.size() - start) refuse(path, "its JSON runs past the end of the file; copy or export it again");
  return text_of(b, start, json_bytes);
}

json parse(const fs::path& path, std::string_view text) {
  auto too_deep = [](int depth, json::parse_event_t, json&) -> bool {
    if (depth > kDeepestJson) throw std::length_error("nested too deep");
    return true;
  };
  try {
    json root = json::parse(text.begin(), text.end(), too_deep);
    if (!root.is_object()) refuse(path, "its JSON is not an object, so it is no glTF; export it again");
    return root;
  } catch (const std::length_error&) {
    refuse(path, fmt::format("its JSON is nested more than {} deep; export it again", kDeepestJson));
  } catch (const json::parse_error& e) {
    refuse(path, fmt::format("not glTF: JSON error at byte {}; export it again", e.byte));
  }
}

int major_version(const fs::path& path, const json& root) {
  const auto asset = root.find("asset");
  if (asset == root.end() || !asset->is_object() || !asset->contains("version"))
    refuse(path, "no asset.version, so it is no glTF; export it again");
  const json& v = (*asset)["version"];
  // glTF 1.0 files in the wild have the number 1 as well as the string "1.0".
  const std::string version = v.is_string() ? v.get<std::string>() : v.dump();
  if (version.starts_with("2.") || version == "2") return 2;
  if (version.starts_with("1.") || version == "1") return 1;
  refuse(path,
         fmt::format("glTF of version {}, but 1.0 and 2.x are read; export it as glTF 2.0", version.substr(0, 20)));
}

void check_required_extensions(const fs::path& path, const json& root) {
  const auto required = root.find("extensionsRequired");
  if (required == root.end()) return;
  if (!required->is_array()) refuse(path, "extensionsRequired is not a list; export it again");
  for (const json& entry : *required) {
    const std::string name = entry.is_string() ? entry.get<std::string>() : entry.dump().substr(0, 40);
    if (name == "KHR_draco_mesh_compression")
      refuse(path,
             "its meshes are compressed with Draco, which is not read here; export it again with compression off "
             "(Blender: "
             "Export glTF > Data > Compression), or run gltf-transform copy");
    if (name == "EXT_meshopt_compression" || name == "KHR_meshopt_compression")
      refuse(path,
             "its buffers are compressed with meshopt, which is not read here; export it again without compression, or "
             "run "
             "gltf-transform copy (gltfpack: leave out -c and -cc)");
    const bool harmless =
        name == "KHR_mesh_quantization" || std::any_of(kHarmlessPrefixes.begin(), kHarmlessPrefixes.end(),
                                                       [&](std::string_view p) { return name.starts_with(p); });
    if (!harmless)
      refuse(path, fmt::format("it requires the extension {}, which is not known here; export it without", name));
  }
}

/// A missing image does no harm; a missing buffer is missing geometry.
void find_buffer_files(const fs::path& path, const json& root, GltfFile& gltf) {
  const auto buffers = root.find("buffers");
  if (buffers == root.end()) return;
  for (const auto& [key, buffer] : buffers->items()) {
    if (!buffer.is_object()) refuse(path, fmt::format("buffer {} is not an object; export it again", key));
    const auto uri = buffer.find("uri");
    if (uri == buffer.end() || !uri->is_string()) continue;  // the binary chunk; the importer checks
    const std::string text = uri->get<std::string>();
    if (is_data_uri(text)) continue;
    const fs::path file = path.parent_path() / decoded_uri(text);
    std::error_code none;
    if (!fs::is_regular_file(file, none))
      refuse(path,
             fmt::format("its buffer file {} is missing; put it beside the model, or export as .glb", file.string()));
    const auto length = buffer.find("byteLength");
    const std::uint64_t bytes =
        length != buffer.end() && length->is_number_unsigned() ? length->get<std::uint64_t>() : 0;
    if (bytes > fs::file_size(file, none))
      refuse(path,
             fmt::format("its buffer file {} is shorter than the {} bytes it should have; copy or export it again",
                         file.string(), bytes));
    gltf.buffer_files[decoded_uri(text)] = bytes;
  }
}

/// The numbers of `object[key]` into `out`; false where there are not just as many numbers.
template <std::size_t kCount>
bool read_numbers(const json& object, const char* key, double (&out)[kCount]) {
  const auto found = object.find(key);
  if (found == object.end()) return true;  // the default stays
  if (!found->is_array() || found->size() != kCount) return false;
  for (std::size_t i = 0; i < kCount; ++i) {
    if (!(*found)[i].is_number()) return false;
    out[i] = (*found)[i].get<double>();
  }
  return true;
}

/// Of a glTF 1.0 node without a matrix. assimp 5.2 multiplies these parts in the wrong order: a wheel that is turned
/// and moved would be moved along its turned axes.
std::optional<Transform> local_transform(const json& node) {
  if (node.contains("matrix")) return std::nullopt;
  double translation[3] = {0, 0, 0}, rotation[4] = {0, 0, 0, 1}, scale[3] = {1, 1, 1};
  if (!read_numbers(node, "translation", translation) || !read_numbers(node, "rotation", rotation) ||
      !read_numbers(node, "scale", scale))
    return std::nullopt;
  return from_parts(translation, rotation, scale);
}

std::string name_of(const json& object) {
  return object.contains("name") && object["name"].is_string() ? object["name"].get<std::string>() : std::string();
}

/// Names in glTF 1.0's `kind`, by identifier, of those that have one.
std::map<std::string, std::string> read_names(const json& root, const char* kind) {
  std::map<std::string, std::string> names;
  const auto all = root.find(kind);
  if (all == root.end() || !all->is_object()) return names;
  for (const auto& [id, object] : all->items())
    if (object.is_object() && !name_of(object).empty()) names[id] = name_of(object);
  return names;
}

/// Names, thinning properties and transforms of glTF 1.0's `kind` ("nodes" or "meshes"), which are objects by
/// identifier there.
std::map<std::string, Gltf1Label> read_labels(const fs::path& path, const json& root, const char* kind,
                                              std::vector<std::string>& notes) {
  std::map<std::string, Gltf1Label> labels;
  const auto all = root.find(kind);
  if (all == root.end() || !all->is_object()) return labels;
  for (const auto& [id, object] : all->items()) {
    if (!object.is_object()) continue;
    Gltf1Label& label = labels[id];
    label.name = name_of(object);
    label.local = local_transform(object);
    if (!object.contains("extras") || !object["extras"].is_object()) continue;
    std::vector<std::pair<std::string, TagValue>> extras;
    for (const auto& [key, value] : object["extras"].items()) extras.emplace_back(key, tag_value_of(value));
    label.tags = tags_from_extras(extras, path.string(), fmt::format("{} '{}'", kind, id), notes);
  }
  return labels;
}

}  // namespace

GltfFile open_gltf(const fs::path& path) {
  GltfFile file;
  file.bytes = read_file(path);
  if (file.bytes.empty()) refuse(path, "the file is empty; export it again");
  file.binary = file.bytes.size() >= 4 && word(file.bytes, 0) == kGlbMagic;
  std::string_view text = file.binary ? glb_json(path, file) : text_of(file.bytes, 0, file.bytes.size());
  const json root = parse(path, text);
  const int version = major_version(path, root);
  if (!file.binary) file.version_major = version;
  if (file.version_major == 2) check_required_extensions(path, root);
  find_buffer_files(path, root, file);
  if (file.version_major == 1) {
    file.gltf1_nodes = read_labels(path, root, "nodes", file.notes);
    file.gltf1_meshes = read_labels(path, root, "meshes", file.notes);
    file.gltf1_materials = read_names(root, "materials");
  }
  return file;
}

}  // namespace usuzumi::sim
