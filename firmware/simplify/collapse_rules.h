// Which collapses are allowed: those that keep the surface's topology and turn no face over.
//
// The topological rule is the link condition of Dey, Edelsbrunner, Guha & Nekhayev, "Topology Preserving Edge
// Contraction" (1999), in the form that counts faces per edge, so that it also serves input that is no manifold.
#pragma once

#include <cstdint>

#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

/// More faces than this on one edge are never collapsed.
inline constexpr std::uint32_t kMostFacesOnEdge = 8;

/// Faces around an edge that are kept at hand for the turning test; where there are more they are walked again.
inline constexpr std::uint32_t kMostFacesAtHand = 64;

/// The edge under trial and what looking around it found.
struct Neighbourhood {
  std::uint32_t a = 0, b = 0;             // the ends
  std::uint32_t apex_count = 0;           // third vertices of the edge's faces, each once
  std::uint32_t apexes[kMostFacesOnEdge];
  bool touches_refused = false;           // an end or a neighbour carries kTouchesRefused
  Vec3 area_normal;                       // sum over the faces at either end of twice their area vectors
  float swept = 0;  // `area_normal` . x == `swept` where moving both ends to a + x keeps the volume
};

/// Faces that stay, by coordinate, so that a compiler can take several at a time.
struct FacesAtHand {
  std::uint32_t count = 0;  // kMostFacesAtHand + 1: too many
  float px[kMostFacesAtHand], py[kMostFacesAtHand], pz[kMostFacesAtHand];  // the corner after the moving one
  float qx[kMostFacesAtHand], qy[kMostFacesAtHand], qz[kMostFacesAtHand];  // the corner before it
  float nx[kMostFacesAtHand], ny[kMostFacesAtHand], nz[kMostFacesAtHand];  // twice the area vector
  PackedNormal facing[kMostFacesAtHand];                                   // see Surface

  void add(Vec3 p, Vec3 q, Vec3 normal, PackedNormal looked) {
    if (count >= kMostFacesAtHand) {
      count = kMostFacesAtHand + 1;
      return;
    }
    px[count] = p.x, py[count] = p.y, pz[count] = p.z;
    qx[count] = q.x, qy[count] = q.y, qz[count] = q.z;
    nx[count] = normal.x, ny[count] = normal.y, nz[count] = normal.z;
    facing[count] = looked;
    ++count;
  }
};

class CollapseRules {
 public:
  explicit CollapseRules(Surface& surface) : surface_(surface) {}

  /// Looks around the edge; false when collapsing it would pinch, fold or close the surface, or would leave an edge
  /// with more faces than two that no edge there had before.
  bool keeps_topology(Neighbourhood& n);

  /// True when moving both ends to `position` turns a remaining face by more than the limit, or away from the side it
  /// looked to in the model, or makes it a sliver. `n` is of the last call of keeps_topology, and that returned true.
  bool turns_a_face(const Neighbourhood& n, Vec3 position) const;

 private:
  void start_marks();
  bool keeps_regular_topology(Neighbourhood& n, bool& decided);
  bool keeps_any_topology(Neighbourhood& n);
  bool turns_a_face_at(std::uint32_t v, std::uint32_t other, Vec3 position) const;

  Surface& surface_;
  std::uint32_t epoch_ = 0;
  FacesAtHand faces_;
};

}  // namespace usuzumi::firmware
