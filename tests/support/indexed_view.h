// A shape as drawing data would give it, without any ROM.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/drawing_data/mesh_view.h"
#include "tests/support/mesh_shapes.h"

namespace usuzumi::testing {

/// Of level 3, thinned by `method`; `mesh` outlives it.
inline firmware::MeshView indexed_view(const Mesh& mesh, firmware::Method method) {
  firmware::MeshView view;
  view.level = firmware::Level::kCollapse;
  view.topology = firmware::format::Topology::kIndexed;
  view.positions = mesh.positions;
  view.normals = mesh.normals;
  view.colours = mesh.colours;
  view.texture_coordinates = mesh.texture_coordinates;
  view.indices = std::as_bytes(std::span(mesh.indices));
  view.index_bytes = 4;
  view.index_count = static_cast<std::uint32_t>(mesh.indices.size());
  view.method = method;
  return view;
}

}  // namespace usuzumi::testing
