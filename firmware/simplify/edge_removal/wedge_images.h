// The image at the vertex that stays: US 6,396,952, p. 23-27, figs. 6 to 8. Nothing is pasted again; the texture
// coordinates of the two ends merge by the same t as their positions, vt' = (1 - t) vt1 + t vt2.
#pragma once

#include <cstdint>

#include "firmware/simplify/attributes.h"
#include "firmware/simplify/collapse_rules.h"
#include "firmware/simplify/edge_removal/image_border.h"
#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

/// The wedges that meet in the faces on an edge, a pair for each face at most, and what both become. On a seam the two
/// faces give two pairs, and both sides move together. A wedge that no face on the edge names follows the one at the
/// same end that shows the same image (they differ in their normals).
class WedgeImages {
 public:
  /// False where the image would tear with the vertex at `t`: some wedge's image would be left behind, or two faces on
  /// the edge disagree about what it becomes. An end that stays where it is (t = 0 or 1) keeps its own images.
  bool plan(const Surface& surface, const Images& images, const Neighbourhood& n, float t);

  /// Gives every wedge at both ends of the planned edge its new image, before the edge is collapsed. Spends the marks
  /// of these wedges but their flags.
  void apply(Surface& surface, const WedgeAttributes& attributes) const;

 private:
  struct Pair {
    std::uint32_t a = 0, b = 0;  // wedges
    TexCoord old_a, old_b, texture_coordinate;
    Rgba8 old_colour_a, old_colour_b, colour;
  };
  bool end_has_images(const Surface& surface, const Images& images, std::uint32_t v, bool is_a) const;
  const Pair* pair_of(std::uint32_t wedge, bool is_a) const;

  const Images* images_ = nullptr;
  std::uint32_t a_ = 0, b_ = 0;
  std::uint32_t count_ = 0;
  Pair pairs_[kMostFacesOnEdge];
};

}  // namespace usuzumi::firmware
