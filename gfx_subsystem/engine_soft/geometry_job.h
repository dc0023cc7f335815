// One job of a round: vertices, assembly, clipping and set-up of its items, into its own bins.
#pragma once

#include "gfx_subsystem/engine_soft/clip.h"
#include "gfx_subsystem/engine_soft/triangle_setup.h"
#include "gfx_subsystem/engine_soft/vertex_stage.h"

namespace usuzumi::gfx::soft::USUZUMI_KERNEL {
namespace {

/// Vertices of the draw, by position in the draw's order, that primitives first .. first + count - 1 refer to. A fan's
/// centre is not among them.
struct VertexSpan {
  std::uint32_t first, count;
};
inline VertexSpan vertices_of(command::Topology topology, std::uint32_t first, std::uint32_t count) {
  switch (topology) {
    case command::Topology::kPoints: return {first, count};
    case command::Topology::kLines: return {2 * first, 2 * count};
    case command::Topology::kTriangles: return {3 * first, 3 * count};
    case command::Topology::kTriangleStrip: return {first, count + 2};
    case command::Topology::kTriangleFan: return {first + 1, count + 1};
  }
  return {};
}

/// Runs primitives of one draw. Pieces are the triangles a primitive is made of (clipping makes several, and so do
/// points and lines): a pool that is exhausted in between leaves a primitive half binned, and the job goes on at that
/// piece.
class DrawRun {
 public:
  DrawRun(const Round& round, Job& job, Worker& worker, Binner& binner, std::uint32_t draw)
      : d_(round.draws[draw]), job_(job), store_(d_, worker), setup_(d_, draw, binner, store_) {}

  /// False when the pool is exhausted; job.next says how far it went.
  bool run(const WorkItem& item) {
    item_first_ = item.first;
    if (d_.topology == command::Topology::kTriangleFan) {
      centre_ = d_.call.vertex(0);
      const auto centre = [&](std::uint32_t) { return centre_; };
      transform_vertices(d_, 1, centre, &centre_vertex_.vertex);
      if (d_.fragments) fetch_extras(d_, 1, centre, &centre_vertex_.extra);
    }
    while (job_.next.primitive < item.count)
      if (!run_chunk(item.first + job_.next.primitive, item.count - job_.next.primitive)) return false;
    return true;
  }

 private:
  /// Transforms and draws as many of the `count` primitives as the vertex memory holds, at least one.
  bool run_chunk(std::uint32_t first, std::uint32_t count) {
    for (;; count = (count + 1) / 2) {
      span_ = vertices_of(d_.topology, first, count);
      if (d_.call.draw.index_format == command::IndexFormat::kNone) {
        if (span_.count > store_.capacity) continue;
        base_ = d_.call.vertex(span_.first);
        transform_range(span_.count);
        return assemble(first, count, [this](std::uint32_t i) { return i - span_.first; });
      }
      std::uint32_t low, high;
      index_range(low, high);
      const std::uint32_t range = high - low + 1;
      if (range <= store_.capacity && range / 2 <= span_.count) {
        base_ = low;
        transform_range(range);
        const std::byte* indices = d_.call.indices.data();
        const std::uint32_t base = base_;
        if (d_.call.draw.index_format == command::IndexFormat::kU16)
          return assemble(first, count,
                          [=](std::uint32_t i) { return load<std::uint16_t>(indices + 2 * std::size_t{i}) - base; });
        return assemble(first, count,
                        [=](std::uint32_t i) { return load<std::uint32_t>(indices + 4 * std::size_t{i}) - base; });
      }
      if (span_.count > store_.capacity) continue;
      transform(span_.count, [this](std::uint32_t i) { return d_.call.vertex(span_.first + i); });
      return assemble(first, count, [this](std::uint32_t i) { return i - span_.first; });
    }
  }

  void transform_range(std::uint32_t count) {
    transform(count, [this](std::uint32_t i) { return base_ + i; });
  }

  template <class Source>
  void transform(std::uint32_t count, Source source) {
    transform_vertices(d_, count, source, store_.vertices);
    if (d_.fragments) fetch_extras(d_, count, source, store_.extras);
  }

  void index_range(std::uint32_t& low, std::uint32_t& high) const {
    const auto scan = [&]<class Index>(Index) {
      Index l = static_cast<Index>(-1), h = 0;
      const std::byte* p = d_.call.indices.data() + sizeof(Index) * std::size_t{span_.first};
      for (std::uint32_t i = 0; i < span_.count; ++i) {
        const Index v = load<Index>(p + sizeof(Index) * std::size_t{i});
        l = std::min(l, v);
        h = std::max(h, v);
      }
      low = l;
      high = h;
    };
    if (d_.call.draw.index_format == command::IndexFormat::kU16) scan(std::uint16_t{}); else scan(std::uint32_t{});
  }

  /// `local(i)` is the place in the worker's vertices of the draw's i-th vertex.
  template <class Local>
  bool assemble(std::uint32_t first, std::uint32_t count, Local local) {
    const Vertex* v = store_.vertices;
    const auto each = [&](auto primitive) {
      for (std::uint32_t i = first; i < first + count; ++i) {
        if (!primitive(i)) return false;
        ++job_.next.primitive;
      }
      return true;
    };
    switch (d_.topology) {
      case command::Topology::kPoints: return each([&](std::uint32_t i) { return point(v[local(i)]); });
      case command::Topology::kLines:
        return each([&](std::uint32_t i) { return line(v[local(2 * i)], v[local(2 * i + 1)], 2 * i, 2 * i + 1); });
      case command::Topology::kTriangles:
        return triangles(
            first, count, [&](std::uint32_t i, std::uint32_t k) { return 3 * i + k; },
            [&](std::uint32_t at) { return v + local(at); });
      case command::Topology::kTriangleStrip:  // every other triangle is turned to keep the winding
        return triangles(
            first, count, [](std::uint32_t i, std::uint32_t k) { return k == 2 ? i + 2 : i + ((i & 1) ^ k); },
            [&](std::uint32_t at) { return v + local(at); });
      case command::Topology::kTriangleFan:
        return triangles(first, count, [](std::uint32_t i, std::uint32_t k) { return k == 0 ? 0 : i + k; },
                         [&](std::uint32_t at) { return at == 0 ? &centre_vertex_.vertex : v + local(at); });
    }
    return true;
  }

  /// Triangles in batches: first all of a batch are examined, then the candidates among them are set up.
  /// `corner(i, k)` is the position in the draw of primitive i's corner k, the last being the provoking one.
  template <class Corner, class VertexAt>
  [[gnu::always_inline]] bool triangles(std::uint32_t first, std::uint32_t count, Corner corner, VertexAt vertex_at) {
    candidates_ = drawn_ = 0;
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Vertex &a = *vertex_at(corner(i, 0)), &b = *vertex_at(corner(i, 1)), &c = *vertex_at(corner(i, 2));
      const std::uint32_t any = a.outcode | b.outcode | c.outcode;
      if ((any & kNeedsClip) != 0) [[unlikely]] {
        if (!flush(i)) return false;
        if ((a.outcode & b.outcode & c.outcode & kViewSides) != 0) continue;
        if (!clipped_triangle(a, b, c, corner(i, 0), corner(i, 1), corner(i, 2))) return false;
        continue;
      }
      Candidate& next = candidate_[candidates_];
      next.primitive = i;
      next.drawn_before = drawn_;
      const bool outside = (a.outcode & b.outcode & c.outcode) != 0;
      std::uint32_t drawn = 0;
      const bool keep = setup_.examine(a, b, c, true, next, drawn);
      drawn_ += outside ? 0 : drawn;
      candidates_ += keep & !outside;
      if (candidates_ == kBatch && !flush(i + 1)) return false;
    }
    return flush(first + count);
  }

  /// Sets up the candidates. All primitives before `done` are then dealt with; when the pool is exhausted, those before
  /// the candidate that found it so.
  [[gnu::noinline]] bool flush(std::uint32_t done) {
    for (std::uint32_t k = 0; k < candidates_; ++k) {
      if (setup_.put(candidate_[k], candidate_[k].provoking())) [[likely]] continue;
      job_.faces_drawn += candidate_[k].drawn_before;
      job_.next.primitive = candidate_[k].primitive - item_first_;
      return false;
    }
    job_.faces_drawn += drawn_;
    job_.next.primitive = done - item_first_;
    candidates_ = drawn_ = 0;
    return true;
  }

  [[gnu::noinline]] bool clipped_triangle(const Vertex& a, const Vertex& b, const Vertex& c, std::uint32_t ia,
                                          std::uint32_t ib, std::uint32_t ic) {
    if (((a.outcode | b.outcode | c.outcode) & kNotANumber) != 0) return true;
    const ClippedPolygon p = clip_triangle(d_, {clip_vertex(a, ia), clip_vertex(b, ib), clip_vertex(c, ic)});
    std::uint32_t drawn = 0;
    for (int i = 2; i < p.corners; ++i)
      if (!piece(static_cast<std::uint32_t>(i - 2), p.corner[0].vertex, p.corner[i - 1].vertex, p.corner[i].vertex, c,
                 true, drawn))
        return false;
    job_.next.piece = 0;
    ++job_.next.primitive;
    job_.faces_drawn += drawn != 0;
    return true;
  }

  /// A square around the vertex. A point is drawn whole or, with its vertex outside the view volume, not at all.
  bool point(const Vertex& v) {
    if (v.outcode != 0) return true;
    const std::int32_t h = d_.point_half_size;
    const PlacedVertex centre = placed(v);
    PlacedVertex corner[4] = {centre, centre, centre, centre};
    corner[0].vertex.x = corner[3].vertex.x = v.x - h;
    corner[1].vertex.x = corner[2].vertex.x = v.x + h;
    corner[0].vertex.y = corner[1].vertex.y = v.y - h;
    corner[2].vertex.y = corner[3].vertex.y = v.y + h;
    return quad(corner, v);
  }

  /// A parallelogram, widened by half the line width to both sides along the axis in which the line is shorter.
  bool line(const Vertex& a, const Vertex& b, std::uint32_t ia, std::uint32_t ib) {
    if ((a.outcode & b.outcode & kViewSides) != 0) return true;
    PlacedVertex end[2] = {placed(a), placed(b)};
    if (((a.outcode | b.outcode) & kNeedsClip) != 0) {
      if (((a.outcode | b.outcode) & kNotANumber) != 0 ||
          !clip_segment(d_, {clip_vertex(a, ia), clip_vertex(b, ib)}, end))
        return true;
    }
    const std::int32_t h = d_.line_half_width;
    const Vertex &from = end[0].vertex, &to = end[1].vertex;
    const bool wide = std::abs(to.x - from.x) >= std::abs(to.y - from.y);
    PlacedVertex corner[4] = {end[0], end[1], end[1], end[0]};
    for (int i = 0; i < 4; ++i) (wide ? corner[i].vertex.y : corner[i].vertex.x) += i < 2 ? -h : h;
    return quad(corner, b);
  }

  /// Two triangles; neither culled nor counted as faces.
  bool quad(const PlacedVertex (&corner)[4], const Vertex& provoking) {
    std::uint32_t drawn = 0;
    if (!piece(0, corner[0].vertex, corner[1].vertex, corner[2].vertex, provoking, false, drawn) ||
        !piece(1, corner[0].vertex, corner[2].vertex, corner[3].vertex, provoking, false, drawn))
      return false;
    job_.next.piece = 0;
    return true;
  }

  /// A flat piece takes the primitive's provoking vertex, whose place among the corners clipping may have lost.
  [[gnu::noinline]] bool piece(std::uint32_t number, const Vertex& a, const Vertex& b, const Vertex& c,
                               const Vertex& provoking, bool may_cull, std::uint32_t& drawn) {
    Candidate candidate;
    if (setup_.examine(a, b, c, may_cull, candidate, drawn) && number >= job_.next.piece &&
        !setup_.put(candidate, provoking))
      return false;
    job_.next.piece = std::max(job_.next.piece, number + 1);
    return true;
  }

  PlacedVertex placed(const Vertex& v) const { return {v, d_.fragments ? store_.extra_of(v) : VertexExtra{}}; }

  /// The vertex before projection, by the arithmetic of the vertex stage.
  ClipVertex clip_vertex(const Vertex& v, std::uint32_t position_in_draw) const {
    const std::uint32_t vertex = d_.call.vertex(position_in_draw);
    const Vec3 p = fetch<Vec3>(d_.positions, d_.streams.position_stride, vertex, 0);
    return {transform_point(d_.transform, p), {v.red, v.green, v.blue}, placed(v).extra};
  }

  const DrawSetup& d_;
  Job& job_;
  VertexStore store_;
  TriangleSetup setup_;
  VertexSpan span_{};
  static constexpr std::uint32_t kBatch = 64;
  Candidate candidate_[kBatch + 1];  // one more to examine into
  std::uint32_t candidates_ = 0, drawn_ = 0;
  std::uint32_t item_first_ = 0;
  std::uint32_t base_ = 0;
  std::uint32_t centre_ = 0;
  PlacedVertex centre_vertex_{};
};

inline bool bin_clear(const Round& r, Binner& binner, std::uint32_t index) {
  const PixelRect& rect = r.clears[index].rect;
  const TileRange range{rect.x0 / kTileSize, rect.y0 / kTileSize, (rect.x1 - 1) / kTileSize, (rect.y1 - 1) / kTileSize};
  if (!binner.reserve(0, range)) return false;
  binner.append(range, static_cast<std::uint32_t>(EntryKind::kClear) << kEntryKindShift | index);
  return true;
}

void run_geometry(const Round& r, Job& job, Worker& worker) {
  Binner binner(*r.pool, r.grid, job.lists);
  for (; job.next.item < job.end_item; ++job.next.item, job.next.primitive = 0) {
    const WorkItem& item = r.items[job.next.item];
    const bool done =
        item.is_clear ? bin_clear(r, binner, item.index) : DrawRun(r, job, worker, binner, item.index).run(item);
    if (!done) return;
  }
  job.complete = true;
}

}  // namespace
}  // namespace usuzumi::gfx::soft::USUZUMI_KERNEL
