// Which wedges of vt take the place of vs's wedges when vs goes: CN101231761A, steps 2, 3 and 5 of a collapse.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/simplify/attributes.h"
#include "firmware/simplify/collapse_rules.h"
#include "firmware/simplify/simplify.h"
#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

/// A wedge of vs that a removed face names is followed by the wedge of vt that the face names: they are continuous,
/// and so is, across the triangles that share the wedge of vs, everything around it. Where removed faces disagree, the
/// first of vs's list decides. A wedge of vs that no removed face names is torn from its surroundings: the source takes
/// any wedge of vt then, we the one of the same material group whose texture coordinate is nearest, of these the one
/// whose normal is nearest, of these the lowest.
class WedgeMatching {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  WedgeMatching(const Surface& surface, const WedgeAttributes& attributes, std::span<const MaterialGroup> groups,
                std::uint32_t from, std::uint32_t to);

  /// kNone where vt has no wedge of the group.
  std::uint32_t successor(std::uint32_t wedge) const;

 private:
  std::uint32_t nearest_of_group(std::uint32_t wedge) const;
  bool is_nearer(std::uint32_t wedge, std::uint32_t one, std::uint32_t other) const;

  const Surface& surface_;
  const WedgeAttributes attributes_;
  const std::span<const MaterialGroup> groups_;
  const std::uint32_t to_;
  std::uint32_t count_ = 0;
  std::uint32_t from_[kMostFacesOnEdge], successor_[kMostFacesOnEdge];
};

}  // namespace usuzumi::firmware
