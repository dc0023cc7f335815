// The quadrics that a mesh starts with, and its list of edges.
#pragma once

#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

/// Sets every vertex's quadric: the planes of its faces weighted by area, constraint planes at right angles to the
/// faces along open borders (and other edges that have not two faces) and along attribute borders. Chooses every edge's
/// representative half-edge and finds the singular vertices. Marks are zero before.
void set_initial_quadrics(Surface& surface);

}  // namespace usuzumi::firmware
