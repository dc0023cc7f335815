// Runs the thinning on a test mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "firmware/simplify/simplify.h"
#include "tests/support/mesh_shapes.h"

namespace usuzumi::testing {

struct Thinned {
  Mesh mesh;
  Status status;
  firmware::SimplifyOutcome outcome;
  std::size_t scratch_used = 0;
};

/// `mesh` thinned with exactly `scratch_bytes` of scratch (simplify_scratch_bytes by default).
inline Thinned thin(const Mesh& mesh, const firmware::SimplifyOptions& options, std::size_t scratch_bytes = 0) {
  Thinned result;
  result.mesh = mesh;
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  const auto faces = static_cast<std::uint32_t>(mesh.face_count());
  std::vector<std::byte> memory(
      scratch_bytes != 0 ? scratch_bytes
                         : firmware::simplify_scratch_bytes(options.method, vertices, faces,
                                                            !mesh.texture_coordinates.empty()));
  Arena scratch(memory);
  firmware::WorkingMesh working{.positions = result.mesh.positions,
                                .normals = result.mesh.normals,
                                .colours = result.mesh.colours,
                                .texture_coordinates = result.mesh.texture_coordinates,
                                .indices = result.mesh.indices,
                                .vertex_count = vertices,
                                .face_count = faces};
  const auto outcome = firmware::simplify(working, options, scratch);
  result.status = outcome.status();
  result.outcome = outcome.value();
  result.scratch_used = scratch.high_water();
  if (outcome.ok()) {
    result.mesh.positions.resize(working.vertex_count);
    if (!mesh.normals.empty()) result.mesh.normals.resize(working.vertex_count);
    if (!mesh.colours.empty()) result.mesh.colours.resize(working.vertex_count);
    if (!mesh.texture_coordinates.empty()) result.mesh.texture_coordinates.resize(working.vertex_count);
    result.mesh.indices.resize(std::size_t{working.face_count} * 3);
  }
  return result;
}

/// By quadric error.
inline Thinned thin(const Mesh& mesh, std::uint32_t target_faces,
                    firmware::Placement placement = firmware::Placement::kOptimal, std::size_t scratch_bytes = 0) {
  return thin(mesh, {.target_faces = target_faces, .placement = placement}, scratch_bytes);
}

}  // namespace usuzumi::testing
