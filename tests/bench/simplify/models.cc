#include "tests/bench/simplify/models.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace usuzumi::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAssimpModels = "/usr/share/assimp/models";

std::string models_folder() {
  const char* folder = std::getenv("USUZUMI_MODELS");
  return folder != nullptr ? folder : USUZUMI_DEFAULT_MODELS;
}

// The path of the unpacked file, or an empty string.
std::string unpacked(const std::string& path, const std::string& cache) {
  const fs::path target = fs::path(cache) / fs::path(path).stem();
  if (fs::exists(target)) return target;
  fs::create_directories(cache);
  const std::string partial = target.string() + ".partial";
  const std::string command = "xz -dc '" + path + "' > '" + partial + "'";
  if (std::system(command.c_str()) != 0) return {};
  fs::rename(partial, target);
  return target;
}

}  // namespace

std::optional<testing::Mesh> load_model(const std::string& path, const std::string& cache) {
  if (!fs::exists(path)) return std::nullopt;
  const std::string file = path.ends_with(".xz") ? unpacked(path, cache) : path;
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file, aiProcess_Triangulate | aiProcess_PreTransformVertices);
  if (scene == nullptr) return std::nullopt;
  testing::Mesh joined;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    const auto base = static_cast<std::uint32_t>(joined.positions.size());
    for (unsigned v = 0; v < mesh.mNumVertices; ++v)
      joined.positions.push_back({mesh.mVertices[v].x, mesh.mVertices[v].y, mesh.mVertices[v].z});
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      if (mesh.mFaces[f].mNumIndices != 3) continue;
      for (unsigned k = 0; k < 3; ++k) joined.indices.push_back(base + mesh.mFaces[f].mIndices[k]);
    }
  }
  return testing::welded(joined);
}

std::vector<Model> load_models() {
  const std::string ours = models_folder();
  const std::string assimp = kAssimpModels;
  const std::pair<const char*, std::string> files[] = {
      {"nefertiti", ours + "/nefertiti-lowres.obj.xz"},
      {"spot", ours + "/spot.obj.xz"},
      {"fish", ours + "/fish.obj.xz"},
      {"sphere182", ours + "/sphere182.obj"},
      {"engine", assimp + "/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb"},
      {"truck", assimp + "/glTF/CesiumMilkTruck/CesiumMilkTruck.gltf"},
  };
  std::vector<Model> models;
  for (const auto& [name, path] : files) {
    if (auto mesh = load_model(path, USUZUMI_MODEL_CACHE); mesh && mesh->face_count() > 0) {
      models.push_back({name, *std::move(mesh)});
    } else {
      std::fprintf(stderr,
                   "SKIPPED: model %s: cannot read %s (set USUZUMI_MODELS; install assimp-testmodels and xz-utils)\n",
                   name, path.c_str());
    }
  }
  return models;
}

}  // namespace usuzumi::bench
