#include "firmware/simplify/half_edge/seams.h"

namespace usuzumi::firmware {
namespace {

// Place::mark while a vertex looks at its edges; bits 0-9 are free between two trials of CollapseRules, which clears
// them itself: faces on the edge (0-1, stops at three), they run out, in, their wedges differ, the edge is counted.
constexpr std::uint32_t kFacesMask = 3;
constexpr std::uint32_t kRunsOut = 1u << 2, kRunsIn = 1u << 3, kDiffers = 1u << 4, kCounted = 1u << 5;
constexpr std::uint32_t kLookMask = (1u << 6) - 1;

}  // namespace

void Seams::find() {
  const Surface& s = *surface_;
  bool any = false;
  for (std::uint32_t v = 0; v < s.vertex_count; ++v) {
    const bool seam = (s.places[v].mark & kSingular) != 0 || has_several_wedges(v);
    words_[v] = seam ? kSeam : 0;
    any = any || seam;
  }
  if (!any) return;
  for (std::uint32_t v = 0; v < s.vertex_count; ++v)
    if (may_touch_seam(v)) update(v);
}

// A seam edge has an end with several wedges, or is a border.
bool Seams::may_touch_seam(std::uint32_t v) const {
  const Surface& s = *surface_;
  std::uint32_t words = words_[v];
  for (Corner c = s.first_corner(v); c != kNoCorner; c = s.next_corner_of(c))
    words |= words_[s.vertex_at(next_in_face(c))] | words_[s.vertex_at(previous_in_face(c))];
  return (words & kSeam) != 0;
}

bool Seams::has_several_wedges(std::uint32_t v) const {
  const Surface& s = *surface_;
  const Corner first = s.first_corner(v);
  if (first == kNoCorner || s.vertex_of_wedge == nullptr) return false;
  const std::uint32_t wedge = s.indices[corner_index(first)];
  for (Corner c = s.next_corner_of(first); c != kNoCorner; c = s.next_corner_of(c))
    if (s.indices[corner_index(c)] != wedge) return true;
  return false;
}

bool Seams::update(std::uint32_t v) {
  const std::uint32_t before = words_[v] & (kSeam | kCross);
  words_[v] = 0;
  if (surface_->first_corner(v) != kNoCorner) {
    const std::uint32_t edges = count_seam_edges(v);
    words_[v] = edges == 0 && !has_several_wedges(v) ? 0 : kSeam | (edges != 2 ? kCross : 0);
  }
  return words_[v] != before;
}

// Do the faces of corners `one` and `other` of a vertex, both on the edge to `other_end`, name different wedges there?
bool Seams::wedges_differ_there(Corner one, Corner other, std::uint32_t other_end) const {
  const Surface& s = *surface_;
  const auto wedge_there = [&](Corner c) {
    const Corner next = next_in_face(c);
    return s.indices[corner_index(s.vertex_at(next) == other_end ? next : previous_in_face(c))];
  };
  return wedge_there(one) != wedge_there(other);
}

// At both ends?
bool Seams::wedges_differ(Corner one, Corner other, std::uint32_t other_end) const {
  return surface_->indices[corner_index(one)] != surface_->indices[corner_index(other)] &&
         wedges_differ_there(one, other, other_end);
}

std::uint32_t Seams::count_seam_edges(std::uint32_t v) {
  const Surface& s = *surface_;
  for (Corner c = s.first_corner(v); c != kNoCorner; c = s.next_corner_of(c))
    for (const Corner other : {next_in_face(c), previous_in_face(c)}) s.places[s.vertex_at(other)].mark &= ~kLookMask;
  for (Corner c = s.first_corner(v); c != kNoCorner; c = s.next_corner_of(c)) {
    for (const Corner other : {next_in_face(c), previous_in_face(c)}) {
      const std::uint32_t x = s.vertex_at(other);
      std::uint32_t& mark = s.places[x].mark;
      std::uint32_t& word = words_[x];
      if ((mark & kFacesMask) == 0) word = (word & ~kCornerMask) | c;
      else if (wedges_differ(word & kCornerMask, c, x)) mark |= kDiffers;
      if ((mark & kFacesMask) < kFacesMask) ++mark;
      mark |= other == next_in_face(c) ? kRunsOut : kRunsIn;
    }
  }
  std::uint32_t seam_edges = 0;
  for (Corner c = s.first_corner(v); c != kNoCorner; c = s.next_corner_of(c)) {
    for (const Corner other : {next_in_face(c), previous_in_face(c)}) {
      std::uint32_t& mark = s.places[s.vertex_at(other)].mark;
      if ((mark & kCounted) != 0) continue;
      if ((mark & (kFacesMask | kRunsOut | kRunsIn | kDiffers)) != (2 | kRunsOut | kRunsIn)) ++seam_edges;
      mark |= kCounted;
    }
  }
  return seam_edges;
}

Seams::Edge Seams::edge(std::uint32_t a, std::uint32_t b) const {
  const Surface& s = *surface_;
  std::uint32_t faces = 0, out = 0;
  Corner first = kNoCorner;
  Edge result;
  for (Corner c = s.first_corner(a); c != kNoCorner; c = s.next_corner_of(c)) {
    const bool runs_out = s.vertex_at(next_in_face(c)) == b;
    if (!runs_out && s.vertex_at(previous_in_face(c)) != b) continue;
    ++faces;
    out += runs_out ? 1u : 0u;
    if (first == kNoCorner) {
      first = c;
      continue;
    }
    const bool here = s.indices[corner_index(first)] != s.indices[corner_index(c)];
    const bool there = wedges_differ_there(first, c, b);
    result.is_seam = result.is_seam || (here && there);
    if (here != there) result.seam_end = here ? a : b;
  }
  result.is_border = faces != 2 || out != 1;
  result.is_seam = result.is_seam || result.is_border;
  return result;
}

bool Seams::folds(std::uint32_t a, std::uint32_t b) const {
  const Surface& s = *surface_;
  for (Corner c = s.first_corner(a); c != kNoCorner; c = s.next_corner_of(c)) {
    const std::uint32_t p = s.vertex_at(next_in_face(c)), q = s.vertex_at(previous_in_face(c));
    if (p != b && q != b) continue;
    const std::uint32_t apex = p == b ? q : p;
    if (is_seam(apex) && edge(a, apex).is_seam && edge(b, apex).is_seam) return true;
  }
  return false;
}

Seams::Edge Seams::look_at_edge(std::uint32_t a, std::uint32_t b) const {
  if (!touches(a, b)) return {};
  Edge result = edge(a, b);
  result.folds = result.is_seam && !(is_cross(a) && is_cross(b)) && folds(a, b);
  return result;
}

SeamRelation Seams::relation(std::uint32_t from, std::uint32_t to, const Edge& edge) const {
  SeamRelation r{.from_seam = is_seam(from), .from_cross = is_cross(from), .to_seam = is_seam(to)};
  r.edge_seam = edge.is_seam && (r.from_cross || !edge.folds);
  r.splits = edge.seam_end == to;
  r.leaves_border = (surface_->places[from].mark & kSingular) != 0 && !edge.is_border;
  return r;
}

}  // namespace usuzumi::firmware
