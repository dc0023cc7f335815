#include "tests/study/subjects.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "sim/pack/join_parts.h"
#include "sim/pack/load_model.h"
#include "sim/pack/prepare_textures.h"
#include "tests/study/seam_shapes.h"

namespace usuzumi::study {
namespace {

constexpr const char* kTruck = "/usr/share/assimp/models/glTF/CesiumMilkTruck/CesiumMilkTruck.gltf";
constexpr std::uint32_t kCardTexels = 128;

// One mesh of these parts, each with a test card of its own.
sim::Model model_of(const std::string& name, const std::vector<TexturedPart>& parts) {
  sim::Model model;
  sim::Mesh mesh;
  mesh.name = mesh.mesh_name = name;
  mesh.base_colour = rgba8(255, 255, 255);
  for (std::uint32_t i = 0; i < parts.size(); ++i) {
    const TexturedPart& part = parts[i];
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
    mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
    mesh.texture_coordinates.insert(mesh.texture_coordinates.end(), part.coordinates.begin(), part.coordinates.end());
    for (const std::uint32_t v : part.indices) mesh.indices.push_back(first + v);

    sim::Picture card{name + std::to_string(i), kCardTexels, kCardTexels, {}};
    for (const std::uint32_t texel : test_card(kCardTexels, i))
      card.texels.push_back(rgba8(texel >> 16 & 255, texel >> 8 & 255, texel & 255));
    model.textures.push_back(std::move(card));
    sim::Material material;
    material.texture = i;
    material.wrap_s = material.wrap_t = command::TextureWrap::kClamp;
    model.materials.push_back(material);
    mesh.parts.push_back({mesh.face_count(), static_cast<std::uint32_t>(mesh.positions.size()), i, mesh.base_colour,
                          name + std::to_string(i)});
  }
  if (parts.size() == 1) {
    mesh.parts.clear();
    mesh.material = 0;
  }
  model.meshes.push_back(std::move(mesh));
  return model;
}

}  // namespace

sim::Model textured_cube() { return model_of("cube", six_sided_cube(12)); }

sim::Model textured_cylinder() { return model_of("cylinder", {creased_cylinder(24, 12, 6)}); }

std::optional<sim::Model> truck(std::uint32_t most_texels) {
  if (!std::filesystem::exists(kTruck)) {
    std::fprintf(stderr, "SKIPPED: truck: cannot read %s (install assimp-testmodels)\n", kTruck);
    return std::nullopt;
  }
  sim::Model model = sim::load_model(kTruck);
  const std::array<std::string, 1> all{"*"};
  sim::join_parts(model, all);
  sim::prepare_textures(model, most_texels);
  return model;
}

sim::Model earth() { return sim::load_model(USUZUMI_STUDY_EARTH); }

std::vector<Subject> subjects() {
  std::vector<Subject> all;
  all.push_back({"cube", textured_cube()});
  all.push_back({"cylinder", textured_cylinder()});
  if (auto model = truck()) all.push_back({"truck", *std::move(model)});
  all.push_back({"earth", earth()});
  return all;
}

}  // namespace usuzumi::study
