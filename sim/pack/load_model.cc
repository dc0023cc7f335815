#include "sim/pack/load_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "sim/common/error.h"
#include "sim/common/files.h"
#include "sim/common/progress.h"
#include "sim/pack/gltf_file.h"
#include "sim/pack/importers.h"
#include "sim/pack/isolate.h"
#include "sim/pack/model_bytes.h"
#include "sim/pack/names.h"
#include "sim/pack/normals.h"
#include "sim/pack/off_counts.h"
#include "sim/pack/textured.h"
#include "sim/pack/weld.h"

namespace usuzumi::sim {
namespace {

namespace fs = std::filesystem;

/// assimp names what is in glTF 1.0 by identifier, meshes with "-0", "-1" … for the primitives of one; people know them
/// by name.
void label_gltf1(const GltfFile& file, Model& model) {
  model.notes.insert(model.notes.end(), file.notes.begin(), file.notes.end());
  for (Mesh& mesh : model.meshes) {
    auto found = file.gltf1_meshes.find(mesh.mesh_name);
    if (found == file.gltf1_meshes.end())
      found = file.gltf1_meshes.find(mesh.mesh_name.substr(0, mesh.mesh_name.rfind('-')));
    if (found != file.gltf1_meshes.end()) {
      if (!found->second.name.empty()) mesh.mesh_name = found->second.name;
      mesh.tags = found->second.tags;
    }
    const auto material = file.gltf1_materials.find(mesh.material_name);
    if (material != file.gltf1_materials.end()) mesh.material_name = material->second;
    const auto node = file.gltf1_nodes.find(mesh.node_name);
    if (node == file.gltf1_nodes.end()) continue;
    if (!node->second.name.empty()) mesh.node_name = node->second.name;
    mesh.tags = merge_tags(node->second.tags, mesh.tags);
  }
}

/// Runs in the isolated process.
Model import_by_extension(const fs::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".off") check_off_counts(path);
  if (extension != ".gltf" && extension != ".glb") return import_assimp(path);
  const GltfFile file = open_gltf(path);
  Model model = file.version_major == 2 ? import_gltf(path, file) : import_assimp(path, &file);
  if (file.version_major == 1) label_gltf1(file, model);
  for (const auto& [name, bytes] : file.buffer_files) model.part_files.push_back((path.parent_path() / name).string());
  return model;
}

/// What every importer must deliver, checked where no importer can forget it.
void check_mesh(const std::string& file, const Mesh& mesh) {
  auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::kBadInput, fmt::format("{}: mesh '{}': {}; mend it in the modelling tool and export it again",
                                                 file, mesh.mesh_name, why));
  };
  const std::size_t vertices = mesh.positions.size();
  if (vertices >= firmware::format::kAbsent || mesh.indices.size() >= firmware::format::kAbsent)
    refuse("too many vertices or faces");
  for (std::size_t v = 0; v < vertices; ++v) {
    const Vec3& p = mesh.positions[v];
    if (!is_finite(p)) refuse(fmt::format("vertex {} has a coordinate that is infinite or no number", v));
    constexpr float kMost = firmware::kMaxCoordinate;
    if (std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) > kMost)
      refuse(fmt::format("vertex {} is at {:g} {:g} {:g}, and drawing data hold coordinates up to {:g}", v, p.x, p.y,
                         p.z, kMost));
  }
  for (std::uint32_t i : mesh.indices)
    if (i >= vertices) refuse(fmt::format("a face refers to vertex {} of {}", i, vertices));
  if (mesh.indices.size() % 3 != 0 || (!mesh.normals.empty() && mesh.normals.size() != vertices) ||
      (!mesh.colours.empty() && mesh.colours.size() != vertices) ||
      (!mesh.texture_coordinates.empty() && mesh.texture_coordinates.size() != vertices))
    refuse("its arrays do not belong together");
  for (const VertexGroup& group : mesh.vertex_groups)
    if (group.members.size() != vertices) refuse("a vertex group does not belong to it");
}

void check_materials(const std::string& file, const Model& model) {
  bool sound = true;
  for (const Picture& picture : model.textures)
    sound = sound && picture.width >= 1 && picture.height >= 1 &&
            picture.texels.size() == std::uint64_t{picture.width} * picture.height;
  for (const Material& material : model.materials)
    sound = sound && (!material.texture || *material.texture < model.textures.size());
  for (const Mesh& mesh : model.meshes) sound = sound && (!mesh.material || *mesh.material < model.materials.size());
  if (!sound) throw Error(ExitCode::kBadInput, file + ": its materials do not belong together; export it again");
}

/// From whatever the importer made to what the device draws.
void finish(const std::string& file, Model& model) {
  check_materials(file, model);
  for (Picture& picture : model.textures) picture.name = clean_name(picture.name);
  std::vector<Mesh> kept;
  std::uint64_t empty_faces = 0, meshes_with_empty_faces = 0;
  for (Mesh& mesh : model.meshes) {
    mesh.mesh_name = clean_name(mesh.mesh_name);
    mesh.node_name = clean_name(mesh.node_name);
    mesh.material_name = clean_name(mesh.material_name);
    for (VertexGroup& group : mesh.vertex_groups) group.name = clean_name(group.name);
    check_mesh(file, mesh);
  }
  settle_textures(file, model);
  for (Mesh& mesh : model.meshes) {
    drop_rounding_noise(mesh);
    const std::uint32_t empty = remove_faces_without_area(mesh);
    empty_faces += empty;
    if (empty > 0) ++meshes_with_empty_faces;
    if (mesh.indices.empty()) {
      model.notes.push_back(fmt::format("{}: mesh '{}' has no faces and is left out", file, mesh.mesh_name));
      continue;
    }
    complete_normals(mesh);
    weld_vertices(mesh);
    kept.push_back(std::move(mesh));
  }
  model.meshes = std::move(kept);
  if (empty_faces > 0)
    model.notes.push_back(
        fmt::format("{}: {} faces of {} meshes have two corners at one place; they draw nothing and are left out", file,
                    empty_faces, meshes_with_empty_faces));
  if (model.meshes.empty())
    throw Error(ExitCode::kBadInput,
                fmt::format("{}: no triangles in it{}; pack a model that has faces", file,
                            model.notes.empty() ? "" : " (" + model.notes.front().substr(file.size() + 2) + ")"));
}

}  // namespace

bool is_model_file_name(const fs::path& path) {
  const std::string extension = lower_extension(path);
  return !extension.empty() && fmt::format("{} ", kModelExtensions).find(extension + ' ') != std::string::npos;
}

Model load_model(const fs::path& path, const LoadOptions& options) {
  const std::string file = path.string();
  if (!is_model_file_name(path))
    throw Error(ExitCode::kBadInput,
                fmt::format("{}: not a model file that is read here; convert it to one of {}", file, kModelExtensions));
  std::error_code none;
  if (!fs::exists(path, none)) throw Error(ExitCode::kBadInput, fmt::format("{}: no such file; check the name", file));
  if (fs::is_directory(path, none))
    throw Error(ExitCode::kBadInput, fmt::format("{}: is a folder; name a model file in it", file));
  const std::vector<std::byte> bytes =
      run_isolated(file, options.time_limit, [&] { return model_to_bytes(import_by_extension(path)); });
  const Progress progress("preparing " + file);
  Model model = model_from_bytes(bytes, file);
  finish(file, model);
  make_names_unique(model);
  return model;
}

Model load_models(std::span<const fs::path> paths, const LoadOptions& options) {
  Model all;
  for (const fs::path& path : paths) append_model(all, load_model(path, options));
  make_names_unique(all);
  return all;
}

}  // namespace usuzumi::sim
