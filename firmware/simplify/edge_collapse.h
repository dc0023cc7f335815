// Carrying out one edge collapse on the connectivity.
#pragma once

#include <cstdint>

#include "firmware/simplify/attributes.h"
#include "firmware/simplify/collapse_rules.h"
#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

struct CollapsedEdge {
  std::uint32_t vertex = 0;             // the one that stays: the lower number
  std::uint32_t faces_removed = 0;
  std::uint32_t uncosted_count = 0;     // edges whose entries went with a removed face
  Corner uncosted[kMostFacesOnEdge];
};

/// Merges the ends of `n`'s edge, removes its faces, and joins each pair of edges that falls together under one
/// representative. Positions and quadrics are the caller's. `shares` says how much of b's attributes the new vertex
/// gets. `vertex_of_wedge` is the surface's, writable; null where every wedge is its own vertex.
CollapsedEdge collapse_edge(Surface& surface, std::uint32_t* vertex_of_wedge, const WedgeAttributes& attributes,
                            const Neighbourhood& n, AttributeShares shares);

}  // namespace usuzumi::firmware
