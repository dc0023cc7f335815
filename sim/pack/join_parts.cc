#include "sim/pack/join_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "sim/common/error.h"
#include "sim/pack/names.h"

namespace usuzumi::sim {
namespace {

/// Appends `more`, of `count` items or none, behind `before` items; where only one has any, `filler` stands for the
/// other's.
template <class T>
void append(std::vector<T>& all, std::size_t before, const std::vector<T>& more, std::size_t count, T all_filler,
            T more_filler) {
  if (all.empty() && more.empty()) return;
  if (all.empty()) all.assign(before, all_filler);
  if (more.empty()) all.insert(all.end(), count, more_filler);
  else all.insert(all.end(), more.begin(), more.end());
}

void append_groups(Mesh& all, std::size_t before, const Mesh& more) {
  for (VertexGroup& group : all.vertex_groups) group.members.resize(before + more.positions.size(), 0);
  for (const VertexGroup& group : more.vertex_groups) {
    auto at = std::find_if(all.vertex_groups.begin(), all.vertex_groups.end(),
                           [&](const VertexGroup& g) { return g.name == group.name; });
    if (at == all.vertex_groups.end()) {
      all.vertex_groups.push_back({group.name, std::vector<std::uint8_t>(before + more.positions.size(), 0)});
      at = all.vertex_groups.end() - 1;
    }
    std::copy(group.members.begin(), group.members.end(), at->members.begin() + static_cast<std::ptrdiff_t>(before));
  }
}

void add_part(Mesh& all, const Mesh& more) {
  const std::size_t before = all.positions.size(), count = more.positions.size();
  const Rgba8 before_colour = all.base_colour;
  append(all.normals, before, more.normals, count, Vec3{0, 0, 1}, Vec3{0, 0, 1});
  if (all.colours.empty() && !more.colours.empty()) {  // parts so far had a base colour each
    std::size_t v = 0;
    for (const MeshPart& part : all.parts)
      for (; v < part.vertex_end; ++v) all.colours.push_back(part.base_colour);
  }
  append(all.colours, before, more.colours, count, before_colour, more.base_colour);
  append(all.texture_coordinates, before, more.texture_coordinates, count, TexCoord{}, TexCoord{});
  append_groups(all, before, more);
  all.positions.insert(all.positions.end(), more.positions.begin(), more.positions.end());
  for (std::uint32_t i : more.indices) all.indices.push_back(i + static_cast<std::uint32_t>(before));
  all.two_sided = all.two_sided || more.two_sided;
  all.parts.push_back({all.face_count(), static_cast<std::uint32_t>(all.positions.size()), more.material,
                       more.base_colour, more.material_name});
}

Mesh joined(std::span<Mesh* const> meshes) {
  Mesh all = *meshes.front();
  all.parts.push_back({all.face_count(), static_cast<std::uint32_t>(all.positions.size()), all.material,
                       all.base_colour, all.material_name});
  all.material.reset();
  all.material_name.clear();
  for (const Mesh* mesh : meshes.subspan(1)) add_part(all, *mesh);
  return all;
}

/// Meshes that the patterns mean, and that every pattern means one.
std::vector<bool> wanted(const Model& model, std::span<const std::string> patterns) {
  std::vector<bool> wanted(model.meshes.size(), false);
  for (const std::string& pattern : patterns) {
    bool used = false;
    std::vector<std::string> names;
    for (std::size_t m = 0; m < model.meshes.size(); ++m) {
      names.push_back(model.meshes[m].name);
      if (!matches_mesh(pattern, model.meshes[m])) continue;
      wanted[m] = used = true;
    }
    if (!used)
      throw Error(ExitCode::kUsage,
                  fmt::format("--join {}: no mesh is named so; {}", pattern, suggest(pattern, names)));
  }
  return wanted;
}

}  // namespace

void join_parts(Model& model, std::span<const std::string> patterns) {
  if (patterns.empty()) return;
  const std::vector<bool> joins = wanted(model, patterns);
  std::vector<Mesh> out;
  bool any = false;
  for (std::size_t m = 0; m < model.meshes.size();) {
    std::vector<Mesh*> together{&model.meshes[m]};
    std::size_t end = m + 1;
    for (; joins[m] && end < model.meshes.size() && joins[end] &&
           model.meshes[end].placement == model.meshes[m].placement;
         ++end)
      together.push_back(&model.meshes[end]);
    any = any || together.size() > 1;
    out.push_back(together.size() > 1 ? joined(together) : std::move(model.meshes[m]));
    m = end;
  }
  model.meshes = std::move(out);
  make_names_unique(model);
  if (!any) model.notes.push_back("--join joins nothing: no mesh that it names has several primitives");
}

}  // namespace usuzumi::sim
