#include "firmware/thinning/mesh_builder.h"

#include "firmware/thinning/thinned_mesh.h"
#include "firmware/thinning/whole_mesh.h"

namespace usuzumi::firmware {

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
        if (copy_thinned(mesh, faces, decision, copy, clock, report)) return report;
        report.outcome = BuildOutcome::kUnthinned;
      }
      break;
    case Action::kKeep: break;
  }
  if (!copy_as_is(mesh, faces, copy, clock)) report.outcome = BuildOutcome::kDropped;
  return report;
}

std::uint64_t working_bytes(const MeshView& mesh, std::uint32_t faces, const Decision& decision, const RamCopy& copy) {
  const std::uint64_t vertices = mesh.positions.size();
  const std::uint64_t as_is =
      vertices * (sizeof(Vec3) + sizeof(PackedNormal) + sizeof(Rgba8) + (mesh.textured ? sizeof(TexCoord) : 0)) +
      mesh.indices.size();
  if (decision.action != Action::kCollapse) return as_is;
  return as_is + unpacked_bytes(mesh, faces, decision, copy) +
         simplify_scratch_bytes(decision.method, static_cast<std::uint32_t>(vertices), faces, mesh.textured);
}

}  // namespace usuzumi::firmware
