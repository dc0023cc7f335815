#include "sim/pack/assimp_material.h"

#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <vector>

#include "sim/pack/colour.h"
#include "sim/pack/textured.h"

namespace usuzumi::sim {
namespace {

namespace fs = std::filesystem;

command::TextureWrap wrap_of(aiTextureMapMode mode) {
  switch (mode) {
    case aiTextureMapMode_Clamp:
    case aiTextureMapMode_Decal: return command::TextureWrap::kClamp;
    case aiTextureMapMode_Mirror: return command::TextureWrap::kMirror;
    default: return command::TextureWrap::kRepeat;
  }
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool black(Rgba8 c) { return (c.bits & 0x00FFFFFFu) == 0; }

}  // namespace

AssimpMaterials::AssimpMaterials(const std::string& file, const aiScene& scene, Model& model)
    : file_(file), folder_(fs::path(file).parent_path()), scene_(scene), model_(model), shelf_(model, file) {}

bool AssimpMaterials::read(const aiMesh& source, Mesh& mesh) {
  if (source.mMaterialIndex >= scene_.mNumMaterials) return false;
  const aiMaterial& material = *scene_.mMaterials[source.mMaterialIndex];
  aiString name;
  if (material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) mesh.material_name = name.C_Str();
  aiColor4D diffuse(1, 1, 1, 1);
  material.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse);
  mesh.base_colour = from_display({double{diffuse.r}, double{diffuse.g}, double{diffuse.b}, double{diffuse.a}});
  if (material.GetTextureCount(aiTextureType_DIFFUSE) > 0) read_texture(material, source, mesh);
  int two_sided = 0;
  const bool sides_known = material.Get(AI_MATKEY_TWOSIDED, two_sided) == aiReturn_SUCCESS;
  mesh.two_sided = two_sided != 0;
  return sides_known;
}

void AssimpMaterials::read_texture(const aiMaterial& material, const aiMesh& source, Mesh& mesh) {
  aiString name;
  unsigned set = 0;
  std::array<aiTextureMapMode, 3> modes{aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
  if (material.GetTexture(aiTextureType_DIFFUSE, 0, &name, nullptr, &set, nullptr, nullptr, modes.data()) !=
      aiReturn_SUCCESS)
    return;
  Material out;
  out.texture = read_image(name.C_Str());
  if (!out.texture) return;
  out.wrap_s = wrap_of(modes[0]);
  out.wrap_t = wrap_of(modes[1]);
  mesh.material = material_number(model_, out);
  // An MTL file multiplies the texture by Kd; but some exporters leave Kd black where there is a texture.
  if (black(mesh.base_colour)) mesh.base_colour = rgba8(255, 255, 255);
  aiUVTransform transform;
  if (material.Get(AI_MATKEY_UVTRANSFORM(aiTextureType_DIFFUSE, 0), transform) == aiReturn_SUCCESS &&
      !(transform.mTranslation == aiVector2D(0, 0) && transform.mScaling == aiVector2D(1, 1) &&
        transform.mRotation == 0))
    shelf_.note(fmt::format("placed {}", name.C_Str()),
                fmt::format("{}: texture {} is moved, scaled or turned by its material, which is not read here; "
                            "apply it to the texture coordinates",
                            file_, name.C_Str()));
  if (set >= AI_MAX_NUMBER_OF_TEXTURECOORDS || source.mTextureCoords[set] == nullptr) return;
  // assimp's t runs up from the image's bottom, whatever the file.
  for (unsigned v = 0; v < source.mNumVertices; ++v)
    mesh.texture_coordinates.push_back({source.mTextureCoords[set][v].x, 1 - source.mTextureCoords[set][v].y});
}

std::optional<std::uint32_t> AssimpMaterials::read_image(const std::string& name) {
  if (scene_.GetEmbeddedTexture(name.c_str()) != nullptr) return read_embedded(name);
  return shelf_.from_file(find_beside(name));
}

std::optional<std::uint32_t> AssimpMaterials::read_embedded(const std::string& name) {
  const aiTexture& texture = *scene_.GetEmbeddedTexture(name.c_str());
  const std::string shown = texture.mFilename.length > 0 ? texture.mFilename.C_Str() : name;
  if (texture.mHeight != 0)  // texels, not a file
    return shelf_.refuse("embedded " + name, fmt::format("the texture '{}' inside it is not PNG or JPEG", shown),
                         "save it as PNG or JPEG and pack again");
  return shelf_.from_bytes("embedded " + name, shown,
                           std::as_bytes(std::span(reinterpret_cast<const char*>(texture.pcData), texture.mWidth)));
}

/// Files say where the texture lay on the computer that wrote them: with backslashes, from the root, in other case.
/// Where it is not there it may lie beside the model.
fs::path AssimpMaterials::find_beside(const std::string& name) const {
  std::string slashed = name;
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  const fs::path named = (folder_ / slashed).lexically_normal(), beside = folder_ / fs::path(slashed).filename();
  std::error_code none;
  for (const fs::path& path : {named, beside})
    if (fs::is_regular_file(path, none)) return path;
  std::vector<fs::path> alike;
  const fs::path folder = folder_.empty() ? fs::path(".") : folder_;
  for (fs::directory_iterator entry(folder, none), end; !none && entry != end; entry.increment(none))
    if (lower(entry->path().filename().string()) == lower(beside.filename().string()))
      alike.push_back(folder_ / entry->path().filename());
  return alike.empty() ? named : *std::min_element(alike.begin(), alike.end());
}

}  // namespace usuzumi::sim
