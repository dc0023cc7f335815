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

WedgeMatching::WedgeMatching(const Surface& surface, const WedgeAttributes& attributes,
                             std::span<const MaterialGroup> groups, std::uint32_t from, std::uint32_t to)
    : surface_(surface), attributes_(attributes), groups_(groups), to_(to) {
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
  return nearest_of_group(wedge);
}

std::uint32_t WedgeMatching::nearest_of_group(std::uint32_t wedge) const {
  const std::uint32_t group = group_of(groups_, wedge);
  std::uint32_t nearest = kNone;
  for (Corner c = surface_.first_corner(to_); c != kNoCorner; c = surface_.next_corner_of(c)) {
    const std::uint32_t candidate = surface_.indices[corner_index(c)];
    if (candidate == nearest || group_of(groups_, candidate) != group) continue;
    if (nearest == kNone || is_nearer(wedge, candidate, nearest)) nearest = candidate;
  }
  return nearest;
}

// Coordinates far out may be infinitely far from each other: such distances are equal.
bool WedgeMatching::is_nearer(std::uint32_t wedge, std::uint32_t one, std::uint32_t other) const {
  if (attributes_.texture_coordinates != nullptr) {
    const TexCoord* t = attributes_.texture_coordinates;
    const auto squared = [&](std::uint32_t w) {
      return (t[w].s - t[wedge].s) * (t[w].s - t[wedge].s) + (t[w].t - t[wedge].t) * (t[w].t - t[wedge].t);
    };
    const float to_one = squared(one), to_other = squared(other);
    if (to_one < to_other) return true;
    if (to_one > to_other) return false;
  }
  if (attributes_.normals != nullptr) {
    const Vec3 normal = unpack(attributes_.normals[wedge]);
    const float along_one = dot(unpack(attributes_.normals[one]), normal);
    const float along_other = dot(unpack(attributes_.normals[other]), normal);
    if (along_one > along_other) return true;
    if (along_one < along_other) return false;
  }
  return one < other;
}

}  // namespace usuzumi::firmware
