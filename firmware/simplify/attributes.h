// Normals and colours of wedges while edges collapse.
#pragma once

#include <cstdint>
#include <span>

#include "hal/vec.h"

namespace usuzumi::firmware {

struct WedgeAttributes {
  PackedNormal* normals = nullptr;  // null where absent
  Rgba8* colours = nullptr;

  bool any() const { return normals != nullptr || colours != nullptr; }
  /// Wedge `to` becomes the mixture (1 - t) to + t from, t in [0, 1].
  void mix(std::uint32_t to, std::uint32_t from, float t) const;
};

/// Where `offset` lies along `edge`, both from the edge's first end: 0 at that end, 1 at the other, clamped.
float position_along(Vec3 edge, Vec3 offset);

}  // namespace usuzumi::firmware
