// Settings of vertex deletion after the advice of Sato, Kitazawa & Onozawa, section 3: each changes one coefficient of
// the defaults.
#pragma once

#include "firmware/simplify/simplify.h"

namespace usuzumi::firmware {

/// `flat`: mostly planes. Only d is lowered: planes may be covered by large triangles.
constexpr VertexDeletionSettings flat_preset() {
  VertexDeletionSettings settings;
  settings.largest *= 0.1f;
  return settings;
}

/// `curved`: mostly curved parts. Only b is raised: moving vertices would spoil the shape.
constexpr VertexDeletionSettings curved_preset() {
  VertexDeletionSettings settings;
  settings.move *= 4;
  return settings;
}

/// `bounded`: boundaries matter. Only the coefficient of E_area for boundary vertices is raised.
constexpr VertexDeletionSettings bounded_preset() {
  VertexDeletionSettings settings;
  settings.boundary_area *= 10;
  return settings;
}

inline constexpr VertexDeletionSettings kFlatPreset = flat_preset();
inline constexpr VertexDeletionSettings kCurvedPreset = curved_preset();
inline constexpr VertexDeletionSettings kBoundedPreset = bounded_preset();

}  // namespace usuzumi::firmware
