#include "sim/pack/prepare_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "sim/pack/texture_levels.h"
#include "sim/pack/textured.h"

namespace usuzumi::sim {
namespace {

using firmware::format::AlphaMode;

class Preparer {
 public:
  Preparer(Model& model, std::uint32_t most) : model_(model), most_(most) {
    old_textures_ = std::exchange(model.textures, {});
    old_materials_ = std::exchange(model.materials, {});
  }

  void take(std::optional<std::uint32_t>& material) {
    if (!material) return;
    Material used = old_materials_[*material];
    if (used.texture) used.texture = texture(*used.texture, used.alpha_mode != AlphaMode::kOpaque);
    material = material_number(model_, used);
  }

 private:
  std::uint32_t texture(std::uint32_t old, bool with_alpha) {
    const auto [at, fresh] = numbers_.try_emplace({old, with_alpha}, 0);
    if (fresh) at->second = stored(old, with_alpha);
    return at->second;
  }

  std::uint32_t stored(std::uint32_t old, bool with_alpha) {
    Picture picture = old_textures_[old];
    if (!with_alpha)
      for (Rgba8& c : picture.texels) c.bits |= 0xFF000000u;
    note_if_too_large(old);
    picture = fitted(picture, most_);
    for (std::uint32_t i = 0; i < model_.textures.size(); ++i) {
      const Picture& there = model_.textures[i];
      if (there.width == picture.width && there.height == picture.height && there.texels == picture.texels) return i;
    }
    model_.textures.push_back(std::move(picture));
    return static_cast<std::uint32_t>(model_.textures.size() - 1);
  }

  void note_if_too_large(std::uint32_t old) {
    constexpr std::uint32_t kMost = firmware::format::kMaxTextureSize;
    const Picture& p = old_textures_[old];
    if (std::max(p.width, p.height) > kMost && noted_.insert(old).second)
      model_.notes.push_back(
          fmt::format("texture {}: {}x{} texels are more than the {} each way that drawing data hold; "
                      "it is halved until it fits",
                      p.name, p.width, p.height, kMost));
  }

  Model& model_;
  std::uint32_t most_;
  std::vector<Picture> old_textures_;
  std::vector<Material> old_materials_;
  std::map<std::pair<std::uint32_t, bool>, std::uint32_t> numbers_;  // old texture and whether its alpha counts -> new
  std::set<std::uint32_t> noted_;
};

}  // namespace

void prepare_textures(Model& model, std::uint32_t most_texels) {
  Preparer preparer(model, most_texels);
  for (Mesh& mesh : model.meshes) {
    preparer.take(mesh.material);
    for (MeshPart& part : mesh.parts) preparer.take(part.material);
  }
}

}  // namespace usuzumi::sim
