// Colours as drawing data keep them: display-referred (sRGB) bytes, so that the picture looks as it did in the
// modelling tool.
//
// glTF 2.0 gives colours as linear light (section 3.9.2 and 3.7.2.1); the device adds light to stored bytes as they are
// and shows them, so pack encodes them with the sRGB curve (IEC 61966-2-1). OBJ, PLY, DAE, AC and glTF 1.0 name no
// colour space; their colours are taken as display-referred already. Alpha is never encoded.
#pragma once

#include <cmath>
#include <cstdint>

#include "hal/vec.h"

namespace usuzumi::sim {

/// 0..1 to 0..255, rounded; what is not a number is 0.
inline std::uint32_t to_byte(double c) {
  if (!(c > 0)) return 0;
  return c >= 1 ? 255 : static_cast<std::uint32_t>(c * 255 + 0.5);
}

/// Linear light to the sRGB code value, both 0..1.
inline double srgb_encoded(double linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 1;
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

struct ColourF {
  double r = 1, g = 1, b = 1, a = 1;
};
inline ColourF operator*(const ColourF& x, const ColourF& y) { return {x.r * y.r, x.g * y.g, x.b * y.b, x.a * y.a}; }

inline Rgba8 from_linear(const ColourF& c) {
  return rgba8(to_byte(srgb_encoded(c.r)), to_byte(srgb_encoded(c.g)), to_byte(srgb_encoded(c.b)), to_byte(c.a));
}
inline Rgba8 from_display(const ColourF& c) { return rgba8(to_byte(c.r), to_byte(c.g), to_byte(c.b), to_byte(c.a)); }

}  // namespace usuzumi::sim
