// Which vertices and edges lie on a seam: where normals, colours, texture coordinates or materials jump, or the surface
// ends. The terms are those of CN101231761A, claim 1.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

/// What the cost of the half-edge from vs to vt asks for.
struct SeamRelation {
  bool from_seam = false;   // IsSeam(vs)
  bool from_cross = false;  // IsCross(vs)
  bool to_seam = false;     // IsSeam(vt)
  bool edge_seam = false;   // IsSeam(vs, vt)
  bool splits = false;      // a seam that ends at vt begins with the edge: one wedge of vs, several of vt
  bool leaves_border = false;  // vs lies on an open border and the edge does not: never collapsed

  /// Some term of the cost is a penalty.
  bool is_penalised() const {
    return (from_seam && !to_seam) || (from_seam && to_seam && !edge_seam) || (from_cross && to_seam) || splits;
  }
};

/// An edge is on a seam where its two faces name different wedges at both of its ends, or where it has not two faces
/// that run opposite ways: open borders are seams, beyond which there is nothing. Where they differ at one end alone,
/// the seam has come to its end there: at the pole of a globe every face has a wedge of its own, and yet its meridians
/// are no seams.
///
/// IsSeam(v): v has several wedges, or an edge there is on a seam. IsCross(v): v is a seam vertex, and the number of
/// its seam edges is not two: seams meet or end there.
class Seams {
 public:
  Seams() = default;
  /// `words`: one per vertex. set_initial_quadrics() has found the singular vertices.
  Seams(Surface& surface, std::span<std::uint32_t> words) : surface_(&surface), words_(words.data()) {}

  /// Looks at every vertex.
  void find();
  /// Looks at one again, whose faces or their wedges have changed. True where that makes it a seam vertex or a cross,
  /// or no longer one.
  bool update(std::uint32_t v);

  bool is_seam(std::uint32_t v) const { return (words_[v] & kSeam) != 0; }
  /// One of the two is a seam vertex.
  bool touches(std::uint32_t a, std::uint32_t b) const { return ((words_[a] | words_[b]) & kSeam) != 0; }
  bool is_cross(std::uint32_t v) const { return (words_[v] & kCross) != 0; }
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  /// IsSeam(vs, vt), but for an edge along which a seam would fold: where vs is no cross and going to vt lays its two
  /// seam edges onto each other, an island, or a strip between two seams, of one face goes. Such an edge does not
  /// count.
  struct Edge {
    bool is_seam = false;
    bool is_border = false;
    bool folds = false;  // looked for only where the edge is a seam and one end is no cross
    std::uint32_t seam_end = kNone;  // the end at which alone the faces' wedges differ
  };
  /// The same seen from either end.
  Edge look_at_edge(std::uint32_t a, std::uint32_t b) const;
  SeamRelation relation(std::uint32_t from, std::uint32_t to, const Edge& edge) const;

 private:
  static constexpr std::uint32_t kSeam = 1u << 31, kCross = 1u << 30;  // below: a corner, while a vertex is looked at

  Edge edge(std::uint32_t a, std::uint32_t b) const;
  bool folds(std::uint32_t a, std::uint32_t b) const;
  bool has_several_wedges(std::uint32_t v) const;
  bool may_touch_seam(std::uint32_t v) const;
  bool wedges_differ_there(Corner one, Corner other, std::uint32_t other_end) const;
  bool wedges_differ(Corner one, Corner other, std::uint32_t other_end) const;
  std::uint32_t count_seam_edges(std::uint32_t v);

  Surface* surface_ = nullptr;
  std::uint32_t* words_ = nullptr;
};

}  // namespace usuzumi::firmware
