// The faces of a solid, told to whoever asks: the same walk counts them, shades them smooth or makes them flat.
#pragma once

#include <cstdint>

#include "firmware/solids/solid_format.h"
#include "hal/vec.h"

namespace usuzumi::firmware {

/// How finely a solid's curved surfaces are divided; flat solids ask for neither.
struct ShapeDetail {
  std::uint32_t around = 0, rows = 0;
};

/// Of member 0, 1 or 2.
ShapeDetail detail_of(format::SolidKind kind, std::uint32_t member, const format::SolidDetail& detail);

/// Receives a solid's vertices and faces in its own coordinates.
class ShapeSink {
 public:
  /// The vertices are numbered as they come, from 0. `normal` has unit length: the curved surface's, or the flat
  /// face's.
  virtual void vertex(Vec3 place, Vec3 normal) = 0;
  /// A convex face, counter-clockwise as seen from outside.
  virtual void face(const std::uint32_t* corners, std::uint32_t count) = 0;

 protected:
  ~ShapeSink() = default;
};

/// `size` is that of a checked format::Solid.
void tell_shape(format::SolidKind kind, const float* size, ShapeDetail detail, ShapeSink& sink);

inline constexpr std::uint32_t kSectionCount = 6;

/// The section that a solid shows to one who looks along its own axes, fig. 3: at +x, -x, +y, -y, +z or -z for `side` 0
/// to 5; in the plane through the origin, counter-clockwise as seen from there. `places` has room for `around` or 4,
/// whichever is more. Returns how many there are.
std::uint32_t tell_section(format::SolidKind kind, const float* size, std::uint32_t around, std::uint32_t side,
                           Vec3* places);

/// Table 1: what is projected to the screen to choose a member, along the solid's own axes.
Vec3 identifying_size(format::SolidKind kind, const float* size);

/// Half of the box around the solid, whose middle is the origin.
Vec3 half_extent(format::SolidKind kind, const float* size);

}  // namespace usuzumi::firmware
