#include "firmware/thinning/whole_mesh.h"

#include "firmware/thinning/block_writer.h"
#include "firmware/thinning/normals.h"
#include "hal/arena.h"

namespace usuzumi::firmware {
namespace {

command::Topology engine_topology(format::Topology topology) {
  switch (topology) {
    case format::Topology::kStrip: return command::Topology::kTriangleStrip;
    case format::Topology::kFan: return command::Topology::kTriangleFan;
    case format::Topology::kList:
    case format::Topology::kIndexed: break;
  }
  return command::Topology::kTriangles;
}

/// Appends normals made from the mesh's own faces, where RAM has room to make them; the mesh is drawn unlit otherwise.
std::uint32_t append_made_normals(const MeshView& mesh, std::uint32_t faces, BlockWriter& block) {
  Arena scratch(block.rest());
  const auto normals = scratch.allocate<PackedNormal>(mesh.positions.size());
  const auto indices = scratch.allocate<std::uint32_t>(std::size_t{3} * faces);
  if (normals.empty() || indices.empty()) return kNoStream;
  mesh.write_proper_faces(indices);
  if (!make_smooth_normals(mesh.positions, indices, normals, scratch)) return kNoStream;
  return block.append(std::span<const PackedNormal>(normals));
}

float distance_squared(Vec3 a, Vec3 b) { return dot(a - b, a - b); }

/// The vertex nearest to (or farthest from) a place; the lowest number among equals.
std::uint32_t extreme_vertex(std::span<const Vec3> positions, Vec3 place, bool nearest) {
  std::uint32_t best = 0;
  float best_distance = distance_squared(positions[0], place);
  for (std::uint32_t v = 1; v < positions.size(); ++v) {
    const float d = distance_squared(positions[v], place);
    if (nearest ? d < best_distance : d > best_distance) {
      best = v;
      best_distance = d;
    }
  }
  return best;
}

Vec3 mean(std::span<const Vec3> positions) {
  double x = 0, y = 0, z = 0;
  for (const Vec3& p : positions) {
    x += double{p.x};
    y += double{p.y};
    z += double{p.z};
  }
  const auto n = static_cast<double>(positions.size());
  return {static_cast<float>(x / n), static_cast<float>(y / n), static_cast<float>(z / n)};
}

std::uint32_t group_of(const MeshView& mesh, std::uint32_t vertex) {
  std::uint32_t g = 0;
  while (g + 1 < mesh.group_count() && vertex >= mesh.group(g).vertex_end) ++g;
  return g;
}

}  // namespace

std::uint32_t vertex_bytes(const MeshView& mesh, bool normals) {
  return static_cast<std::uint32_t>(sizeof(Vec3) + (normals ? sizeof(PackedNormal) : 0) +
                                    (mesh.colours.empty() ? 0 : sizeof(Rgba8)) +
                                    (mesh.textured ? sizeof(TexCoord) : 0));
}

CopyMesh described(const MeshView& mesh) {
  CopyMesh copy;
  copy.two_sided = mesh.two_sided();
  return copy;
}

bool copy_as_is(const MeshView& mesh, std::uint32_t faces, RamCopy& copy, Clock& clock) {
  BlockWriter block(copy.free_memory());
  CopyMesh out = described(mesh);
  out.topology = engine_topology(mesh.topology);
  out.vertex_count = static_cast<std::uint32_t>(mesh.positions.size());
  out.faces = faces;
  block.append(mesh.positions);
  out.normal_offset = block.append(mesh.normals);
  out.colour_offset = block.append(mesh.colours);
  if (mesh.textured) out.texture_coordinate_offset = block.append(mesh.texture_coordinates);
  if (mesh.topology == format::Topology::kIndexed) {
    out.index_format = mesh.index_bytes == 2 ? command::IndexFormat::kU16 : command::IndexFormat::kU32;
    out.index_count = mesh.index_count;
    out.index_offset = block.append(mesh.indices);
    if (out.index_offset == kNoStream) out.index_offset = 0;  // no faces: the empty stream may stand anywhere
  }
  if (!block.full() && mesh.normals.empty() && faces > 0)
    out.normal_offset = append_made_normals(mesh, faces, block);
  if (block.full()) return false;
  clock.charge(CpuWork::kVertexCopied, out.vertex_count);
  clock.charge(CpuWork::kIndexCopied, out.index_count);
  copy.add(mesh.number, out, block.bytes());
  return true;
}

/// The vertex nearest to the middle as a point; the one farthest from the middle and the one
/// farthest from that as a line, which lies along the mesh's length. Without normals, so that no light falls on them: a
/// point has no facing, and the chance one of its vertex would leave the mark dark or bright as the camera goes round.
bool keep_vertices(const MeshView& mesh, Action action, RamCopy& copy, Clock& clock) {
  std::uint32_t kept[2];
  const Vec3 middle = mean(mesh.positions);
  std::uint32_t count = 1;
  if (action == Action::kPoint) {
    kept[0] = extreme_vertex(mesh.positions, middle, true);
  } else {
    kept[0] = extreme_vertex(mesh.positions, middle, false);
    kept[1] = extreme_vertex(mesh.positions, mesh.positions[kept[0]], false);
    count = 2;
  }
  BlockWriter block(copy.free_memory());
  CopyMesh out = described(mesh);
  out.topology = action == Action::kPoint ? command::Topology::kPoints : command::Topology::kLines;
  out.vertex_count = count;
  const auto append_kept = [&](auto stream) {
    if (stream.empty()) return kNoStream;
    const std::uint32_t offset = block.append(stream.subspan(kept[0], 1));
    for (std::uint32_t k = 1; k < count; ++k) block.append(stream.subspan(kept[k], 1));
    return offset;
  };
  append_kept(mesh.positions);
  out.colour_offset = append_kept(mesh.colours);
  if (mesh.textured) {
    const TexCoord place = mesh.texture_coordinates[kept[0]];
    // A line between two materials has the first one's, all along: the other end's place is one of another image.
    const bool one_group = group_of(mesh, kept[0]) == group_of(mesh, kept[count - 1]);
    const TexCoord places[2] = {place, one_group ? mesh.texture_coordinates[kept[count - 1]] : place};
    out.texture_coordinate_offset = block.append(std::span<const TexCoord>(places, count));
  }
  if (!mesh.groups.empty()) {
    const std::uint32_t group = group_of(mesh, kept[0]);
    out.index_offset = block.append(std::span<const std::uint32_t>(&group, 1));  // of no indices
    out.has_group_words = true;
  }
  if (block.full()) return false;
  clock.charge(CpuWork::kVertexCopied, count);
  copy.add(mesh.number, out, block.bytes());
  return true;
}

}  // namespace usuzumi::firmware
