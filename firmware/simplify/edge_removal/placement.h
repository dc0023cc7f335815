// Where on the line of a removed edge the vertex that stays goes: US 6,396,952, p. 19-22, figs. 4 and 5, and p. 27-30.
#pragma once

#include "firmware/simplify/edge_removal/edge_value.h"

namespace usuzumi::firmware {

/// The place v' = (1 - t) v1 + t v2 that `placement` chooses for an edge whose both ends may move. Where automatic
/// placement has chosen and the place cannot be used, `second_choice` is its other answer. In [0, 1] but for
/// kLeastVolume, which may go kMostBeyond beyond an end.
float place_on_edge(const EdgeShape& shape, EdgePlacement placement, bool second_choice = false);
inline constexpr float kMostBeyond = 0.25f;

/// The area by which the outline changes with the vertex at `t`: |t| of eq. (2)'s term at v1 and |1 - t| of that at v2.
inline float outline_change(const EdgeShape& shape, float t) {
  return (t < 0 ? -t : t) * shape.at_a.outline + (t > 1 ? t - 1 : 1 - t) * shape.at_b.outline;
}

/// Moves `t` to the nearest place between the ends where the outline changes by no more than `limit`; not at all where
/// it does not change by more there already. False where it changes by more everywhere.
bool limit_movement(const EdgeShape& shape, float limit, float& t);

}  // namespace usuzumi::firmware
