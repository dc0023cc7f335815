// What deleting a vertex changes: eqs. (1) to (5) of Sato, Kitazawa & Onozawa, and the fill for which that is least.
#pragma once

#include <cstdint>

#include "firmware/simplify/simplify.h"
#include "firmware/simplify/vertex_deletion/ring.h"
#include "firmware/simplify/vertex_deletion/ring_shape.h"

namespace usuzumi::firmware {

/// The terms of eq. (5) for one fill. P_i are the ring's faces, Q_j the fill's, S() areas, S' the mean area of the
/// faces of the mesh as given.
struct DeletionTerms {
  float area = 0;     // (1): |sum S(Q_j) - sum S(P_i)| / sum S(P_i)
  float move = 0;     // (2): d / sqrt(S') + protrusion penalty
  float normal = 0;   // (3): 1/M sum |m_j - sum(theta_i n_i) / sum(theta_i)|^2
  float largest = 0;  // (4): max S(Q_j) / S'
};

struct Deletion {
  float energy = 0;  // (5): a area + b move + c normal + d largest, finite
  DeletionTerms terms;
  float distance = 0;  // from the vertex to the new faces, in working units: d of (2), or a bound where no d is
  std::uint8_t fills[2] = {};  // of each sector
};

/// Edges between a sector's corners that the mesh has elsewhere: bit b of edges[sector][a], a < b.
struct TakenEdges {
  std::uint32_t edges[2][kMostCorners + 1] = {};
};

/// What the paper leaves open, as we take it:
/// - The mean normal in (3) is as printed, not made a unit: it is shorter the sharper the vertex. In (2) only its
///   direction counts. Where it is shorter than 1/1000 the vertex has no side, and stays.
/// - Where the line of (2) meets several Q_j, the nearest counts. Where it meets none, d is 0 and the penalty is added;
///   but at boundary vertices and on seams, where the corner of a round outline would always be past the new edge, d is
///   then the distance to that edge, without penalty: the outline is what the boundary's coefficient of (1) holds.
/// - At boundary vertices and on seams a is the boundary's. On seams, the boundaries of two surfaces that stay glued,
///   (1) sums the absolute changes of both sides, and (3) has each side's own mean normal: a crease is not a bump.
/// Fills are not taken where a new face
/// - looks more than 78 degrees away (cosine 0.2, arbitrary) from the mean normal of its side of the ring, or to the
///   back of what was at its outer edges in the model as given (Surface::facing, inherited along the polygon's sides);
/// - has no area, or is a sliver (height below 1/100 of the longest side) much worse than the ring's worst;
/// - lies the other way round on the texture than all of its side of the ring did;
/// - has an edge of `taken`.
/// Of fans alone, at boundary vertices and on seams, the vertex goes to an end of its closing edge, on both sides to
/// the same.
class DeletionEnergy {
 public:
  /// `mean_area` is S' in squared working units, > 0. `fans_only`: SimplifyOptions::for_layers.
  DeletionEnergy(const Surface& surface, const TexCoord* texture_coordinates, const VertexDeletionSettings& settings,
                 float mean_area, bool fans_only = false);

  /// The fill of least energy; of equals the first. False where no fill may be taken, or the ring has no area.
  bool least(const Ring& ring, const TakenEdges* taken, Deletion& best);

 private:
  struct FillSums {
    bool allowed = true;
    float area = 0, normal = 0, largest = 0, distance = 0;
  };

  std::uint32_t fills_of(std::uint32_t corners) const;
  void measure_fills(std::uint32_t sector, const std::uint32_t* taken);
  Deletion weighed(const FillSums& one, const FillSums& other, float per_triangle) const;

  const Surface& surface_;
  const TexCoord* texture_coordinates_;
  VertexDeletionSettings settings_;
  float per_mean_area_, per_root_mean_area_;
  bool fans_only_;
  RingShape shape_;                  // of the ring that is looked at; here, as it is large
  FillSums fills_[2][kMostFills];
};

}  // namespace usuzumi::firmware
