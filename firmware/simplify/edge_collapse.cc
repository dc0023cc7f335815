#include "firmware/simplify/edge_collapse.h"

namespace usuzumi::firmware {
namespace {

struct Merge {
  Surface& surface;
  const Neighbourhood& n;
  std::uint32_t keep, remove;
  std::uint32_t representatives_lost[kMostFacesOnEdge] = {};  // by apex, of the two edges that fall together there
  Corner last = kNoCorner;                                    // end of the list being built

  void append(Corner c) {
    if (last == kNoCorner) {
      surface.vertices[keep].first_corner = c;
    } else {
      std::uint32_t& link = surface.links[last];
      link = (link & ~kCornerMask) | c;
    }
    last = c;
  }

  // `at_keep` and `at_remove` are the face's corners at the two ends.
  void remove_face(Corner at_keep, Corner at_remove, Corner at_apex) {
    const std::uint32_t apex = surface.vertex_at(at_apex);
    std::uint32_t i = 0;
    while (n.apexes[i] != apex) ++i;
    // The half-edge from one end to the other is the collapsed edge; the other two are the apex's.
    const Corner collapsed = next_in_face(at_keep) == at_remove ? at_keep : at_remove;
    for (Corner c = next_in_face(collapsed); c != collapsed; c = next_in_face(c))
      if ((surface.links[c] & kRepresentative) != 0) ++representatives_lost[i];
    unlink_corner(surface, apex, at_apex);
    const Corner first = at_apex & ~Corner{3};
    surface.indices[corner_index(first)] = kDeadFace;
    // The links stay: the other end's list is still to be walked across this face.
    for (Corner c = first; c < first + 3; ++c) surface.links[c] &= kCornerMask;
  }

  // Of the two edges that have become one towards `apex`, leaves one representative. The corner that was newly chosen,
  // or kNoCorner where one of the old ones stays.
  Corner join_edges(std::uint32_t apex, std::uint32_t lost) {
    if (lost == 1) return kNoCorner;
    Corner found = kNoCorner;
    for (Corner c = surface.first_corner(keep); c != kNoCorner; c = surface.next_corner_of(c)) {
      Corner half_edge = kNoCorner;
      if (surface.vertex_at(next_in_face(c)) == apex) half_edge = c;
      else if (surface.vertex_at(previous_in_face(c)) == apex) half_edge = previous_in_face(c);
      else continue;
      std::uint32_t& flags = surface.links[half_edge];
      if (lost == 2) {
        flags |= kRepresentative;
        return half_edge;
      }
      if ((flags & kRepresentative) == 0) continue;
      if (found == kNoCorner) {
        found = half_edge;
        continue;
      }
      // Two: a refused one goes; of two others either, for what has no entry among the candidates is found by a later
      // fill.
      std::uint32_t& first_flags = surface.links[found];
      std::uint32_t& drop = (first_flags & kRefused) != 0 ? first_flags : flags;
      drop &= ~(kRepresentative | kRefused);
      return kNoCorner;
    }
    return kNoCorner;
  }

  // When all the corners have been appended.
  void finish(CollapsedEdge& result) {
    append(kNoCorner);
    surface.vertices[remove].first_corner = kNoCorner;
    for (std::uint32_t i = 0; i < n.apex_count; ++i) {
      const Corner chosen = join_edges(n.apexes[i], representatives_lost[i]);
      if (chosen != kNoCorner) result.uncosted[result.uncosted_count++] = chosen;
    }
  }
};

}  // namespace

CollapsedEdge collapse_edge(Surface& surface, std::uint32_t* vertex_of_wedge, const WedgeAttributes& attributes,
                            const Neighbourhood& n, AttributeShares shares) {
  const bool a_stays = n.a < n.b;
  Merge merge{.surface = surface, .n = n, .keep = a_stays ? n.a : n.b, .remove = a_stays ? n.b : n.a};
  const AttributeShares of_removed = a_stays ? shares : shares.reversed();
  CollapsedEdge result;
  result.vertex = merge.keep;

  WedgePairs& pairs = result.pairs;
  const bool has_wedges = attributes.any() || vertex_of_wedge != nullptr;
  const Corner first_removed = surface.first_corner(merge.remove);
  for (Corner c = surface.first_corner(merge.keep), next; c != kNoCorner; c = next) {
    next = surface.next_corner_of(c);
    const Corner out = next_in_face(c), in = previous_in_face(c);
    const bool out_removed = surface.vertex_at(out) == merge.remove;
    if (!out_removed && surface.vertex_at(in) != merge.remove) {
      merge.append(c);
      continue;
    }
    const Corner at_remove = out_removed ? out : in;
    const std::uint32_t kept = surface.indices[corner_index(c)];
    const std::uint32_t removed = surface.indices[corner_index(at_remove)];
    if (pairs.add(kept, removed) && attributes.any()) attributes.mix(kept, removed, of_removed);
    const Corner at_apex = out_removed ? in : out;
    result.removed[result.faces_removed++] = {c >> 2, kept, removed, surface.vertex_at(at_apex),
                                              surface.indices[corner_index(at_apex)]};
    merge.remove_face(c, at_remove, at_apex);
  }
  for (Corner c = first_removed, next; c != kNoCorner; c = next) {
    next = surface.next_corner_of(c);
    if (surface.is_dead(c >> 2)) continue;
    std::uint32_t& wedge = surface.indices[corner_index(c)];
    if (!has_wedges) {
      wedge = merge.keep;
    } else {
      wedge = pairs.successor(wedge);
      if (vertex_of_wedge != nullptr) vertex_of_wedge[wedge] = merge.keep;
    }
    if (result.first_from_removed == kNoCorner) result.first_from_removed = c;
    merge.append(c);
  }
  merge.finish(result);
  return result;
}

CollapsedEdge collapse_half_edge(Surface& surface, const Neighbourhood& n) {
  Merge merge{.surface = surface, .n = n, .keep = n.b, .remove = n.a};
  CollapsedEdge result;
  result.vertex = n.b;
  const Corner first_removed = surface.first_corner(n.a);
  for (Corner c = surface.first_corner(n.b), next; c != kNoCorner; c = next) {
    next = surface.next_corner_of(c);
    const Corner out = next_in_face(c), in = previous_in_face(c);
    const bool out_removed = surface.vertex_at(out) == n.a;
    if (!out_removed && surface.vertex_at(in) != n.a) {
      merge.append(c);
      continue;
    }
    const Corner at_removed = out_removed ? out : in, at_apex = out_removed ? in : out;
    result.removed[result.faces_removed++] = {
        c >> 2, surface.indices[corner_index(c)], surface.indices[corner_index(at_removed)],
        surface.vertex_at(at_apex), surface.indices[corner_index(at_apex)]};
    merge.remove_face(c, at_removed, at_apex);
  }
  for (Corner c = first_removed, next; c != kNoCorner; c = next) {
    next = surface.next_corner_of(c);
    if (!surface.is_dead(c >> 2)) merge.append(c);
  }
  merge.finish(result);
  return result;
}

}  // namespace usuzumi::firmware
