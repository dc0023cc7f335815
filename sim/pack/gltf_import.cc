#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/common/error.h"
#include "sim/common/files.h"
#include "sim/pack/colour.h"
#include "sim/pack/gltf_accessor.h"
#include "sim/pack/gltf_material.h"
#include "sim/pack/gltf_uri.h"
#include "sim/pack/importers.h"
#include "sim/pack/tag_values.h"
#include "sim/pack/text.h"
#include "sim/pack/textured.h"
#include "sim/pack/tinygltf.h"
#include "sim/pack/transform.h"
#include "sim/pack/triangles.h"

namespace usuzumi::sim {
namespace {

namespace fs = std::filesystem;

/// What tinygltf may read from disk: the buffers, and of those only the bytes that they declare. Images in files of
/// their own are read where a material uses them (gltf_material.h).
struct BufferFolder {
  fs::path folder;
  const std::map<std::string, std::uint64_t>* files;

  std::optional<std::pair<fs::path, std::uint64_t>> find(const std::string& wanted) const {
    for (const auto& [name, bytes] : *files)
      if ((folder / name).lexically_normal() == fs::path(wanted).lexically_normal())
        return std::pair{folder / name, bytes};
    return std::nullopt;
  }
};

bool buffer_exists(const std::string& name, void* folder) {
  return static_cast<const BufferFolder*>(folder)->find(name).has_value();
}

bool read_buffer(std::vector<unsigned char>* out, std::string* error, const std::string& name, void* folder) {
  const auto file = static_cast<const BufferFolder*>(folder)->find(name);
  if (!file) return false;
  try {
    const std::vector<std::byte> bytes = read_file(file->first);
    out->resize(std::min<std::size_t>(bytes.size(), file->second));
    if (!out->empty()) std::memcpy(out->data(), bytes.data(), out->size());
    return true;
  } catch (const Error& e) {
    *error = e.what();
    return false;
  }
}

std::string unexpanded(const std::string& name, void*) { return name; }

/// Keeps the bytes of a data URI as they are. Those of a buffer view stay where they lie; its range is not checked yet.
bool keep_image(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes, int size,
                void*) {
  image->as_is = true;
  if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
  return true;
}

tinygltf::Model parse(const fs::path& path, const GltfFile& file) {
  tinygltf::TinyGLTF loader;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  BufferFolder buffers{folder, &file.buffer_files};
  loader.SetStoreOriginalJSONForExtrasAndExtensions(true);
  loader.SetImageLoader(keep_image, nullptr);
  loader.SetFsCallbacks({buffer_exists, unexpanded, read_buffer, nullptr, &buffers});
  tinygltf::Model model;
  std::string error, warning;
  const auto* bytes = reinterpret_cast<const unsigned char*>(file.bytes.data());
  const auto size = static_cast<unsigned int>(file.bytes.size());
  const bool ok = file.binary ? loader.LoadBinaryFromMemory(&model, &error, &warning, bytes, size, folder.string())
                              : loader.LoadASCIIFromString(&model, &error, &warning,
                                                           reinterpret_cast<const char*>(bytes), size, folder.string());
  // The loader goes on after some errors, having dropped what it could not read; the user must not lose it silently.
  if (!ok || !error.empty())
    throw Error(ExitCode::kBadInput, fmt::format("{}: damaged glTF: {}; export it again", path.string(),
                                                 error.empty() ? "it cannot be parsed" : one_line(error)));
  return model;
}

/// Extras as they stand in the file; tinygltf's own values of them drop null and empty lists.
std::vector<std::pair<std::string, TagValue>> properties(const std::string& extras_json) {
  std::vector<std::pair<std::string, TagValue>> all;
  const nlohmann::json extras = nlohmann::json::parse(extras_json, nullptr, false);
  if (!extras.is_object()) return all;
  for (const auto& [key, value] : extras.items()) all.emplace_back(key, tag_value_of(value));
  return all;
}

class GltfImporter {
 public:
  GltfImporter(const fs::path& path, const tinygltf::Model& gltf)
      : file_(path.string()),
        stem_(path.stem().string()),
        gltf_(gltf),
        accessors_(gltf_, file_),
        materials_(path, file_, gltf_, model_) {}

  Model import() {
    read_extras();
    place_nodes();
    note_what_is_left_out();
    return std::move(model_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ExitCode::kBadInput, fmt::format("{}: {}; export it again", file_, why));
  }

  void read_extras() {
    for (std::size_t i = 0; i < gltf_.meshes.size(); ++i)
      mesh_tags_.push_back(tags_from_extras(properties(gltf_.meshes[i].extras_json_string), file_,
                                            described("mesh", i, gltf_.meshes[i].name), model_.notes));
    for (std::size_t i = 0; i < gltf_.nodes.size(); ++i) {
      const tinygltf::Node& node = gltf_.nodes[i];
      const std::string whose = described("node", i, node.name);
      node_tags_.push_back(tags_from_extras(properties(node.extras_json_string), file_, whose, model_.notes));
      if (node_tags_.back().any() && node.mesh < 0)
        model_.notes.push_back(fmt::format(
            "{}: {} has thinning properties but no mesh, so they do nothing; give them to the nodes with meshes", file_,
            whose));
    }
  }

  static std::string described(const char* kind, std::size_t i, const std::string& name) {
    return name.empty() ? fmt::format("{} {}", kind, i) : fmt::format("{} '{}'", kind, name);
  }

  /// The nodes to begin with: the default scene's, else the first scene's, else all that are nobody's child.
  std::vector<int> roots() const {
    if (!gltf_.scenes.empty()) {
      const int scene = gltf_.defaultScene >= 0 ? gltf_.defaultScene : 0;
      if (static_cast<std::size_t>(scene) >= gltf_.scenes.size()) refuse(fmt::format("scene {} does not exist", scene));
      return gltf_.scenes[static_cast<std::size_t>(scene)].nodes;
    }
    std::vector<bool> child(gltf_.nodes.size(), false);
    for (const tinygltf::Node& node : gltf_.nodes)
      for (int c : node.children)
        if (c >= 0 && static_cast<std::size_t>(c) < child.size()) child[static_cast<std::size_t>(c)] = true;
    std::vector<int> all;
    for (std::size_t i = 0; i < child.size(); ++i)
      if (!child[i]) all.push_back(static_cast<int>(i));
    return all;
  }

  /// Walks the tree in the file's order without recursion: it may be deep.
  void place_nodes() {
    struct Visit {
      int node;
      Transform parent;
    };
    std::vector<Visit> stack;
    auto push = [&](const std::vector<int>& nodes, const Transform& parent) {
      for (auto n = nodes.rbegin(); n != nodes.rend(); ++n) stack.push_back({*n, parent});
    };
    placed_.assign(gltf_.meshes.size(), false);
    std::vector<bool> visited(gltf_.nodes.size(), false);
    push(roots(), Transform{});
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      if (visit.node < 0 || static_cast<std::size_t>(visit.node) >= gltf_.nodes.size())
        refuse(fmt::format("node {} does not exist", visit.node));
      const auto i = static_cast<std::size_t>(visit.node);
      const tinygltf::Node& node = gltf_.nodes[i];
      if (visited[i]) refuse(described("node", i, node.name) + " appears twice in the node tree");
      visited[i] = true;
      const Transform world = visit.parent * local_transform(i);
      if (!world.finite()) refuse(described("node", i, node.name) + " has a transform that is not finite");
      if (node.mesh >= 0) place_mesh(i, world);
      push(node.children, world);
    }
    // A file without any node is a library of meshes; show them where they are.
    if (gltf_.nodes.empty() && gltf_.scenes.empty())
      for (std::size_t m = 0; m < gltf_.meshes.size(); ++m) add_mesh(m, "", mesh_tags_[m], Transform{});
  }

  Transform local_transform(std::size_t i) const {
    const tinygltf::Node& node = gltf_.nodes[i];
    auto size_is = [&](const std::vector<double>& v, std::size_t n, const char* what) {
      if (!v.empty() && v.size() != n)
        refuse(fmt::format("{}: {} has {} numbers, not {}", described("node", i, node.name), what, v.size(), n));
      return !v.empty();
    };
    if (size_is(node.matrix, 16, "matrix")) {
      Transform t;
      for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column)
          t.m[row][column] = node.matrix[column * 4 + row];  // column-major in glTF
      return t;
    }
    double translation[3] = {0, 0, 0}, rotation[4] = {0, 0, 0, 1}, scale[3] = {1, 1, 1};
    if (size_is(node.translation, 3, "translation"))
      std::copy(node.translation.begin(), node.translation.end(), translation);
    if (size_is(node.rotation, 4, "rotation")) std::copy(node.rotation.begin(), node.rotation.end(), rotation);
    if (size_is(node.scale, 3, "scale")) std::copy(node.scale.begin(), node.scale.end(), scale);
    return from_parts(translation, rotation, scale);
  }

  void place_mesh(std::size_t node_index, const Transform& world) {
    const tinygltf::Node& node = gltf_.nodes[node_index];
    const auto m = static_cast<std::size_t>(node.mesh);
    if (m >= gltf_.meshes.size())
      refuse(fmt::format("{} places mesh {}, which does not exist", described("node", node_index, node.name), m));
    if (node.skin >= 0) ++skinned_;
    add_mesh(m, node.name, merge_tags(node_tags_[node_index], mesh_tags_[m]), world);
  }

  void add_mesh(std::size_t m, const std::string& node_name, const Tags& tags, const Transform& world) {
    placed_[m] = true;
    ++placements_;
    const tinygltf::Mesh& source = gltf_.meshes[m];
    for (std::size_t p = 0; p < source.primitives.size(); ++p) {
      Mesh mesh;
      mesh.mesh_name = !source.name.empty() ? source.name : (!node_name.empty() ? node_name : stem_);
      mesh.node_name = node_name;
      mesh.tags = tags;
      mesh.placement = placements_;
      if (!read_primitive(source.primitives[p], fmt::format("{} primitive {}", described("mesh", m, source.name), p),
                          mesh))
        continue;
      apply(world, mesh);
      model_.meshes.push_back(std::move(mesh));
      if (model_.meshes.size() > firmware::format::kMaxMeshes)
        throw Error(ExitCode::kBadInput,
                    fmt::format("{}: more than {} primitives, which is more meshes than drawing data hold; join some",
                                file_, firmware::format::kMaxMeshes));
    }
  }

  /// False where the primitive has nothing that can be drawn as faces.
  bool read_primitive(const tinygltf::Primitive& primitive, const std::string& what, Mesh& mesh) {
    if (primitive.mode == TINYGLTF_MODE_POINTS ||
        (primitive.mode >= TINYGLTF_MODE_LINE && primitive.mode <= TINYGLTF_MODE_LINE_STRIP)) {
      pointy_.insert(what);
      return false;
    }
    if (primitive.mode < 0 || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
      refuse(fmt::format("{} has the unknown mode {}", what, primitive.mode));
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) {
      positionless_.insert(what);
      return false;
    }
    const Elements positions = accessors_.floats(position->second, 3, 3, "POSITION of " + what);
    for (std::size_t i = 0; i < positions.count(); ++i)
      mesh.positions.push_back({positions.at(i)[0], positions.at(i)[1], positions.at(i)[2]});
    read_normals(primitive, what, mesh);
    const GltfMaterial material = materials_.read(primitive.material, what);
    mesh.two_sided = material.two_sided;
    mesh.material_name = material.name;
    if (material.needed()) mesh.material = material_number(model_, material.material);
    read_colours(primitive, what, material.factor, mesh);
    if (material.material.texture) read_texture_coordinates(primitive, what, material, mesh);
    read_vertex_groups(primitive, what, mesh);
    if (!primitive.targets.empty()) ++morphed_;

    std::vector<std::uint32_t> order;
    if (primitive.indices >= 0) {
      order = accessors_.indices(primitive.indices, "indices of " + what);
    } else {
      for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) order.push_back(i);
    }
    for (std::uint32_t i : order)
      if (i >= mesh.positions.size())
        refuse(fmt::format("{} refers to vertex {} of {}", what, i, mesh.positions.size()));
    const Assembly assembly = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ? Assembly::kStrip
                              : primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN ? Assembly::kFan
                                                                             : Assembly::kList;
    mesh.indices = assemble(assembly, order);
    if (assembly == Assembly::kList && order.size() % 3 != 0)
      model_.notes.push_back(fmt::format("{}: {}: {} corners are no whole number of triangles; the last {} left out",
                                         file_, what, order.size(), order.size() % 3));
    return true;
  }

  Elements attribute(const tinygltf::Primitive& primitive, const std::string& name, std::size_t least, std::size_t most,
                     const std::string& what, const Mesh& mesh) const {
    const auto at = primitive.attributes.find(name);
    if (at == primitive.attributes.end()) return {};
    Elements elements = accessors_.floats(at->second, least, most, fmt::format("{} of {}", name, what));
    if (elements.count() != mesh.positions.size())
      refuse(fmt::format("{} has {} positions but {} of {}", what, mesh.positions.size(), elements.count(), name));
    return elements;
  }

  void read_normals(const tinygltf::Primitive& primitive, const std::string& what, Mesh& mesh) const {
    const Elements normals = attribute(primitive, "NORMAL", 3, 3, what, mesh);
    for (std::size_t i = 0; i < normals.count(); ++i)
      mesh.normals.push_back({normals.at(i)[0], normals.at(i)[1], normals.at(i)[2]});
  }

  /// Vertex colours are multiplied by the material's factor, both in linear light (section 3.9.2).
  void read_colours(const tinygltf::Primitive& primitive, const std::string& what, const ColourF& factor,
                    Mesh& mesh) const {
    mesh.base_colour = from_linear(factor);
    const Elements colours = attribute(primitive, "COLOR_0", 3, 4, what, mesh);
    for (std::size_t i = 0; i < colours.count(); ++i) {
      const float* c = colours.at(i);
      const ColourF vertex{double{c[0]}, double{c[1]}, double{c[2]}, colours.components == 4 ? double{c[3]} : 1.0};
      mesh.colours.push_back(from_linear(vertex * factor));
    }
  }

  void read_texture_coordinates(const tinygltf::Primitive& primitive, const std::string& what,
                                const GltfMaterial& material, Mesh& mesh) const {
    const Elements all = attribute(primitive, material.coordinates, 2, 2, what, mesh);
    for (std::size_t i = 0; i < all.count(); ++i)
      mesh.texture_coordinates.push_back(material.transform(double{all.at(i)[0]}, double{all.at(i)[1]}));
  }

  /// Attributes of the application (section 3.7.2.1: _NAME). Blender writes such an attribute of a mesh in capitals.
  void read_vertex_groups(const tinygltf::Primitive& primitive, const std::string& what, Mesh& mesh) const {
    constexpr float kIn = 0.5f;
    for (const auto& [name, accessor] : primitive.attributes) {
      if (!name.starts_with('_') || name.size() < 2 || accessor < 0 ||
          static_cast<std::size_t>(accessor) >= gltf_.accessors.size() ||
          gltf_.accessors[static_cast<std::size_t>(accessor)].type != TINYGLTF_TYPE_SCALAR)
        continue;
      const Elements weights = attribute(primitive, name, 1, 1, what, mesh);
      VertexGroup group{name.substr(1), {}};
      for (float w : weights.values) group.members.push_back(w > kIn ? 1 : 0);
      mesh.vertex_groups.push_back(std::move(group));
    }
  }

  void note_what_is_left_out() {
    auto note = [&](const std::string& text) { model_.notes.push_back(file_ + ": " + text); };
    for (const std::string& what : pointy_)
      note(what + " has points or lines, which are left out: drawing data hold faces");
    for (const std::string& what : positionless_) note(what + " has no positions and is left out");
    if (skinned_ > 0) note(fmt::format("{} skinned meshes stand as they were modelled", skinned_));
    if (morphed_ > 0) note(fmt::format("morph targets of {} meshes are left out", morphed_));
    if (!gltf_.animations.empty()) note(fmt::format("{} animations are left out", gltf_.animations.size()));
    for (std::size_t m = 0; m < placed_.size(); ++m)
      if (!placed_[m])
        note(described("mesh", m, gltf_.meshes[m].name) + " is not placed in the default scene and is left out");
  }

  std::string file_, stem_;
  const tinygltf::Model& gltf_;
  AccessorReader accessors_;
  Model model_;
  GltfMaterials materials_;
  std::vector<Tags> mesh_tags_, node_tags_;
  std::vector<bool> placed_;
  std::set<std::string> pointy_, positionless_;
  std::uint32_t placements_ = 0;
  std::size_t skinned_ = 0, morphed_ = 0;
};

}  // namespace

Model import_gltf(const fs::path& path, const GltfFile& file) {
  const tinygltf::Model gltf = parse(path, file);
  return GltfImporter(path, gltf).import();
}

}  // namespace usuzumi::sim
