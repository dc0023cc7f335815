// The order in which a method takes a mesh's edges: cheapest first, region by region up to a cost that rises from pass
// to pass (qem/edge_candidates.h says why). What an edge costs, and whether it collapses, is the method's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/simplify/edge_key.h"
#include "firmware/simplify/qem/edge_candidates.h"
#include "firmware/simplify/qem/edge_queue.h"
#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

/// Candidates kept by a fill: a sixth of a closed surface's edges. A fill's horizon is then low, so that most edges
/// that grow dearer leave the table at once and are found again by a later fill, many at a time; more were measured to
/// be slower. Small meshes keep half of their edges: there a fill is what costs. Both numbers by measuring QEM.
constexpr std::uint64_t edge_candidate_slots(std::uint64_t face_count) {
  constexpr std::uint64_t kCandidatesOfSmallMeshes = 2048;
  const std::uint64_t some = face_count / 4;
  const std::uint64_t half = face_count * 3 / 4 + 16;
  const std::uint64_t least = half < kCandidatesOfSmallMeshes ? half : kCandidatesOfSmallMeshes;
  return some > least ? some : least;
}
/// Edges taken from the candidates at a time. Their part of the mesh (mostly five to ten thousand faces, 58 bytes each
/// with their vertices) is to stay in the nearer caches. By measuring.
constexpr std::uint64_t edge_batch_size(std::uint64_t face_count) {
  constexpr std::uint64_t kMostInBatch = 2048;
  const std::uint64_t slots = edge_candidate_slots(face_count);
  return slots < kMostInBatch ? slots : kMostInBatch;
}
/// A batch, and room for edges that collapses bring up.
constexpr std::uint64_t edge_queue_slots(std::uint64_t face_count) {
  return edge_batch_size(face_count) + edge_batch_size(face_count) / 8;
}

class EdgePasses {
 public:
  EdgePasses() : candidates_({}), queue_({}) {}
  /// Spans of edge_candidate_slots() and edge_queue_slots() keys.
  EdgePasses(const Surface& surface, std::span<EdgeKey> candidates, std::span<EdgeKey> queue, std::size_t batch_size)
      : surface_(&surface), candidates_(candidates), queue_(queue), batch_size_(batch_size) {}

  static constexpr std::uint32_t kEdgesAtOnce = 256;  // offered in one go; arbitrary

  /// Looks through all edges that are not kRefused: `offer(span of representatives)` calls add() for those that it
  /// wants. False where there are none.
  template <class Offer>
  bool fill(Offer offer);
  void add(EdgeKey key) { candidates_.offer(key); }

  bool empty() const { return candidates_.size() == 0; }
  void clear() { candidates_.begin_fill(); }
  std::size_t batch_size() const { return batch_size_; }
  /// The least key of the candidates.
  EdgeKey least() const { return candidates_.key_of_rank(0); }

  /// Takes the candidates below `cap` that cost less than all but `rank` of them, region by region, until
  /// `next(key)` is false. While a pass runs, put_off() brings an edge to its place in it or in a later one.
  template <class Next>
  void run(std::size_t rank, EdgeKey cap, Next next);
  /// False where it found no room in its place, so that dearer edges may come before it.
  bool put_off(EdgeKey key) {
    if (key < limit_ && queue_.push(key)) return true;
    return candidates_.keep(key) && key >= limit_;
  }
  /// True where `key` is the next of the pass even though the edge has become that dear.
  bool is_next(EdgeKey key) const { return key <= queue_.top() && key < limit_; }

 private:
  void fetch_vertex_at(Corner c);
  void fetch_region(std::span<const EdgeKey> batch);
  void fetch_ahead();

  const Surface* surface_ = nullptr;
  EdgeCandidates candidates_;
  EdgeQueue queue_;  // a batch of candidates
  std::size_t batch_size_ = 0;
  EdgeKey limit_ = 0;  // of the pass: what costs more is left for a later one
};

template <class Offer>
bool EdgePasses::fill(Offer offer) {
  // Found first and costed after, a block at a time: each loop then runs without surprises for the processor.
  Corner edges[kEdgesAtOnce + 3];
  std::uint32_t count = 0;
  candidates_.begin_fill();
  for (std::uint32_t face = 0; face < surface_->face_count; ++face) {
    const std::uint32_t* links = surface_->links + std::size_t{face} * 4;
    for (std::uint32_t k = 0; k < 3; ++k) {
      // Stored in any case, counted where it stands for an edge: as good as random, so no branch.
      edges[count] = face * 4 + k;
      count += (links[k] & (kRepresentative | kRefused)) == kRepresentative ? 1u : 0u;
    }
    if (count < kEdgesAtOnce) continue;
    offer(std::span<const Corner>(edges, kEdgesAtOnce));
    count -= kEdgesAtOnce;
    for (std::uint32_t i = 0; i < count; ++i) edges[i] = edges[kEdgesAtOnce + i];
  }
  if (count > 0) offer(std::span<const Corner>(edges, count));
  return candidates_.size() > 0;
}

template <class Next>
void EdgePasses::run(std::size_t rank, EdgeKey cap, Next next) {
  limit_ = candidates_.key_of_rank(rank);
  limit_ = limit_ < cap ? limit_ : cap;
  candidates_.begin_pass();
  for (;;) {
    const std::size_t count = candidates_.take(limit_, queue_.slots().first(batch_size_));
    if (count == 0) return;
    fetch_region(queue_.slots().first(count));
    queue_.start(count);
    while (!queue_.empty()) {
      const EdgeKey key = queue_.pop();
      fetch_ahead();
      if (!next(key)) return;
    }
  }
}

// Inlined by force, as those below: GCC takes a function that only prefetches for one without effect, and drops the
// call. A vertex may lie on two cache lines.
[[gnu::always_inline]] inline void EdgePasses::fetch_vertex_at(Corner c) {
  const std::uint32_t v = surface_->vertex_at(c);
  __builtin_prefetch(&surface_->places[v]);
  __builtin_prefetch(&surface_->vertices[v]);
  __builtin_prefetch(&surface_->vertices[v].first_corner);
}

// Asks for the batch's part of the mesh in the order it lies in memory; the batch then goes about in it by cost.
[[gnu::always_inline]] inline void EdgePasses::fetch_region(std::span<const EdgeKey> batch) {
  std::uint32_t first = surface_->face_count, last = 0;
  for (const EdgeKey key : batch) {
    const std::uint32_t face = edge_of(key) >> 2;
    first = face < first ? face : first;
    last = face > last ? face : last;
  }
  constexpr std::size_t kMostFacesPerEdge = 64;  // beyond, most of what would be asked for is not needed; arbitrary
  if ((last - first) / kMostFacesPerEdge > batch.size()) return;
  for (std::uint32_t face = first; face <= last; ++face) {
    if (surface_->is_dead(face)) continue;
    __builtin_prefetch(&surface_->links[face * 4]);
    for (std::uint32_t k = 0; k < 3; ++k) fetch_vertex_at(face * 4 + k);
  }
}

// What the next edges of the batch will need is asked for while this one is worked on.
[[gnu::always_inline]] inline void EdgePasses::fetch_ahead() {
  constexpr std::size_t kFar = 8, kNear = 4;
  if (queue_.run_left() <= kFar) return;
  const Corner far = edge_of(queue_.in_run(kFar));
  __builtin_prefetch(&surface_->links[far]);
  __builtin_prefetch(&surface_->indices[corner_index(far)]);
  const Corner near = edge_of(queue_.in_run(kNear));
  if ((surface_->links[near] & kRepresentative) == 0) return;
  fetch_vertex_at(near);
  fetch_vertex_at(next_in_face(near));
}

}  // namespace usuzumi::firmware
