// What a collapse does to a texture, as part of the quadric error: after Hoppe, "New Quadric Metric for Simplifying
// Meshes with Appearance Attributes" (IEEE Visualization 1999).
//
// Over each face a texture coordinate is a linear function of place. Hoppe's quadric sums, over the faces that a vertex
// stands for, the squared difference between the vertex's coordinate and each face's function at the vertex's place,
// and solves for place and coordinate together. Here the coordinate is solved for beforehand: for any place the best
// one is the mean of the faces' functions, weighted by area, which again is a linear function, and what stays of the
// squared differences is a quadric of the place alone. So a vertex keeps its ten numbers, and the system to be solved
// its three unknowns. Beside them go the mean's two slopes and the area; when two such means become one, the quadric
// gains the squared difference of the two, weighted by w1 w2 / (w1 + w2) (the way in which variances are joined, Chan,
// Golub & LeVeque 1983), so that nothing is ever subtracted: over a texture that is linear across the whole surface
// nothing accumulates but the rounding of single precision.
//
// A vertex has one such mean for each place in the texture that it stands for: several on a seam. Those of the two ends
// that share a face of the edge become one; the others move with the vertex, each along its own slope.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/simplify/collapse_rules.h"
#include "firmware/simplify/qem/edge_cost.h"
#include "firmware/simplify/simplify.h"
#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

/// The mean of the faces' functions around a place of the texture. Its value at the vertex is the wedge's coordinate.
struct TextureFit {
  Vec3 s_slope, t_slope;  // texture units per working unit
  float weight = 0;       // summed: twice the faces' areas
};
static_assert(sizeof(TextureFit) == 28);

class TextureError {
 public:
  /// `places` as found by find_texture_places() (weld.h); `fits` has as many entries. Both are kept. Adds the texture's
  /// share to the quadrics of the vertices. The links are those of link_corners(), `coordinates` the mesh's.
  void set_up(Surface& surface, TexCoord* coordinates, std::span<std::uint32_t> places, std::span<TextureFit> fits);

  /// False where the mesh has no texture coordinates, or none that say anything (all equal, or out of any range).
  bool active() const { return active_; }

  /// As firmware::cost_edge(), with the texture's part.
  EdgeCost cost_edge(const Surface& surface, Corner edge, Placement placement) const;

  /// Before collapse_edge(): the texture's places that become one, and what they will be at `position`; moves the
  /// others.
  void begin_collapse(const Surface& surface, Corner edge, Vec3 position);
  /// After it, with the vertex that stayed, and again at `position`.
  void end_collapse(const Surface& surface, std::uint32_t vertex);

 private:
  struct PlacedFit {
    TextureFit fit;
    float s = 0, t = 0;  // at the edge's first end
  };
  static constexpr std::uint32_t kMostMembers = 2 * kMostFacesOnEdge;
  /// Places of the texture at the two ends that become one: those that share a face, taken transitively.
  struct Match {
    std::uint32_t group_count = 0;
    PlacedFit groups[kMostFacesOnEdge];
    std::uint32_t owners[kMostFacesOnEdge];  // under which place's number each group goes on
    std::uint32_t member_count = 0;
    std::uint32_t members[kMostMembers];
    std::uint32_t group_of_member[kMostMembers];

    std::uint32_t find(std::uint32_t place) const;
    void add(std::uint32_t place, std::uint32_t group);
  };
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  /// In places_[v]: vertex v may have several wedges; in places_[w]: wedge w has been moved in this collapse.
  static constexpr std::uint32_t kSeveralWedges = 1u << 31, kMoved = 1u << 30, kPlaceMask = kMoved - 1;

  std::uint32_t place_of(std::uint32_t wedge) const { return places_[wedge] & kPlaceMask; }
  bool has_several(std::uint32_t v) const { return (places_[v] & kSeveralWedges) != 0; }
  bool find_scale(const Surface& surface);
  void add_face(Surface& surface, std::uint32_t face);
  PlacedFit fit_at(std::uint32_t wedge, Vec3 from_first) const;
  void join(PlacedFit& into, const PlacedFit& from, QuadricOf<float>* sum) const;
  void add_squared_difference(const PlacedFit& one, const PlacedFit& other, QuadricOf<float>& sum) const;
  void match_face(const Surface& surface, Corner at_a, Corner at_b, Vec3 edge, Match& match,
                  QuadricOf<float>* sum) const;
  void match_edge(const Surface& surface, Corner edge, Match& match, QuadricOf<float>* sum) const;
  void move_others(const Surface& surface, std::uint32_t v, Vec3 position);
  void set_coordinate(std::uint32_t wedge, float s, float t);

  TexCoord* coordinates_ = nullptr;
  std::uint32_t* places_ = nullptr;
  TextureFit* fits_ = nullptr;
  bool active_ = false;
  float scale_ = 0;    // working units that a texture unit counts for
  Match match_;        // of the collapse being carried out
  Vec3 offset_;        // from the edge's first end to where the vertex goes
};

}  // namespace usuzumi::firmware
