// Several materials on one mesh: their border is kept like any other seam, and each keeps its own faces.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "firmware/simplify/simplify.h"
#include "tests/support/mesh_shapes.h"

namespace usuzumi::testing {
namespace {

using firmware::MaterialGroup;

struct TwoMaterials {
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> indices;
  std::array<MaterialGroup, 2> groups;
};

// A flat sheet of 16 x 16 cells; the faces left of x = 5 are of the first material, with vertices of their own.
TwoMaterials two_materials() {
  const Mesh sheet = grid(16, 16);
  TwoMaterials result;
  for (int g = 0; g < 2; ++g) {
    for (std::size_t f = 0; f < sheet.indices.size(); f += 3) {
      float right = 0;
      for (std::size_t k = 0; k < 3; ++k) right = std::max(right, sheet.positions[sheet.indices[f + k]].x);
      if ((right <= 5) != (g == 0)) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        result.indices.push_back(static_cast<std::uint32_t>(result.positions.size()));
        result.positions.push_back(sheet.positions[sheet.indices[f + k]]);
      }
    }
    result.groups[static_cast<std::size_t>(g)] = {static_cast<std::uint32_t>(result.indices.size() / 3),
                                                  static_cast<std::uint32_t>(result.positions.size())};
  }
  return result;
}

struct Counts {
  std::uint32_t faces, vertices;
};

Counts thin_to(TwoMaterials& mesh, std::uint32_t faces, firmware::Method method) {
  const auto vertices_in = static_cast<std::uint32_t>(mesh.positions.size());
  const auto faces_in = static_cast<std::uint32_t>(mesh.indices.size() / 3);
  firmware::WorkingMesh working{.positions = mesh.positions,
                                .groups = mesh.groups,
                                .indices = mesh.indices,
                                .vertex_count = vertices_in,
                                .face_count = faces_in};
  std::vector<std::byte> memory(firmware::simplify_scratch_bytes(method, vertices_in, faces_in, false));
  Arena scratch(memory);
  EXPECT_TRUE(firmware::simplify(working, {.target_faces = faces, .method = method}, scratch).ok());
  return {working.face_count, working.vertex_count};
}

struct Tested {
  firmware::Method method;
  double tolerance;  // of areas: methods that make no vertex keep them to the bit
};

TEST(MaterialGroups, BorderOfMaterialsStaysWhereItWasAndEachKeepsItsArea) {
  using firmware::Method;
  for (const auto [method, tolerance] : {Tested{Method::kQem, 0.1}, Tested{Method::kEdgeRemoval, 0},
                                         Tested{Method::kHalfEdge, 0}, Tested{Method::kVertexDeletion, 0}}) {
    for (const std::uint32_t target : {100u, 4u, 0u}) {
      SCOPED_TRACE(static_cast<int>(method) * 1000 + static_cast<int>(target));
      TwoMaterials mesh = two_materials();
      const Counts left = thin_to(mesh, target, method);
      EXPECT_LE(left.faces, std::max(target, 4u));
      EXPECT_EQ(mesh.groups[1].face_end, left.faces);
      EXPECT_EQ(mesh.groups[1].vertex_end, left.vertices);
      double area[2] = {0, 0};
      for (std::uint32_t f = 0; f < left.faces; ++f) {
        const std::size_t g = f < mesh.groups[0].face_end ? 0 : 1;
        const std::uint32_t* v = &mesh.indices[std::size_t{f} * 3];
        for (std::size_t k = 0; k < 3; ++k)
          ASSERT_EQ(v[k] < mesh.groups[0].vertex_end, g == 0) << "face " << f << " names the other material's vertex";
        const Vec3 p = mesh.positions[v[0]];
        area[g] += cross(mesh.positions[v[1]] - p, mesh.positions[v[2]] - p).z / 2;
      }
      if (target < 4) continue;  // there is no way then but to give up some
      EXPECT_NEAR(area[0], 5 * 16, tolerance);
      EXPECT_NEAR(area[1], 11 * 16, tolerance);
    }
  }
}

TEST(MaterialGroups, MeshWithinItsQuotaKeepsItsGroups) {
  TwoMaterials mesh = two_materials();
  const Counts left = thin_to(mesh, 100000, firmware::Method::kQem);
  EXPECT_EQ(left.faces, 512u);
  EXPECT_EQ(mesh.groups[0].face_end, 160u) << "5 of 16 columns";
  EXPECT_EQ(mesh.groups[1].face_end, 512u);
  EXPECT_EQ(left.vertices, 6u * 17 + 12u * 17) << "17 vertices on the border are there for both";
  EXPECT_EQ(mesh.groups[0].vertex_end, 6u * 17);
}

}  // namespace
}  // namespace usuzumi::testing
