// Taking a vertex out of a surface and filling the polygon it leaves, in the slots of its own faces.
#pragma once

#include <cstdint>

#include "firmware/simplify/collapse_log.h"
#include "firmware/simplify/surface.h"
#include "firmware/simplify/vertex_deletion/ring.h"

namespace usuzumi::firmware {

/// Deletes ring.vertex; `fills` are those of each sector (fill_patterns.h). A new face with a side on the polygon takes
/// the slot of the old face there, so that it stays among the faces of its material and inherits the side that one
/// looked to; it changes one corner. Others take slots that are left. Tells `log`, where not null, of one step: each
/// wedge of the vertex is succeeded by the wedge, in its sector, of the corner that its fan meets in, and each new face
/// of the fan takes the slot of the old face across from that corner; where the fill is no fan, of the nearest corner
/// of the polygon (the first of equals); of a boundary vertex or on a seam, of the nearer of the two corners on that
/// line, the same for both sides. Wedges of the polygon that no face names any more follow another there, of the same
/// texture coordinate if `texture_coordinates` (by wedge; null where there are none) have one. Returns the number of
/// faces that are gone.
std::uint32_t delete_vertex(Surface& surface, const TexCoord* texture_coordinates, const Ring& ring,
                            const std::uint8_t fills[2], CollapseLog* log);

}  // namespace usuzumi::firmware
