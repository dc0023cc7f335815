// Edges whose collapse was refused: left alone until something near them has changed.
#pragma once

#include <cstdint>

#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

/// Tells both ends of `edge`, so that a collapse beside them knows that it has to look.
inline void touch_refused(Surface& surface, Corner edge) {
  surface.places[surface.vertex_at(edge)].mark |= kTouchesRefused;
  surface.places[surface.vertex_at(next_in_face(edge))].mark |= kTouchesRefused;
}

inline void refuse_edge(Surface& surface, Corner edge) {
  surface.links[edge] |= kRefused;
  touch_refused(surface, edge);
}

/// Spends kTouchesRefused at `v` and calls `visit(half-edge)` for every half-edge there.
template <class Visit>
void visit_touched_at(Surface& surface, std::uint32_t v, Visit& visit) {
  surface.places[v].mark &= ~kTouchesRefused;
  for (Corner c = surface.first_corner(v); c != kNoCorner; c = surface.next_corner_of(c))
    for (const Corner half_edge : {c, previous_in_face(c)}) visit(half_edge);
}

/// A collapse into `v` changed the faces of `v` and of its neighbours, and with them what is allowed at those vertices:
/// visits the half-edges of `v` and of the neighbours that touch a refused edge.
template <class Visit>
void visit_touched_around(Surface& surface, std::uint32_t v, Visit visit) {
  visit_touched_at(surface, v, visit);
  for (Corner c = surface.first_corner(v); c != kNoCorner; c = surface.next_corner_of(c)) {
    for (const Corner other : {next_in_face(c), previous_in_face(c)}) {
      const std::uint32_t u = surface.vertex_at(other);
      if ((surface.places[u].mark & kTouchesRefused) != 0) visit_touched_at(surface, u, visit);
    }
  }
}

/// Allows the refused edges around `v` again, and calls `take_up(edge)` for each.
template <class TakeUp>
void allow_again_around(Surface& surface, std::uint32_t v, TakeUp take_up) {
  visit_touched_around(surface, v, [&](Corner edge) {
    std::uint32_t& flags = surface.links[edge];
    if ((flags & kRefused) == 0) return;
    flags &= ~kRefused;
    take_up(edge);
  });
}

}  // namespace usuzumi::firmware
