#include "sim/pack/model_bytes.h"

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "sim/common/error.h"

namespace usuzumi::sim {
namespace {

/// One description of the layout serves both ways: Out writes a field, In reads it.
class Out {
 public:
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* p = reinterpret_cast<const std::byte*>(&v);
    bytes.insert(bytes.end(), p, p + sizeof v);
  }
  template <class Container>
  void array(const Container& items) {
    value(std::uint64_t{items.size()});
    const auto* p = reinterpret_cast<const std::byte*>(items.data());
    bytes.insert(bytes.end(), p, p + items.size() * sizeof(typename Container::value_type));
  }
  void count(const std::size_t& n) { value(std::uint64_t{n}); }
  std::vector<std::byte> bytes;
};

class In {
 public:
  In(std::span<const std::byte> bytes, const std::string& what) : bytes_(bytes), what_(what) {}
  template <class T>
  void value(T& v) {
    std::memcpy(&v, take(1, sizeof v), sizeof v);
  }
  template <class Container>
  void array(Container& items) {
    std::uint64_t n = 0;
    value(n);
    const std::byte* p = take(n, sizeof(typename Container::value_type));
    items.resize(n);
    if (n != 0) std::memcpy(items.data(), p, n * sizeof(typename Container::value_type));
  }
  /// Of things that take a byte each at least.
  void count(std::size_t& n) {
    std::uint64_t v = 0;
    value(v);
    if (v > bytes_.size()) fail();
    n = v;
  }
  bool at_end() const { return bytes_.empty(); }
  [[noreturn]] void fail() const {
    throw Error(ExitCode::kBadInput,
                what_ + ": the importer's result is garbled; the file is damaged: export it again");
  }

 private:
  const std::byte* take(std::uint64_t n, std::size_t size) {
    if (n > bytes_.size() / size) fail();
    const std::byte* p = bytes_.data();
    bytes_ = bytes_.subspan(n * size);
    return p;
  }
  std::span<const std::byte> bytes_;
  const std::string& what_;
};

template <class Stream, class Value>
void optional_value(Stream& s, std::optional<Value>& v) {
  std::uint8_t there = v.has_value();
  s.value(there);
  if (there != 0 && !v) v.emplace();
  if (there != 0) s.value(*v);
}

template <class Stream>
void optional_settings(Stream& s, std::optional<MethodSettings>& settings) {
  std::uint8_t there = settings.has_value();
  s.value(there);
  if (there == 0) return;
  if (!settings) settings.emplace();
  s.array(settings->preset);
  std::vector<std::pair<std::string, double>> values(settings->values.begin(), settings->values.end());
  std::size_t n = values.size();
  s.count(n);
  values.resize(n);
  for (auto& [name, value] : values) {
    s.array(name);
    s.value(value);
  }
  settings->values = {values.begin(), values.end()};
}

template <class Stream>
void optional_regions(Stream& s, std::optional<std::vector<EdgeRegion>>& regions) {
  std::uint8_t there = regions.has_value();
  s.value(there);
  if (there == 0) return;
  if (!regions) regions.emplace();
  std::size_t n = regions->size();
  s.count(n);
  regions->resize(n);
  for (EdgeRegion& region : *regions) {
    s.array(region.group);
    s.array(region.material);
    s.value(region.value);
  }
}

template <class Stream>
void optional_layers(Stream& s, std::optional<std::vector<std::uint32_t>>& layers) {
  std::uint8_t there = layers.has_value();
  s.value(there);
  if (there == 0) return;
  if (!layers) layers.emplace();
  s.array(*layers);
}

template <class Stream>
void mesh_fields(Stream& s, Mesh& mesh) {
  s.array(mesh.name);
  s.array(mesh.mesh_name);
  s.array(mesh.node_name);
  s.array(mesh.positions);
  s.array(mesh.normals);
  s.array(mesh.colours);
  s.array(mesh.texture_coordinates);
  s.array(mesh.indices);
  s.value(mesh.base_colour);
  std::uint8_t two_sided = mesh.two_sided;
  s.value(two_sided);
  mesh.two_sided = two_sided != 0;
  optional_value(s, mesh.material);
  s.array(mesh.material_name);
  std::size_t groups = mesh.vertex_groups.size();
  s.count(groups);
  mesh.vertex_groups.resize(groups);
  for (VertexGroup& group : mesh.vertex_groups) {
    s.array(group.name);
    s.array(group.members);
  }
  optional_value(s, mesh.tags.level);
  optional_value(s, mesh.tags.quota);
  optional_value(s, mesh.tags.area_threshold_px);
  optional_value(s, mesh.tags.telltale);
  optional_value(s, mesh.tags.method);
  optional_settings(s, mesh.tags.settings);
  optional_regions(s, mesh.tags.regions);
  optional_layers(s, mesh.tags.layers);
  s.value(mesh.placement);
}

template <class Stream>
void picture_fields(Stream& s, Picture& picture) {
  s.array(picture.name);
  s.value(picture.width);
  s.value(picture.height);
  s.array(picture.texels);
}

template <class Stream>
void material_fields(Stream& s, Material& material) {
  optional_value(s, material.texture);
  s.value(material.filter);
  s.value(material.wrap_s);
  s.value(material.wrap_t);
  s.value(material.alpha_mode);
  s.value(material.alpha_reference);
}

template <class Stream>
void lines(Stream& s, std::vector<std::string>& all) {
  std::size_t n = all.size();
  s.count(n);
  all.resize(n);
  for (std::string& line : all) s.array(line);
}

template <class Stream>
void model_fields(Stream& s, Model& model) {
  std::size_t meshes = model.meshes.size();
  s.count(meshes);
  model.meshes.resize(meshes);
  for (Mesh& mesh : model.meshes) mesh_fields(s, mesh);
  std::size_t textures = model.textures.size();
  s.count(textures);
  model.textures.resize(textures);
  for (Picture& picture : model.textures) picture_fields(s, picture);
  std::size_t materials = model.materials.size();
  s.count(materials);
  model.materials.resize(materials);
  for (Material& material : model.materials) material_fields(s, material);
  lines(s, model.part_files);
  lines(s, model.notes);
}

}  // namespace

std::vector<std::byte> model_to_bytes(const Model& model) {
  Out out;
  Model copy = model;  // one layout function for both directions takes a mutable model
  model_fields(out, copy);
  return std::move(out.bytes);
}

Model model_from_bytes(std::span<const std::byte> bytes, const std::string& what) {
  In in(bytes, what);
  Model model;
  model_fields(in, model);
  if (!in.at_end()) in.fail();
  return model;
}

}  // namespace usuzumi::sim
