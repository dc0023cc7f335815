#include "firmware/solids/view_candidates.h"

namespace usuzumi::firmware {

std::uint32_t candidates_that_see(Vec3 face_normal, std::span<const Vec3> candidates) {
  std::uint32_t seen = 0;
  for (std::size_t i = 0; i < candidates.size() && i < format::kMaxViewCandidates; ++i)
    if (!(dot(face_normal, candidates[i]) < 0)) seen |= 1u << i;
  return seen;
}

std::uint32_t nearest_candidate(Vec3 to_viewer, const SolidPlacement& placement, std::span<const Vec3> candidates) {
  std::uint32_t nearest = 0;
  float most = 0;
  for (std::uint32_t i = 0; i < candidates.size(); ++i) {
    const float along = dot(to_viewer, normalized(placement.direction(candidates[i])));
    if (i > 0 && !(along > most)) continue;
    nearest = i;
    most = along;
  }
  return nearest;
}

}  // namespace usuzumi::firmware
