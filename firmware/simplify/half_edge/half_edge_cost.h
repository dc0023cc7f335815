// What a half-edge collapse costs: CN101231761A, claim 1, condition one.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/simplify/edge_key.h"
#include "firmware/simplify/half_edge/seams.h"
#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

/// Cost(vs -> vt) = Dist + a IsSeam(vs) (1 - IsSeam(vt)) + a IsSeam(vs) IsSeam(vt) (1 - IsSeam(vs, vt))
///                + 2a IsCross(vs) IsSeam(vt),
/// with a = MaxDist (TriArea(vs) + TriArea(vt)). The pseudocode in the source's description asks for IsCross(vs) first
/// and, where it holds, adds 2a alone, whatever vt is; we follow the claim, which adds. It has no term for a seam that
/// ends at vt: no wedge of vt continues vs's on both sides of it, so that going there tears as leaving a seam does, a.
inline float half_edge_cost(float dist, float alpha, const SeamRelation& r) {
  float cost = dist;
  if (r.from_seam && !r.to_seam) cost += alpha;
  if (r.from_seam && r.to_seam && !r.edge_seam) cost += alpha;
  if (r.from_cross && r.to_seam) cost += 2 * alpha;
  if (r.splits) cost += alpha;
  return cost;
}

/// In the key of a half-edge with a penalty. The source wants penalties above every Dist, and a promise: no seam breaks
/// while another collapse is left. A number alone cannot hold it (a is of the areas at hand, Dist of another place may
/// be larger), so what is penalised comes after all that is not, by a bit above the cost's.
inline constexpr EdgeKey kPenalised = EdgeKey{1} << 63;

/// One of the two collapses of an edge.
struct HalfEdge {
  EdgeKey key = kEdgeKeyMax;  // kEdgeKeyMax: there is none
  std::uint32_t from = 0, to = 0;
  float dist = 0;        // (Qs + Qt)(vt), at least 0
  bool forward = false;  // runs as the edge's representative does
};

inline constexpr std::uint32_t kForwardRefused = 1, kBackwardRefused = 2;

class HalfEdgeCosts {
 public:
  HalfEdgeCosts() = default;
  /// `areas`: one per vertex.
  HalfEdgeCosts(const Surface& surface, const Seams& seams, std::span<float> areas)
      : surface_(&surface), seams_(&seams), areas_(areas.data()) {}

  /// TriArea of every vertex, and MaxDist.
  void start();

  /// The cheaper of an edge's two collapses, forward on a tie; `refused` (kForwardRefused, kBackwardRefused) are left
  /// out.
  HalfEdge cheapest(Corner edge, std::uint32_t refused) const;
  /// Its key alone.
  EdgeKey least_key(Corner edge, std::uint32_t refused) const;

  /// Twice the squared diagonal of the mesh's bounding box: no point is further from a face, and the quadrics weigh a
  /// face with twice its area, so that a is no less than the Dist of any faces' planes.
  float max_dist() const { return max_dist_; }
  float area(std::uint32_t v) const { return areas_[v]; }
  float alpha(std::uint32_t from, std::uint32_t to) const { return max_dist_ * (areas_[from] + areas_[to]); }
  /// After a collapse the triangles around `from` count as `to`'s.
  void merge_areas(std::uint32_t from, std::uint32_t to) { areas_[to] += areas_[from]; }

 private:
  struct BothWays {
    std::uint32_t a, b;
    float forward, backward;  // Dist of a to b, of b to a
  };
  BothWays both_ways(Corner edge) const;
  HalfEdge cheapest_at_seam(const BothWays& ways, Corner edge, std::uint32_t refused) const;

  const Surface* surface_ = nullptr;
  const Seams* seams_ = nullptr;
  float* areas_ = nullptr;
  float max_dist_ = 0;
};

}  // namespace usuzumi::firmware
