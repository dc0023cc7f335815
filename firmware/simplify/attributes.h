// Normals, colours and texture coordinates of wedges while edges collapse.
#pragma once

#include <cstdint>
#include <span>

#include "hal/vec.h"

namespace usuzumi::firmware {

/// How much of the second end's attributes the new vertex gets, in [0, 1].
struct AttributeShares {
  float colour = 0.5f;  // by place: colours and texture coordinates lie on the surface
  float normal = 0.5f;  // by place and weight: what has to look evenly lit is mostly the largest faces around

  AttributeShares reversed() const { return {1.0f - colour, 1.0f - normal}; }
};

/// Where the new vertex lies `t` of the way from one end to the other. The weights are those of the ends' quadrics,
/// which grow with the area around: a bevel's normal would otherwise be drawn as a gradient over the wide flat face
/// beside it.
AttributeShares shares_at(float t, float weight_of_first, float weight_of_second);

/// `t` of the way from `a` to `b`, beyond either where `t` is outside [0, 1]: channels of a colour are then clamped.
Rgba8 mixed(Rgba8 a, Rgba8 b, float t);
TexCoord mixed(TexCoord a, TexCoord b, float t);

struct WedgeAttributes {
  PackedNormal* normals = nullptr;  // null where absent
  Rgba8* colours = nullptr;
  TexCoord* texture_coordinates = nullptr;

  bool any() const { return normals != nullptr || colours != nullptr || texture_coordinates != nullptr; }
  /// Wedge `to` takes on `shares` of wedge `from`.
  void mix(std::uint32_t to, std::uint32_t from, AttributeShares shares) const;
};

/// Where `offset` lies along `edge`, both from the edge's first end: 0 at that end, 1 at the other, clamped.
float position_along(Vec3 edge, Vec3 offset);

}  // namespace usuzumi::firmware
