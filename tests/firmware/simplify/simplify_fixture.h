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

/// `mesh` thinned in what is left of `scratch`.
inline Thinned thin_in(Arena& scratch, const Mesh& mesh, const firmware::SimplifyOptions& options) {
  Thinned result;
  result.mesh = mesh;
  firmware::WorkingMesh working{.positions = result.mesh.positions,
                                .normals = result.mesh.normals,
                                .colours = result.mesh.colours,
                                .texture_coordinates = result.mesh.texture_coordinates,
                                .indices = result.mesh.indices,
                                .vertex_count = static_cast<std::uint32_t>(mesh.positions.size()),
                                .face_count = static_cast<std::uint32_t>(mesh.face_count())};
  const auto outcome = firmware::simplify(working, options, scratch);
  result.status = outcome.status();
  result.outcome = outcome.value();
  result.scratch_used = scratch.high_water();
  result.mesh.positions.resize(working.vertex_count);
  if (!mesh.normals.empty()) result.mesh.normals.resize(working.vertex_count);
  if (!mesh.colours.empty()) result.mesh.colours.resize(working.vertex_count);
  if (!mesh.texture_coordinates.empty()) result.mesh.texture_coordinates.resize(working.vertex_count);
  result.mesh.indices.resize(std::size_t{working.face_count} * 3);
  return result;
}

/// The same with exactly `scratch_bytes` of scratch (simplify_scratch_bytes by default).
inline Thinned thin(const Mesh& mesh, const firmware::SimplifyOptions& options, std::size_t scratch_bytes = 0) {
  std::vector<std::byte> memory(
      scratch_bytes != 0 ? scratch_bytes
                         : firmware::simplify_scratch_bytes(
                               options.method, static_cast<std::uint32_t>(mesh.positions.size()),
                               static_cast<std::uint32_t>(mesh.face_count()), !mesh.texture_coordinates.empty()));
  Arena scratch(memory);
  return thin_in(scratch, mesh, options);
}

/// By quadric error.
inline Thinned thin(const Mesh& mesh, std::uint32_t target_faces,
                    firmware::Placement placement = firmware::Placement::kOptimal, std::size_t scratch_bytes = 0) {
  return thin(mesh, {.target_faces = target_faces, .placement = placement}, scratch_bytes);
}

}  // namespace usuzumi::testing
