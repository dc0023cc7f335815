// Materials as assimp tells of them: OBJ's MTL files, COLLADA, AC3D, glTF 1.0.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "sim/pack/model.h"
#include "sim/pack/texture_shelf.h"

struct aiMaterial;
struct aiMesh;
struct aiScene;

namespace usuzumi::sim {

class AssimpMaterials {
 public:
  /// Textures and notes go into `model`. All must outlive this. `file` is the path as the user gave it.
  AssimpMaterials(const std::string& file, const aiScene& scene, Model& model);

  /// Material and texture coordinates of `source` into `mesh`. Whether the file says if both sides are drawn.
  bool read(const aiMesh& source, Mesh& mesh);

 private:
  void read_texture(const aiMaterial& material, const aiMesh& source, Mesh& mesh);
  std::optional<std::uint32_t> read_image(const std::string& name);
  std::optional<std::uint32_t> read_embedded(const std::string& name);
  std::filesystem::path find_beside(const std::string& name) const;

  const std::string& file_;
  std::filesystem::path folder_;
  const aiScene& scene_;
  Model& model_;
  TextureShelf shelf_;
};

}  // namespace usuzumi::sim
