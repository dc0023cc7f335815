#include "sim/pack/edge_regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "sim/common/error.h"
#include "sim/pack/names.h"

namespace usuzumi::sim {
namespace {

bool same_but_for_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

/// Sets `region`'s value at its vertices of `mesh`. False where it has none there.
bool set_values(Mesh& mesh, const EdgeRegion& region) {
  bool found = false;
  const auto set = [&](std::size_t first, std::size_t end) {
    std::fill(mesh.edge_values.begin() + static_cast<std::ptrdiff_t>(first),
              mesh.edge_values.begin() + static_cast<std::ptrdiff_t>(end), region.value);
    found = true;
  };
  if (!region.group.empty()) {
    for (const VertexGroup& group : mesh.vertex_groups)
      if (same_but_for_case(group.name, region.group))
        for (std::size_t v = 0; v < group.members.size(); ++v)
          if (group.members[v] != 0) set(v, v + 1);
    if (mesh.mesh_name == region.group || mesh.node_name == region.group) set(0, mesh.positions.size());
    return found;
  }
  if (mesh.parts.empty() && mesh.material_name == region.material) set(0, mesh.positions.size());
  std::size_t first = 0;
  for (const MeshPart& part : mesh.parts) {
    if (part.material_name == region.material) set(first, part.vertex_end);
    first = part.vertex_end;
  }
  return found;
}

/// Names that a region of this kind could have had in `mesh`.
void add_names(const Mesh& mesh, bool groups, std::vector<std::string>& names) {
  if (groups) {
    for (const VertexGroup& group : mesh.vertex_groups) names.push_back(group.name);
    names.push_back(mesh.mesh_name);
    if (!mesh.node_name.empty()) names.push_back(mesh.node_name);
    return;
  }
  if (!mesh.material_name.empty()) names.push_back(mesh.material_name);
  for (const MeshPart& part : mesh.parts) names.push_back(part.material_name);
}

[[noreturn]] void refuse(const Model& model, const EdgeRegion& region) {
  const bool group = !region.group.empty();
  const std::string& wanted = group ? region.group : region.material;
  std::vector<std::string> names;
  std::string first;
  for (const Mesh& mesh : model.meshes) {
    if (!mesh.tags.regions ||
        std::find(mesh.tags.regions->begin(), mesh.tags.regions->end(), region) == mesh.tags.regions->end())
      continue;
    add_names(mesh, group, names);
    if (first.empty()) first = mesh.name;
  }
  throw Error(ExitCode::kBadInput,
              fmt::format("mesh '{}': regions: no vertex is in a {} '{}'; {}", first, group ? "group" : "material",
                          wanted, names.empty() ? "it has none" : suggest(wanted, names)));
}

}  // namespace

void apply_regions(Model& model) {
  std::vector<EdgeRegion> wanted, found;
  for (Mesh& mesh : model.meshes) {
    if (!mesh.tags.regions) continue;
    mesh.edge_values.assign(mesh.positions.size(), 0.0f);
    for (const EdgeRegion& region : *mesh.tags.regions) {
      wanted.push_back(region);
      if (set_values(mesh, region)) found.push_back(region);
    }
    if (mesh.tags.method == firmware::Method::kEdgeRemoval) continue;
    mesh.edge_values.clear();
    model.notes.push_back(
        fmt::format("mesh '{}': regions are left out: only the method edge-removal looks at them", mesh.name));
  }
  for (const EdgeRegion& region : wanted)
    if (std::find(found.begin(), found.end(), region) == found.end()) refuse(model, region);
}

}  // namespace usuzumi::sim
