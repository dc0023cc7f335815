#include "firmware/thinning/normals.h"

#include <algorithm>

namespace usuzumi::firmware {

bool make_smooth_normals(std::span<const Vec3> positions, std::span<const std::uint32_t> indices,
                         std::span<PackedNormal> out, Arena& scratch) {
  const ScratchScope scope(scratch);
  const auto sums = scratch.allocate<Vec3>(positions.size());
  if (sums.size() != positions.size()) return false;
  std::fill(sums.begin(), sums.end(), Vec3{});
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const std::uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
    const Vec3 area = cross(positions[b] - positions[a], positions[c] - positions[a]);
    for (const std::uint32_t v : {a, b, c}) sums[v] = sums[v] + area;
  }
  for (std::size_t v = 0; v < sums.size(); ++v) out[v] = pack_normal(normalized(sums[v]));
  return true;
}

}  // namespace usuzumi::firmware
