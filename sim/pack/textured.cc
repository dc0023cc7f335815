#include "sim/pack/textured.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace usuzumi::sim {
namespace {

using command::TextureWrap;
using firmware::format::AlphaMode;

/// Coordinates within this are left as the author made them. Arbitrary; a single tells 2^-20 of the image apart here.
constexpr float kNearEnough = 8;

/// Whole repeats (of a mirrored texture: pairs of them) that bring [low, high] closest to 0. Clamped coordinates stay.
float repeats_to_take_off(float low, float high, TextureWrap wrap) {
  if (wrap == TextureWrap::kClamp || (low >= -kNearEnough && high <= kNearEnough)) return 0;
  const float middle = low / 2 + high / 2;
  return wrap == TextureWrap::kMirror ? 2 * std::floor(middle / 2) : std::floor(middle);
}

struct Range {
  float low = 0, high = 0;
  void include(float v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
};

/// "" or why the mesh cannot have its texture.
std::string fault_of(Mesh& mesh, const Material& material) {
  if (mesh.texture_coordinates.empty()) return "has no texture coordinates for it; unwrap it";
  std::vector<bool> used(mesh.positions.size(), false);
  for (std::uint32_t i : mesh.indices) used[i] = true;
  Range s{mesh.texture_coordinates[mesh.indices[0]].s, mesh.texture_coordinates[mesh.indices[0]].s};
  Range t{mesh.texture_coordinates[mesh.indices[0]].t, mesh.texture_coordinates[mesh.indices[0]].t};
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    TexCoord& c = mesh.texture_coordinates[v];
    if (!used[v]) c = {};
    if (!used[v]) continue;
    if (!std::isfinite(c.s) || !std::isfinite(c.t))
      return fmt::format("has a texture coordinate at vertex {} that is infinite or no number; unwrap it anew", v);
    s.include(c.s);
    t.include(c.t);
  }
  const float off_s = repeats_to_take_off(s.low, s.high, material.wrap_s),
              off_t = repeats_to_take_off(t.low, t.high, material.wrap_t);
  constexpr float kMost = firmware::kMaxTextureCoordinate;
  if (!(std::max({off_s - s.low, s.high - off_s, off_t - t.low, t.high - off_t}) <= kMost))
    return fmt::format(
        "has texture coordinates from {:g} {:g} to {:g} {:g}, and drawing data hold up to {:g}; "
        "scale them down or split the mesh",
        s.low, t.low, s.high, t.high, kMost);
  if (off_s != 0 || off_t != 0)
    for (TexCoord& c : mesh.texture_coordinates) c = {c.s - off_s, c.t - off_t};
  return "";
}

void take_texture_off(Model& model, Mesh& mesh) {
  const AlphaMode alpha = model.materials[*mesh.material].alpha_mode;
  const std::uint32_t reference = model.materials[*mesh.material].alpha_reference;
  mesh.material.reset();
  if (alpha == AlphaMode::kOpaque) return;
  Material plain;
  plain.alpha_mode = alpha;
  plain.alpha_reference = reference;
  mesh.material = material_number(model, plain);
}

}  // namespace

std::uint32_t material_number(Model& model, const Material& material) {
  const auto found = std::find(model.materials.begin(), model.materials.end(), material);
  if (found == model.materials.end()) {
    model.materials.push_back(material);
    return static_cast<std::uint32_t>(model.materials.size() - 1);
  }
  return static_cast<std::uint32_t>(found - model.materials.begin());
}

void settle_textures(const std::string& file, Model& model) {
  for (Mesh& mesh : model.meshes) {
    const bool textured = mesh.material && model.materials[*mesh.material].texture;
    if (textured && !mesh.indices.empty()) {
      const Material material = model.materials[*mesh.material];
      const std::string fault = fault_of(mesh, material);
      if (fault.empty()) continue;
      model.notes.push_back(fmt::format("{}: mesh '{}' has the texture {} and {}; it is packed without texture", file,
                                        mesh.mesh_name, model.textures[*material.texture].name, fault));
      take_texture_off(model, mesh);
    }
    mesh.texture_coordinates.clear();
  }
}

void append_model(Model& all, Model&& more) {
  const auto first_texture = static_cast<std::uint32_t>(all.textures.size());
  std::vector<std::uint32_t> numbers;
  for (Material material : more.materials) {
    if (material.texture) *material.texture += first_texture;
    numbers.push_back(material_number(all, material));
  }
  std::uint32_t first_placement = 0;
  for (const Mesh& mesh : all.meshes) first_placement = std::max(first_placement, mesh.placement + 1);
  for (Mesh& mesh : more.meshes) {
    if (mesh.material) mesh.material = numbers[*mesh.material];
    mesh.placement += first_placement;
  }
  const auto move_all = [](auto& from, auto& to) { std::move(from.begin(), from.end(), std::back_inserter(to)); };
  move_all(more.meshes, all.meshes);
  move_all(more.textures, all.textures);
  move_all(more.notes, all.notes);
  move_all(more.part_files, all.part_files);
  if (more.solids.empty()) return;
  move_all(more.solids, all.solids);
  all.view_candidates = std::move(more.view_candidates);
  all.solid_detail = more.solid_detail;
}

}  // namespace usuzumi::sim
