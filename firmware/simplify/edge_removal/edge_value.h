// What the removal of an edge would change: US 6,396,952, eqs. (1) and (2), and the author's word on it.
#pragma once

#include <cstdint>

#include "firmware/simplify/edge_removal/image_border.h"
#include "firmware/simplify/simplify.h"
#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

/// What edge removal keeps of a vertex beside its Place and Vertex.
struct RemovalVertex {
  float author_value = 0;          // the largest of its wedges' edge_values; kLockedEdgeValue where one is locked
  std::uint32_t border_edges = 0;  // where images differ here: 0 inside, 2 along a boundary, else a corner that stays
};
static_assert(sizeof(RemovalVertex) == 8);

/// The larger of two author's values; a lock is more than any.
inline float larger_author_value(float a, float b) {
  if (a < 0 || b < 0) return kLockedEdgeValue;
  return a > b ? a : b;
}

/// What happens at one end while it moves along the whole edge, E or -E.
struct EndChange {
  float volume = 0;       // sum of |V_i| over the planes at this end only; V_i = (N_i . E) A_i
  float net_volume = 0;   // sum of V_i with its sign: E . N_i > 0 where the plane looks along E
  float outline = 0;      // |(N_i . E) L_i| of the boundary edge that goes on from this end; 0 where there is none
  float net_outline = 0;  // with its sign, N_i pointing to the left of the way along the boundary from `a` to `b`
};

/// An edge and what is around it, in working units.
struct EdgeShape {
  std::uint32_t a = 0, b = 0;  // the ends; E runs from a to b
  float length = 0;            // |E|
  float sheet = 0;             // sum of S_i = |E| A_i over the planes on the edge itself
  bool border = false;         // a boundary edge; only then is `outline` of the ends known
  EndChange at_a, at_b;
};

/// Where the vertex that stays may go.
enum class Freedom : std::uint8_t {
  kNone,    // the edge is not removed
  kAtA,     // only to a: it lies on a boundary that the edge is no part of, or is a corner of one
  kAtB,
  kAlong,   // anywhere on the edge's line
};

class EdgeValues {
 public:
  /// `vertices` has an entry for each vertex of `surface`. All outlive this.
  EdgeValues(Surface& surface, const Images& images, const RemovalVertex* vertices,
             const EdgeRemovalSettings& settings)
      : surface_(surface), images_(images), vertices_(vertices), settings_(settings) {}

  EdgeShape shape_of(Corner edge) const;
  Freedom freedom_of(const EdgeShape& shape) const;

  /// Eq. (1), with eq. (2) added on a boundary and with its neighbours' mean where the settings say so.
  float computed(Corner edge, const EdgeShape& shape) const;
  /// That mixed with the author's value by the settings' weights: what edges are ordered by. Finite.
  float value(Corner edge, const EdgeShape& shape) const;
  /// What the author's value 1 is worth: the mean computed value of the mesh as given.
  void set_unit(float unit) { unit_ = unit; }

 private:
  float own_value(const EdgeShape& shape) const;
  float neighbours_mean(Corner edge, const EdgeShape& shape) const;
  void look_at_outline(std::uint32_t end, std::uint32_t other, Vec3 edge, bool at_a, EndChange& change) const;

  Surface& surface_;
  const Images& images_;
  const RemovalVertex* vertices_;
  const EdgeRemovalSettings& settings_;
  float unit_ = 0;
};

}  // namespace usuzumi::firmware
