#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cstddef>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "sim/common/error.h"
#include "sim/pack/assimp_material.h"
#include "sim/pack/colour.h"
#include "sim/pack/importers.h"
#include "sim/pack/normals.h"
#include "sim/pack/text.h"
#include "sim/pack/transform.h"

namespace usuzumi::sim {
namespace {

namespace fs = std::filesystem;

Transform to_transform(const aiMatrix4x4& m) {
  Transform t;
  const float rows[3][4] = {{m.a1, m.a2, m.a3, m.a4}, {m.b1, m.b2, m.b3, m.b4}, {m.c1, m.c2, m.c3, m.c4}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j) t.m[i][j] = double{rows[i][j]};
  return t;
}

/// Names of the file's. What assimp puts where a file has none looks like "<OFFRoot>", or is "defaultobject".
std::string real_name(const aiString& name) {
  const std::string text = name.C_Str();
  const bool made_up = (text.size() >= 2 && text.front() == '<' && text.back() == '>') || text == "defaultobject";
  return made_up ? "" : text;
}

Vec3 to_vec3(const aiVector3D& v) { return {v.x, v.y, v.z}; }

class AssimpScene {
 public:
  AssimpScene(const fs::path& path, const aiScene& scene, const GltfFile* gltf1)
      : gltf1_(gltf1),
        file_(path.string()),
        stem_(path.stem().string()),
        scene_(scene),
        materials_(file_, scene, model_) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    // STL repeats its facets' normals at every corner, so that each edge would be a border; faces tell the same.
    facet_normals_only_ = extension == ".stl";
  }

  Model import() {
    struct Visit {
      const aiNode* node;
      Transform parent;
    };
    std::vector<Visit> stack;
    if (scene_.mRootNode != nullptr) stack.push_back({scene_.mRootNode, Transform{}});
    while (!stack.empty()) {
      const Visit visit = stack.back();
      stack.pop_back();
      const Transform world = visit.parent * local_transform(*visit.node);
      if (!world.finite())
        refuse(fmt::format("node '{}' has a transform that is not finite", visit.node->mName.C_Str()));
      ++placements_;
      for (unsigned i = 0; i < visit.node->mNumMeshes; ++i) add_mesh(visit.node->mMeshes[i], *visit.node, world);
      for (unsigned i = visit.node->mNumChildren; i-- > 0;) stack.push_back({visit.node->mChildren[i], world});
    }
    note_what_is_left_out();
    return std::move(model_);
  }

 private:
  Transform local_transform(const aiNode& node) const {
    if (gltf1_ != nullptr) {
      const auto label = gltf1_->gltf1_nodes.find(node.mName.C_Str());
      if (label != gltf1_->gltf1_nodes.end() && label->second.local) return *label->second.local;
    }
    return to_transform(node.mTransformation);
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ExitCode::kBadInput, fmt::format("{}: {}; export it again, best as .glb", file_, why));
  }

  void add_mesh(unsigned index, const aiNode& node, const Transform& world) {
    if (index >= scene_.mNumMeshes) refuse(fmt::format("a node refers to mesh {} of {}", index, scene_.mNumMeshes));
    const aiMesh& source = *scene_.mMeshes[index];
    Mesh mesh;
    mesh.node_name = real_name(node.mName);
    const std::string mesh_name = real_name(source.mName);
    mesh.mesh_name = !mesh_name.empty() ? mesh_name : (!mesh.node_name.empty() ? mesh.node_name : stem_);
    read_faces(source, mesh);
    if (mesh.indices.empty()) return;
    read_vertices(source, mesh);
    // Most of these formats cannot say it. A closed surface shows its outside only; an open one may show both sides.
    if (!materials_.read(source, mesh)) mesh.two_sided = has_open_border(mesh);
    mesh.placement = placements_;
    apply(world, mesh);
    model_.meshes.push_back(std::move(mesh));
    if (model_.meshes.size() > firmware::format::kMaxMeshes)
      throw Error(ExitCode::kBadInput,
                  fmt::format("{}: more than {} meshes, which is more than drawing data hold; join some", file_,
                              firmware::format::kMaxMeshes));
  }

  void read_faces(const aiMesh& source, Mesh& mesh) {
    for (unsigned f = 0; f < source.mNumFaces; ++f) {
      const aiFace& face = source.mFaces[f];
      if (face.mNumIndices != 3) {
        ++points_and_lines_;
        continue;
      }
      for (unsigned k = 0; k < 3; ++k) {
        if (face.mIndices[k] >= source.mNumVertices)
          refuse(fmt::format("mesh '{}' refers to vertex {} of {}", mesh.mesh_name, face.mIndices[k],
                             source.mNumVertices));
        mesh.indices.push_back(face.mIndices[k]);
      }
    }
  }

  void read_vertices(const aiMesh& source, Mesh& mesh) const {
    if (source.mVertices == nullptr) refuse(fmt::format("mesh '{}' has faces but no vertices", mesh.mesh_name));
    for (unsigned v = 0; v < source.mNumVertices; ++v) {
      mesh.positions.push_back(to_vec3(source.mVertices[v]));
      if (source.mNormals != nullptr && !facet_normals_only_) mesh.normals.push_back(to_vec3(source.mNormals[v]));
      if (source.mColors[0] != nullptr) {
        const aiColor4D& c = source.mColors[0][v];
        mesh.colours.push_back(from_display({double{c.r}, double{c.g}, double{c.b}, double{c.a}}));
      }
    }
  }

  void note_what_is_left_out() {
    auto note = [&](const std::string& text) { model_.notes.push_back(file_ + ": " + text); };
    if (points_and_lines_ > 0)
      note(fmt::format("{} points and lines are left out: drawing data hold faces", points_and_lines_));
    if (scene_.mNumAnimations > 0) note(fmt::format("{} animations are left out", scene_.mNumAnimations));
  }

  const GltfFile* gltf1_;
  std::string file_, stem_;
  const aiScene& scene_;
  bool facet_normals_only_ = false;
  Model model_;
  AssimpMaterials materials_;
  std::uint32_t placements_ = 0;
  std::size_t points_and_lines_ = 0;
};

}  // namespace

Model import_assimp(const fs::path& path, const GltfFile* gltf1) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES,
                           true);  // names as people gave them, not identifiers
  // assimp's own validation would refuse a whole file for one empty mesh; what it checks is checked here.
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_Triangulate);
  if (scene == nullptr) {
    const std::string why = importer.GetErrorString();
    if (why.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
    throw Error(ExitCode::kBadInput,
                fmt::format("{}: cannot be read: {}; export it again, best as .glb", path.string(), one_line(why)));
  }
  return AssimpScene(path, *scene, gltf1).import();
}

}  // namespace usuzumi::sim
