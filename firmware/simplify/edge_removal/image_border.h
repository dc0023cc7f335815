// Where the image on a surface ends or changes: texture boundaries (US 6,396,952, p. 27-30, figs. 9 and 10).
//
// The image at a wedge is its texture coordinates, its colour and its group of faces (material). An edge is a boundary
// where its two faces disagree about the image at both ends, or where it has not two faces that run opposite ways: on
// the device a texture may end where its mesh does. Where they disagree at one end alone, a boundary comes to a point:
// at the pole of a globe every face has an image of its own, but along the meridians it is one image. Normals do not
// count: a crease is a matter of shape.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/simplify/simplify.h"
#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

struct Images {
  const TexCoord* texture_coordinates = nullptr;  // by wedge; null where absent
  const Rgba8* colours = nullptr;
  std::span<const MaterialGroup> groups = {};

  std::uint32_t group_of(std::uint32_t wedge) const {
    std::uint32_t g = 0;
    while (g + 1 < groups.size() && wedge >= groups[g].vertex_end) ++g;
    return g;
  }
  bool same(std::uint32_t a, std::uint32_t b) const {
    return a == b || ((texture_coordinates == nullptr || texture_coordinates[a] == texture_coordinates[b]) &&
                      (colours == nullptr || colours[a] == colours[b]) &&
                      (groups.size() < 2 || group_of(a) == group_of(b)));
  }
};

/// An edge where images differ, as seen from one of its ends.
struct BorderEdge {
  std::uint32_t other = 0;      // the other end
  Corner one = kNoCorner;       // the half-edge of a face on it
  Corner two = kNoCorner;       // of the other face; kNoCorner where it has not two that run opposite ways
  bool here = true, there = true;  // the faces disagree at this end, at the other; both where it has not two faces

  bool is_boundary() const { return here && there; }
};

/// The half-edges of the two faces on an edge, which run opposite ways, disagree about the image where `one` begins.
inline bool images_differ_at_begin(const Surface& s, const Images& images, Corner one, Corner two) {
  return !images.same(s.indices[corner_index(one)], s.indices[corner_index(next_in_face(two))]);
}
/// They disagree at both ends.
inline bool images_differ(const Surface& s, const Images& images, Corner one, Corner two) {
  return images_differ_at_begin(s, images, one, two) && images_differ_at_begin(s, images, two, one);
}

/// Calls visit(BorderEdge) for every edge at vertex `v` where images differ at either end, each once. Spends the marks
/// of the vertices around it but their flags; `visit` leaves the marks alone.
template <class Visit>
void visit_border_edges(Surface& s, const Images& images, std::uint32_t v, Visit visit) {
  // In Place::mark of a neighbour: 0, or one of these, or one more than the corner of `v` after which it comes.
  constexpr std::uint32_t kMany = 0x3FFFFFFFu;  // it comes after `v` in more faces than one
  constexpr std::uint32_t kMet = 0x3FFFFFFEu;   // the edge has been seen to, as one without a difference
  constexpr std::uint32_t kTold = 0x3FFFFFFDu;  // ... as one with
  static_assert(4 * (kMostFaces - 1) + 3 < kTold);
  const auto mark_of = [&](std::uint32_t u) { return s.places[u].mark & ~kPlaceFlags; };
  const auto set_mark = [&](std::uint32_t u, std::uint32_t mark) {
    s.places[u].mark = (s.places[u].mark & kPlaceFlags) | mark;
  };
  const auto clear_marks = [&] {
    for (Corner c = s.first_corner(v); c != kNoCorner; c = s.next_corner_of(c)) {
      set_mark(s.vertex_at(next_in_face(c)), 0);
      set_mark(s.vertex_at(previous_in_face(c)), 0);
    }
  };
  clear_marks();
  for (Corner c = s.first_corner(v); c != kNoCorner; c = s.next_corner_of(c)) {
    const std::uint32_t out = s.vertex_at(next_in_face(c));
    set_mark(out, mark_of(out) == 0 ? c + 1 : kMany);
  }
  for (Corner c = s.first_corner(v); c != kNoCorner; c = s.next_corner_of(c)) {
    const Corner half_edge = previous_in_face(c);
    const std::uint32_t in = s.vertex_at(half_edge), mark = mark_of(in);
    if (mark == kTold) continue;
    if (mark == 0 || mark == kMany || mark == kMet) {
      visit(BorderEdge{in, half_edge, kNoCorner});
      set_mark(in, kTold);
    } else {
      const bool here = images_differ_at_begin(s, images, mark - 1, half_edge);
      const bool there = images_differ_at_begin(s, images, half_edge, mark - 1);
      if (here || there) visit(BorderEdge{in, mark - 1, half_edge, here, there});
      set_mark(in, here || there ? kTold : kMet);
    }
  }
  for (Corner c = s.first_corner(v); c != kNoCorner; c = s.next_corner_of(c)) {
    const std::uint32_t out = s.vertex_at(next_in_face(c)), mark = mark_of(out);
    if (mark == kTold || mark == kMet) continue;
    visit(BorderEdge{out, c, kNoCorner});
    set_mark(out, kTold);
  }
  clear_marks();
}

}  // namespace usuzumi::firmware
