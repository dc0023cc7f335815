// A surface on a small mesh, and the energies of its vertices.
#pragma once

#include <optional>
#include <vector>

#include "firmware/simplify/vertex_deletion/deletion_energy.h"
#include "firmware/simplify/vertex_deletion/ring.h"
#include "firmware/simplify/weld.h"
#include "firmware/simplify/working_surface.h"
#include "tests/support/mesh_shapes.h"

namespace usuzumi::testing {

class RingSurface {
 public:
  explicit RingSurface(const Mesh& given) : mesh_(given) {
    const auto vertices = static_cast<std::uint32_t>(mesh_.positions.size()),
               faces = static_cast<std::uint32_t>(mesh_.face_count());
    vertex_of_wedge_.resize(vertices);
    table_.resize(firmware::weld_table_slots(vertices));
    links_.resize(faces * 4);
    places_.resize(vertices);
    vertices_.resize(vertices);
    firmware::WorkingMesh working{.positions = mesh_.positions,
                                  .normals = mesh_.normals,
                                  .colours = mesh_.colours,
                                  .texture_coordinates = mesh_.texture_coordinates,
                                  .indices = mesh_.indices,
                                  .vertex_count = vertices,
                                  .face_count = faces};
    firmware::build_surface(working, {vertex_of_wedge_, table_, places_, vertices_, links_}, working_);
  }

  firmware::Surface& surface() { return working_.surface; }
  float scale() const { return working_.scale; }

  std::optional<firmware::Ring> ring(std::uint32_t v) const {
    firmware::Ring ring;
    if (!firmware::gather_ring(working_.surface, working_.attributes, v, ring)) return std::nullopt;
    return ring;
  }

  /// Of deleting `v`, with `mean_area` in squared model units; distances in model units.
  std::optional<firmware::Deletion> least(std::uint32_t v, const firmware::VertexDeletionSettings& settings,
                                          float mean_area, const firmware::TakenEdges* taken = nullptr) const {
    const auto around = ring(v);
    firmware::Deletion best;
    firmware::DeletionEnergy energy(working_.surface, working_.attributes.texture_coordinates, settings,
                                          mean_area * working_.scale * working_.scale);
    if (!around || !energy.least(*around, taken, best)) return std::nullopt;
    best.distance /= working_.scale;
    return best;
  }

 private:
  Mesh mesh_;
  std::vector<std::uint32_t> vertex_of_wedge_, table_, links_;
  std::vector<firmware::Place> places_;
  std::vector<firmware::Vertex> vertices_;
  firmware::WorkingSurface working_;
};

/// A closed ring around vertex 0, whose polygon is `polygon`, counter-clockwise seen from outside.
inline Mesh closed_ring(Vec3 vertex, const std::vector<Vec3>& polygon) {
  Mesh mesh;
  mesh.positions = {vertex};
  mesh.positions.insert(mesh.positions.end(), polygon.begin(), polygon.end());
  const auto n = static_cast<std::uint32_t>(polygon.size());
  for (std::uint32_t i = 0; i < n; ++i) mesh.indices.insert(mesh.indices.end(), {0, 1 + i, 1 + (i + 1) % n});
  return mesh;
}

/// An open ring around vertex 0: the last corner is not joined to the first.
inline Mesh open_ring(Vec3 vertex, const std::vector<Vec3>& polygon) {
  Mesh mesh = closed_ring(vertex, polygon);
  mesh.indices.resize(mesh.indices.size() - 3);
  return mesh;
}

}  // namespace usuzumi::testing
