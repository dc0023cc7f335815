// Which vertices of the mesh as given are left: what lets a thinned mesh be drawn with vertices that lie elsewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "firmware/simplify/simplify.h"
#include "tests/support/mesh_shapes.h"

namespace usuzumi::testing {
namespace {

std::vector<std::uint32_t> sources_of(Mesh mesh, std::uint32_t faces, firmware::Method method, Mesh& left) {
  const auto vertices_in = static_cast<std::uint32_t>(mesh.positions.size());
  const auto faces_in = static_cast<std::uint32_t>(mesh.indices.size() / 3);
  std::vector<std::uint32_t> sources(vertices_in, 0xDEADBEEF);
  firmware::WorkingMesh working{.positions = mesh.positions,
                                .indices = mesh.indices,
                                .vertex_count = vertices_in,
                                .face_count = faces_in,
                                .source_vertices = sources};
  std::vector<std::byte> memory(firmware::simplify_scratch_bytes(method, vertices_in, faces_in, false));
  Arena scratch(memory);
  EXPECT_TRUE(firmware::simplify(working, {.target_faces = faces, .method = method}, scratch).ok());
  sources.resize(working.vertex_count);
  mesh.positions.resize(working.vertex_count);
  left = mesh;
  return sources;
}

TEST(SourceVertices, OfAMeshWithinItsQuotaAreThoseThatItsFacesUse) {
  Mesh square;  // vertex 1 is nobody's, vertex 4 lies where vertex 2 does and is welded to it
  square.positions = {{0, 0, 0}, {9, 9, 9}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
  square.indices = {0, 2, 3, 3, 4, 5};
  Mesh left;
  EXPECT_EQ(sources_of(square, 2, firmware::Method::kQem, left), (std::vector<std::uint32_t>{0, 2, 3, 5}));
  EXPECT_EQ(left.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
}

TEST(SourceVertices, RiseAndAreAsManyAsVerticesAreLeft) {
  const Mesh sheet = grid(8, 8);
  Mesh left;
  const auto sources = sources_of(sheet, 40, firmware::Method::kQem, left);
  EXPECT_LT(sources.size(), sheet.positions.size());
  EXPECT_TRUE(std::is_sorted(sources.begin(), sources.end(), std::less_equal<>()));
  EXPECT_LT(sources.back(), sheet.positions.size());
}

}  // namespace
}  // namespace usuzumi::testing
