// Meshes for tests and benchmarks, and what can be counted on a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hal/vec.h"

namespace usuzumi::testing {

/// An indexed triangle list that owns its memory. Attributes are empty or as long as `positions`.
struct Mesh {
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> indices;
  std::vector<PackedNormal> normals;
  std::vector<Rgba8> colours;
  std::vector<TexCoord> texture_coordinates;

  std::size_t face_count() const { return indices.size() / 3; }
};

/// 20 * 4^levels faces on the unit sphere, closed, facing outwards.
Mesh icosphere(int levels);
/// Two triangles per cell in the plane z = 0 over [0, columns] x [0, rows], facing +z.
Mesh grid(std::uint32_t columns, std::uint32_t rows);
/// The cube [0, n]^3 with n x n cells per side, welded, facing outwards.
Mesh cube(std::uint32_t n);
/// Every triangle into four by the middles of its edges; shared edges share the new vertex. Attributes are dropped.
Mesh subdivided(const Mesh& mesh);
/// The same surface with one wedge per face corner, each with its face's normal.
Mesh with_flat_normals(const Mesh& mesh);
/// Vertices of equal position become one, degenerate faces go, attributes are dropped.
Mesh welded(const Mesh& mesh);

struct MeshTopology {
  std::size_t vertices = 0;  // referenced ones, by position
  std::size_t edges = 0;
  std::size_t faces = 0;
  std::size_t border_edges = 0;        // of one face
  std::size_t non_manifold_edges = 0;  // of three or more faces
  std::size_t misoriented_edges = 0;   // of two faces that run along them the same way
  std::size_t degenerate_faces = 0;    // two corners at one position
  long euler() const { return static_cast<long>(vertices) - static_cast<long>(edges) + static_cast<long>(faces); }
};
/// Counted with vertices welded by position (-0 equals 0).
MeshTopology topology_of(const Mesh& mesh);

}  // namespace usuzumi::testing
