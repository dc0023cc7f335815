// The quadrics that a mesh starts with, and its list of edges.
#pragma once

#include <cstdint>

#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

/// Sets every vertex's quadric: the planes of its faces weighted by area, constraint planes at right angles to the
/// faces along open borders (and other edges that have not two faces) and along attribute borders. Chooses every edge's
/// representative half-edge and finds the singular vertices. Marks are zero before. `texture_places` as found by
/// find_texture_places() (weld.h), or null: where given, borders on which they disagree, the seams of a texture, are
/// held faster than others.
void set_initial_quadrics(Surface& surface, const std::uint32_t* texture_places = nullptr);

}  // namespace usuzumi::firmware
