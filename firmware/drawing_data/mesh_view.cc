#include "firmware/drawing_data/mesh_view.h"

#include <cstddef>
#include <cstring>

namespace usuzumi::firmware {

EdgeRemovalSettings MeshView::edge_removal() const {
  EdgeRemovalSettings settings;
  if (method == Method::kEdgeRemoval && method_settings != nullptr)
    std::memcpy(&settings, method_settings, sizeof settings);
  return settings;
}

VertexDeletionSettings MeshView::vertex_deletion() const {
  VertexDeletionSettings settings;
  if (method == Method::kVertexDeletion && method_settings != nullptr)
    std::memcpy(&settings, method_settings, sizeof settings);
  return settings;
}

format::FaceGroup MeshView::group(std::uint32_t g) const {
  if (!groups.empty()) return groups[g];
  return {face_count(), static_cast<std::uint32_t>(positions.size()), material.number, base_colour.bits};
}

std::uint32_t MeshView::face_count() const {
  const auto vertices = static_cast<std::uint32_t>(positions.size());
  switch (topology) {
    case format::Topology::kStrip:
    case format::Topology::kFan: return vertices < 3 ? 0 : vertices - 2;
    case format::Topology::kList: return vertices / 3;
    case format::Topology::kIndexed: return index_count / 3;
  }
  return 0;
}

void MeshView::face(std::uint32_t f, std::uint32_t out[3]) const {
  switch (topology) {
    case format::Topology::kStrip:
      out[0] = f + (f & 1);
      out[1] = f + 1 - (f & 1);
      out[2] = f + 2;
      return;
    case format::Topology::kFan:
      out[0] = 0;
      out[1] = f + 1;
      out[2] = f + 2;
      return;
    case format::Topology::kList:
      for (std::uint32_t k = 0; k < 3; ++k) out[k] = 3 * f + k;
      return;
    case format::Topology::kIndexed:
      for (std::uint32_t k = 0; k < 3; ++k) {
        std::uint32_t index = 0;
        std::memcpy(&index, indices.data() + (3 * std::size_t{f} + k) * index_bytes, index_bytes);
        out[k] = index;
      }
      return;
  }
}

bool MeshView::proper_face(std::uint32_t f, std::uint32_t out[3]) const {
  face(f, out);
  const Vec3 &a = positions[out[0]], &b = positions[out[1]], &c = positions[out[2]];
  return a != b && b != c && c != a;
}

std::uint32_t MeshView::proper_face_count() const {
  std::uint32_t count = 0, corners[3];
  for (std::uint32_t f = 0; f < face_count(); ++f)
    if (proper_face(f, corners)) ++count;
  return count;
}

void MeshView::write_proper_faces(std::span<std::uint32_t> out, std::span<MaterialGroup> material_groups) const {
  std::uint32_t proper = 0, corners[3], g = 0;
  const auto end_groups_before = [&](std::uint32_t f) {
    for (; g < material_groups.size() && groups[g].face_end <= f; ++g)
      material_groups[g] = {proper, groups[g].vertex_end};
  };
  for (std::uint32_t f = 0; f < face_count(); ++f) {
    end_groups_before(f);
    if (!proper_face(f, corners)) continue;
    for (std::size_t k = 0; k < 3; ++k) out[std::size_t{3} * proper + k] = corners[k];
    ++proper;
  }
  end_groups_before(face_count());
}

}  // namespace usuzumi::firmware
