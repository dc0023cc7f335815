// glTF 2.0 materials: what of them the device can draw.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/pack/colour.h"
#include "sim/pack/model.h"
#include "sim/pack/texture_shelf.h"
#include "sim/pack/tinygltf.h"

namespace usuzumi::sim {

/// KHR_texture_transform: scale, then turn by `rotation`, then move.
struct TextureTransform {
  double offset[2] = {0, 0}, scale[2] = {1, 1};
  double rotation = 0;  // radians

  /// Counter-clockwise as one sees the image, whose t axis runs down: the extension's example (the lower left quarter,
  /// turned) comes out right only so; its GLSL has the sines the other way.
  TexCoord operator()(double s, double t) const;
};

struct GltfMaterial {
  ColourF factor;  // base colour, linear light
  bool two_sided = false;
  std::string name;
  Material material;
  std::string coordinates;  // attribute of the texture's coordinates: "TEXCOORD_0"
  TextureTransform transform;

  /// Whether drawing data must say more than the base colour.
  bool needed() const { return material.texture || material.alpha_mode != firmware::format::AlphaMode::kOpaque; }
};

class GltfMaterials {
 public:
  /// Textures go into `model`. All must outlive this.
  GltfMaterials(const std::filesystem::path& path, const std::string& file, const tinygltf::Model& gltf, Model& model);

  /// Material `index` of the file, or glTF's default where it is below 0. Throws Error kBadInput where `what` uses one
  /// that does not exist.
  GltfMaterial read(int index, const std::string& what);

 private:
  /// A texture reference: textureInfo of section 5.30.
  struct TextureUse {
    int index = -1;
    int set = 0;
    TextureTransform transform;
  };

  [[noreturn]] void refuse(const std::string& why) const;
  void read_older(const tinygltf::Value& older, GltfMaterial& out, TextureUse& use) const;
  void read_texture(const TextureUse& use, GltfMaterial& out);
  std::optional<std::uint32_t> read_image(int index);
  void read_alpha(const tinygltf::Material& source, Material& out) const;
  void read_sampler(int index, Material& out) const;

  std::filesystem::path folder_;
  const std::string& file_;
  const tinygltf::Model& gltf_;
  TextureShelf shelf_;
};

}  // namespace usuzumi::sim
