#include "firmware/thinning/mesh_builder.h"

#include <cstring>
#include <span>

#include "firmware/thinning/normals.h"
#include "hal/arena.h"

namespace usuzumi::firmware {
namespace {

constexpr std::uint32_t kAbsent = 0xFFFFFFFF;

command::Topology engine_topology(format::Topology topology) {
  switch (topology) {
    case format::Topology::kStrip: return command::Topology::kTriangleStrip;
    case format::Topology::kFan: return command::Topology::kTriangleFan;
    case format::Topology::kList:
    case format::Topology::kIndexed: break;
  }
  return command::Topology::kTriangles;
}

std::uint32_t count_of(const MeshView& mesh) { return static_cast<std::uint32_t>(mesh.positions.size()); }

/// A block under construction in the copy's free memory. Appending fails, and stays failed, when the memory ends.
class BlockWriter {
 public:
  explicit BlockWriter(std::span<std::byte> memory) : memory_(memory) {}

  /// The offset at which `source` now stands; it may overlap from above. kAbsent for an empty stream.
  template <class T>
  std::uint32_t append(std::span<const T> source) {
    if (source.empty()) return kAbsent;
    std::byte* p = extend(source.size_bytes());
    if (p == nullptr) return kAbsent;
    std::memmove(p, source.data(), source.size_bytes());
    return static_cast<std::uint32_t>(p - memory_.data());
  }

  std::byte* extend(std::size_t bytes) {
    const std::size_t padded = (bytes + 3) / 4 * 4;
    if (full_ || padded > memory_.size() - used_) {
      full_ = true;
      return nullptr;
    }
    std::byte* p = memory_.data() + used_;
    used_ += padded;
    return p;
  }

  bool full() const { return full_; }
  std::uint32_t bytes() const { return static_cast<std::uint32_t>(used_); }
  std::span<std::byte> rest() const { return memory_.subspan(used_); }

 private:
  std::span<std::byte> memory_;
  std::size_t used_ = 0;
  bool full_ = false;
};

CopyMesh described(const MeshView& mesh) {
  CopyMesh copy;
  copy.base_colour = mesh.base_colour;
  copy.two_sided = mesh.two_sided();
  return copy;
}

/// Writes the mesh's proper faces as a triangle list, which `indices` have just room for.
void expand_faces(const MeshView& mesh, std::span<std::uint32_t> indices) {
  std::size_t used = 0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    std::uint32_t v[3];
    if (!mesh.proper_face(f, v)) continue;
    for (const std::uint32_t corner : v) indices[used++] = corner;
  }
}

/// Appends normals made from the mesh's own faces, where RAM has room to make them; the mesh is drawn unlit otherwise.
std::uint32_t append_made_normals(const MeshView& mesh, std::uint32_t faces, BlockWriter& block) {
  Arena scratch(block.rest());
  const auto normals = scratch.allocate<PackedNormal>(mesh.positions.size());
  const auto indices = scratch.allocate<std::uint32_t>(std::size_t{3} * faces);
  if (normals.empty() || indices.empty()) return kAbsent;
  expand_faces(mesh, indices);
  if (!make_smooth_normals(mesh.positions, indices, normals, scratch)) return kAbsent;
  return block.append(std::span<const PackedNormal>(normals));
}

/// Level 1: the mesh as it stands in ROM.
bool copy_as_is(const MeshView& mesh, std::uint32_t faces, RamCopy& copy, Clock& clock) {
  BlockWriter block(copy.free_memory());
  CopyMesh out = described(mesh);
  out.topology = engine_topology(mesh.topology);
  out.vertex_count = count_of(mesh);
  out.faces = faces;
  block.append(mesh.positions);
  out.normal_offset = block.append(mesh.normals);
  out.colour_offset = block.append(mesh.colours);
  if (mesh.topology == format::Topology::kIndexed) {
    out.index_format = mesh.index_bytes == 2 ? command::IndexFormat::kU16 : command::IndexFormat::kU32;
    out.index_count = mesh.index_count;
    out.index_offset = block.append(mesh.indices);
    if (out.index_offset == kAbsent) out.index_offset = 0;  // no faces: the empty stream may stand anywhere
  }
  if (!block.full() && mesh.normals.empty() && faces > 0)
    out.normal_offset = append_made_normals(mesh, faces, block);
  if (block.full()) return false;
  clock.charge(CpuWork::kVertexCopied, out.vertex_count);
  clock.charge(CpuWork::kIndexCopied, out.index_count);
  copy.add(mesh.number, out, block.bytes());
  return true;
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

/// Levels 4 and 5 ([0023]): the vertex nearest to the middle as a point; the one farthest from the middle and the one
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
    if (stream.empty()) return kAbsent;
    const std::uint32_t offset = block.append(stream.subspan(kept[0], 1));
    for (std::uint32_t k = 1; k < count; ++k) block.append(stream.subspan(kept[k], 1));
    return offset;
  };
  append_kept(mesh.positions);
  out.colour_offset = append_kept(mesh.colours);
  if (block.full()) return false;
  clock.charge(CpuWork::kVertexCopied, count);
  copy.add(mesh.number, out, block.bytes());
  return true;
}

/// Halves the indices in place where all vertex numbers fit 16 bits. Returns the bytes of one index.
std::uint32_t narrow_indices(std::span<std::uint32_t> indices, std::uint32_t vertex_count) {
  if (vertex_count > 65536) return 4;
  auto* bytes = reinterpret_cast<std::byte*>(indices.data());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const auto narrow = static_cast<std::uint16_t>(indices[i]);
    std::memcpy(bytes + 2 * i, &narrow, 2);
  }
  return 2;
}

/// The mesh unpacked into the free memory as the simplifier wants it; the spans are empty where it does not fit.
struct Unpacked {
  WorkingMesh work;
  std::span<PackedNormal> normals;  // room for them even where the mesh has none yet
  bool fits = false;
};

Unpacked unpack_mesh(const MeshView& mesh, std::uint32_t faces, Arena& arena) {
  Unpacked u;
  const std::size_t index_count = std::size_t{3} * faces;
  u.work.positions = arena.allocate<Vec3>(mesh.positions.size());
  u.normals = arena.allocate<PackedNormal>(mesh.positions.size());
  u.work.colours = arena.allocate<Rgba8>(mesh.colours.size());
  u.work.indices = arena.allocate<std::uint32_t>(index_count);
  u.fits = !u.work.positions.empty() && !u.normals.empty() && u.work.colours.size() == mesh.colours.size() &&
           u.work.indices.size() == index_count;
  if (!u.fits) return u;
  const auto fill = [](auto to, auto from) {
    for (std::size_t i = 0; i < from.size(); ++i) to[i] = from[i];
  };
  fill(u.work.positions, mesh.positions);
  fill(u.normals, mesh.normals);
  fill(u.work.colours, mesh.colours);
  if (!mesh.normals.empty()) u.work.normals = u.normals;
  u.work.vertex_count = count_of(mesh);
  u.work.face_count = faces;
  expand_faces(mesh, u.work.indices);
  return u;
}

/// Slides what is left of the working mesh's streams together at the start of the free memory, where its positions
/// stand already: each stream moves to a lower address than it had.
void add_collapsed(const MeshView& mesh, const WorkingMesh& work, RamCopy& copy) {
  BlockWriter block(copy.free_memory());
  CopyMesh out = described(mesh);
  out.topology = command::Topology::kTriangles;
  out.vertex_count = work.vertex_count;
  out.index_count = 3 * work.face_count;
  out.faces = work.face_count;
  const auto append_left = [&](auto stream) {
    return block.append(
        std::span<const typename decltype(stream)::element_type>(stream.first(stream.empty() ? 0 : work.vertex_count)));
  };
  append_left(work.positions);
  out.normal_offset = append_left(work.normals);
  out.colour_offset = append_left(work.colours);
  const auto wide = work.indices.first(out.index_count);
  const std::uint32_t size = narrow_indices(wide, out.vertex_count);
  out.index_format = size == 2 ? command::IndexFormat::kU16 : command::IndexFormat::kU32;
  out.index_offset = block.append(
      std::span<const std::byte>(reinterpret_cast<const std::byte*>(wide.data()), std::size_t{out.index_count} * size));
  if (out.index_offset == kAbsent) out.index_offset = 0;  // no faces: the empty stream may stand anywhere
  copy.add(mesh.number, out, block.bytes());
}

/// Level 3, at the start of the free memory with the simplifier's scratch behind it.
bool copy_collapsed(const MeshView& mesh, std::uint32_t faces, const Decision& decision, RamCopy& copy, Clock& clock,
                    BuildReport& report) {
  Arena arena(copy.free_memory());
  Unpacked u = unpack_mesh(mesh, faces, arena);
  if (!u.fits) return false;
  const auto outcome =
      simplify(u.work, {.target_faces = decision.target_faces, .placement = decision.placement}, arena);
  if (!outcome.ok()) return false;
  report.outcome = outcome->stop == StopReason::kQuotaReached ? BuildOutcome::kBuilt : BuildOutcome::kQuotaNotReached;
  report.collapsed = true;
  report.max_error = outcome->max_error;
  clock.charge(CpuWork::kVertexCopied, mesh.positions.size());
  clock.charge(CpuWork::kConnectivityBuilt, faces);
  clock.charge(CpuWork::kEdgeCosted, outcome->work.edges_costed);
  clock.charge(CpuWork::kQueueOperation, outcome->work.queue_operations);
  clock.charge(CpuWork::kEdgeCollapsed, outcome->work.collapses);
  if (u.work.vertex_count > 0) {  // a mesh whose faces were all degenerate leaves nothing
    const auto positions = u.work.positions.first(u.work.vertex_count);
    const auto indices = u.work.indices.first(std::size_t{3} * u.work.face_count);
    if (u.work.normals.empty() && make_smooth_normals(positions, indices, u.normals.first(positions.size()), arena))
      u.work.normals = u.normals;
    copy.note_use(arena.high_water());
    add_collapsed(mesh, u.work, copy);
  }
  return true;
}

}  // namespace

BuildReport build_mesh(const MeshView& mesh, std::uint32_t faces, const Decision& decision, RamCopy& copy,
                       Clock& clock) {
  BuildReport report;
  switch (decision.action) {
    case Action::kDelete: return report;
    case Action::kPoint:
    case Action::kLine:
      if (!keep_vertices(mesh, decision.action, copy, clock)) report.outcome = BuildOutcome::kDropped;
      return report;
    case Action::kCollapse:
      if (decision.target_faces < faces) {
        if (copy_collapsed(mesh, faces, decision, copy, clock, report)) return report;
        report.outcome = BuildOutcome::kUnthinned;
      }
      break;
    case Action::kKeep: break;
  }
  if (!copy_as_is(mesh, faces, copy, clock)) report.outcome = BuildOutcome::kDropped;
  return report;
}

std::uint64_t working_bytes(const MeshView& mesh, std::uint32_t faces, const Decision& decision) {
  const std::uint64_t vertices = mesh.positions.size();
  const std::uint64_t as_is = vertices * (sizeof(Vec3) + sizeof(PackedNormal) + sizeof(Rgba8)) + mesh.indices.size();
  if (decision.action != Action::kCollapse) return as_is;
  return as_is + std::uint64_t{faces} * 12 +
         simplify_scratch_bytes(Method::kQem, static_cast<std::uint32_t>(vertices), faces, false);
}

}  // namespace usuzumi::firmware
