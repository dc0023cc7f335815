#include "firmware/simplify/half_edge/wedge_matching.h"

namespace usuzumi::firmware {
namespace {

// Groups are few: as many as one mesh has materials.
std::uint32_t group_of(std::span<const MaterialGroup> groups, std::uint32_t wedge) {
  std::uint32_t g = 0;
  while (g + 1 < groups.size() && wedge >= groups[g].vertex_end) ++g;
  return g;
}

}  // namespace

WedgeMatching::WedgeMatching(const Surface& surface, std::span<const MaterialGroup> groups, std::uint32_t from,
                             std::uint32_t to)
    : surface_(surface), groups_(groups), to_(to) {
  if (surface.vertex_of_wedge == nullptr) {  // every wedge is its own vertex
    from_[0] = from;
    successor_[0] = to;
    count_ = 1;
    return;
  }
  for (Corner c = surface.first_corner(from); c != kNoCorner; c = surface.next_corner_of(c)) {
    const Corner next = next_in_face(c), previous = previous_in_face(c);
    const bool runs_out = surface.vertex_at(next) == to;
    if (!runs_out && surface.vertex_at(previous) != to) continue;
    const std::uint32_t wedge = surface.indices[corner_index(c)];
    std::uint32_t i = 0;
    while (i < count_ && from_[i] != wedge) ++i;
    if (i < count_ || count_ == kMostFacesOnEdge) continue;
    from_[count_] = wedge;
    successor_[count_++] = surface.indices[corner_index(runs_out ? next : previous)];
  }
}

std::uint32_t WedgeMatching::successor(std::uint32_t wedge) const {
  for (std::uint32_t i = 0; i < count_; ++i)
    if (from_[i] == wedge) return successor_[i];
  return lowest_of_group(wedge);
}

std::uint32_t WedgeMatching::lowest_of_group(std::uint32_t wedge) const {
  const std::uint32_t group = group_of(groups_, wedge);
  std::uint32_t lowest = kNone;
  for (Corner c = surface_.first_corner(to_); c != kNoCorner; c = surface_.next_corner_of(c)) {
    const std::uint32_t candidate = surface_.indices[corner_index(c)];
    if (candidate < lowest && group_of(groups_, candidate) == group) lowest = candidate;
  }
  return lowest;
}

}  // namespace usuzumi::firmware
