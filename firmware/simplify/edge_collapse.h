// Carrying out one edge collapse on the connectivity.
#pragma once

#include <cstdint>

#include "firmware/simplify/attributes.h"
#include "firmware/simplify/collapse_rules.h"
#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

/// Wedges of the two ends that meet in a removed face become one, the kept end's. Where faces disagree about the
/// partner, the first face decides, and the wedge left over only moves.
struct WedgePairs {
  std::uint32_t count = 0;
  std::uint32_t kept[kMostFacesOnEdge];
  std::uint32_t removed[kMostFacesOnEdge];

  bool add(std::uint32_t keep, std::uint32_t remove) {
    for (std::uint32_t i = 0; i < count; ++i)
      if (kept[i] == keep || removed[i] == remove) return false;
    kept[count] = keep;
    removed[count++] = remove;
    return true;
  }
  /// What a corner that named `wedge` at the end that is gone names now.
  std::uint32_t successor(std::uint32_t wedge) const {
    for (std::uint32_t i = 0; i < count; ++i)
      if (removed[i] == wedge) return kept[i];
    return wedge;
  }
  /// What a corner that was at the end that is gone named before.
  std::uint32_t predecessor(std::uint32_t wedge) const {
    for (std::uint32_t i = 0; i < count; ++i)
      if (kept[i] == wedge) return removed[i];
    return wedge;
  }
};

/// A face on the collapsed edge, the wedges that it had at both ends, and its third corner's vertex and wedge.
struct RemovedFace {
  std::uint32_t face, kept_wedge, removed_wedge, apex, apex_wedge;
};

struct CollapsedEdge {
  std::uint32_t vertex = 0;             // the one that stays: by collapse_edge the lower number
  std::uint32_t faces_removed = 0;
  RemovedFace removed[kMostFacesOnEdge];
  WedgePairs pairs;
  Corner first_from_removed = kNoCorner;  // in the list of `vertex`, from here on: corners of the end that is gone
  std::uint32_t uncosted_count = 0;     // edges whose entries went with a removed face
  Corner uncosted[kMostFacesOnEdge];
};

/// Merges the ends of `n`'s edge, removes its faces, and joins each pair of edges that falls together under one
/// representative. Positions and quadrics are the caller's. `shares` says how much of b's attributes the new vertex
/// gets. `vertex_of_wedge` is the surface's, writable; null where every wedge is its own vertex.
CollapsedEdge collapse_edge(Surface& surface, std::uint32_t* vertex_of_wedge, const WedgeAttributes& attributes,
                            const Neighbourhood& n, AttributeShares shares);

/// Merges `n.a` into `n.b`, which stays as it is. The caller has given the corners at `n.a`, but for those of the
/// edge's faces, wedges of `n.b`. `pairs` and `first_from_removed` stay empty.
CollapsedEdge collapse_half_edge(Surface& surface, const Neighbourhood& n);

}  // namespace usuzumi::firmware
