// Quadric error edge collapse: Garland & Heckbert 1997, section 4; patent JP2015-22462A steps S801-S808.
//
// Where we depart from the paper: quadrics are relative to their vertices (quadric.h); pairs are edges only; an edge's
// cost is brought up to date when the edge comes to the front of the queue, not at every collapse beside it. Costs
// mostly rise as quadrics are summed, and then that is the same order; an edge whose cost has fallen (by midpoint
// placement, by the pull towards the edge's middle or where the minimum could not be used) is taken later than it might
// be. And edges are not ordered over the whole mesh but region by region up to a cost that rises from pass to pass
// (edge_candidates.h): memory is then walked along, not jumped about in, and the time per face hardly grows with the
// mesh.
#include "firmware/simplify/qem/qem.h"

#include <cmath>

#include "firmware/simplify/attributes.h"
#include "firmware/simplify/collapse_rules.h"
#include "firmware/simplify/edge_collapse.h"
#include "firmware/simplify/initial_quadrics.h"
#include "firmware/simplify/log_recorder.h"
#include "firmware/simplify/qem/edge_candidates.h"
#include "firmware/simplify/qem/edge_cost.h"
#include "firmware/simplify/qem/edge_queue.h"
#include "firmware/simplify/qem/qem_scratch.h"
#include "firmware/simplify/qem/texture_error.h"
#include "firmware/simplify/surface.h"
#include "firmware/simplify/working_surface.h"

namespace usuzumi::firmware {
namespace {

constexpr std::uint32_t kEdgesAtOnce = 256;  // costed in one go when candidates are looked for; arbitrary

// Planes that touch a curved surface meet outside it, but not as far outside as evens out the chords of the faces
// between: simplified to the quadrics' minima, a ball shrinks. Moving along the mean normal until the collapse keeps
// the volume (Lindstrom & Turk, "Fast and Memory Efficient Polygonal Simplification", 1998) takes that bias out and
// lowers the root-mean-square error by about a fifth. No further than this many times the quadric's own error. Chosen
// by measuring.
constexpr float kMostShift = 2;

Vec3 shift_to_keep_volume(const Neighbourhood& n, const EdgeCost& cost) {
  const float squared = dot(n.area_normal, n.area_normal);
  const float weight = weight_of(cost.quadric);
  if (!(squared > 0) || !(weight > 0)) return {};
  const Vec3 shift = n.area_normal * ((n.swept - dot(n.area_normal, cost.offset)) / squared);
  const float length_squared = dot(shift, shift);
  const float most = kMostShift * kMostShift * cost.cost / weight;
  return length_squared > most ? shift * std::sqrt(most / length_squared) : shift;
}

class QemSimplifier {
 public:
  QemSimplifier(WorkingMesh& mesh, const SimplifyOptions& options)
      : mesh_(mesh), options_(options), recorder_(options.log, working_), rules_(surface_), candidates_({}),
        queue_({}) {}

  Result<SimplifyOutcome> run(Arena& scratch) {
    if (!carve(scratch)) return Status{StatusCode::kResourceExhausted, "scratch is smaller than qem_scratch_bytes", 0};
    build_surface(mesh_, memory_, working_);
    faces_ = working_.live_faces;
    recorder_.begin();
    if (faces_ > options_.target_faces) {
      set_initial_quadrics(surface_, memory_.texture_places.empty() ? nullptr : memory_.texture_places.data());
      texture_.set_up(surface_, working_.attributes.texture_coordinates, memory_.texture_places, texture_fits_);
      collapse_to_target();
      outcome_.max_error *= 1.0f / working_.scale;
    }
    write_surface(mesh_, working_);
    if (recorder_.full()) return log_full_status();
    return outcome_;
  }

 private:
  bool carve(Arena& scratch);
  void collapse_to_target();
  void fetch_ahead();
  bool find_candidates();
  void run_pass(std::size_t rank);
  void collapse_next();
  void fetch_vertex_at(Corner c);
  void fetch_region(std::span<const EdgeKey> batch);
  void put_off(EdgeKey key);
  void offer(std::span<const Corner> edges);
  void push_edge(Corner edge);
  bool try_collapse(Corner edge, const EdgeCost& cost);
  void refuse(Corner edge);
  void allow_again_around(std::uint32_t v);
  void allow_again_at(std::uint32_t v);

  EdgeCost cost_of_edge(Corner edge) {
    ++outcome_.work.edges_costed;
    if (texture_.active()) return texture_.cost_edge(surface_, edge, options_.placement);
    return cost_edge(surface_, surface_.vertex_at(edge), surface_.vertex_at(next_in_face(edge)), options_.placement);
  }

  WorkingMesh& mesh_;
  const SimplifyOptions options_;
  SurfaceMemory memory_;
  WorkingSurface working_;
  Surface& surface_ = working_.surface;
  LogRecorder recorder_;
  CollapseRules rules_;
  TextureError texture_;
  std::span<TextureFit> texture_fits_;
  EdgeCandidates candidates_;
  EdgeQueue queue_;  // a batch of candidates
  std::size_t batch_size_ = 0;
  EdgeKey limit_ = 0;  // of the pass: what costs more is left for a later one
  std::uint32_t faces_ = 0;            // live
  SimplifyOutcome outcome_;
};

bool QemSimplifier::carve(Arena& scratch) {
  QemScratch memory;
  if (!carve_qem_scratch(scratch, mesh_.vertex_count, mesh_.face_count, !mesh_.texture_coordinates.empty(), memory))
    return false;
  memory_ = memory.surface;
  texture_fits_ = memory.texture_fits;
  candidates_ = EdgeCandidates(memory.candidates);
  queue_ = EdgeQueue(memory.queue);
  batch_size_ = memory.batch_size;
  return true;
}

void QemSimplifier::collapse_to_target() {
  while (faces_ > options_.target_faces && !recorder_.full()) {
    if (candidates_.size() == 0 && !find_candidates()) {
      outcome_.stop = StopReason::kNoCollapseAllowed;
      return;
    }
    // A collapse removes two faces at most (more only where the surface is no manifold), so this many candidates cannot
    // reach the target before every region has had its turn; the last batch is then one of the whole mesh, by cost
    // alone.
    const std::size_t most = (faces_ - options_.target_faces) / 2;
    run_pass(most > batch_size_ ? most : batch_size_);
  }
}

/// Collapses what costs less than all but `rank` of the candidates, region by region.
void QemSimplifier::run_pass(std::size_t rank) {
  limit_ = candidates_.key_of_rank(rank);
  candidates_.begin_pass();
  for (;;) {
    const std::size_t count = candidates_.take(limit_, queue_.slots().first(batch_size_));
    if (count == 0) return;
    fetch_region(queue_.slots().first(count));
    queue_.start(count);
    while (!queue_.empty()) {
      if (faces_ <= options_.target_faces || recorder_.full()) return;
      collapse_next();
    }
  }
}

// Inlined by force, as those below: GCC takes a function that only prefetches for one without effect, and drops the
// call. A vertex may lie on two cache lines.
[[gnu::always_inline]] inline void QemSimplifier::fetch_vertex_at(Corner c) {
  const std::uint32_t v = surface_.vertex_at(c);
  __builtin_prefetch(&surface_.places[v]);
  __builtin_prefetch(&surface_.vertices[v]);
  __builtin_prefetch(&surface_.vertices[v].first_corner);
}

// Asks for the batch's part of the mesh in the order it lies in memory; the batch then goes about in it by cost.
[[gnu::always_inline]] inline void QemSimplifier::fetch_region(std::span<const EdgeKey> batch) {
  std::uint32_t first = surface_.face_count, last = 0;
  for (const EdgeKey key : batch) {
    const std::uint32_t face = edge_of(key) >> 2;
    first = face < first ? face : first;
    last = face > last ? face : last;
  }
  constexpr std::size_t kMostFacesPerEdge = 64;  // beyond, most of what would be asked for is not needed; arbitrary
  if ((last - first) / kMostFacesPerEdge > batch.size()) return;
  for (std::uint32_t face = first; face <= last; ++face) {
    if (surface_.is_dead(face)) continue;
    __builtin_prefetch(&surface_.links[face * 4]);
    for (std::uint32_t k = 0; k < 3; ++k) fetch_vertex_at(face * 4 + k);
  }
}

void QemSimplifier::collapse_next() {
  const EdgeKey key = queue_.pop();
  fetch_ahead();
  ++outcome_.work.queue_operations;
  const Corner edge = edge_of(key);
  // Its face may be gone, or another half-edge may stand for the edge now.
  if ((surface_.links[edge] & kRepresentative) == 0) return;
  EdgeCost cost = cost_of_edge(edge);
  const EdgeKey now = edge_key(cost.cost, edge);
  if (now > key && (now > queue_.top() || now >= limit_)) {
    put_off(now);
    return;
  }
  cost.offset = refined_offset(cost);
  if (!try_collapse(edge, cost)) refuse(edge);
}

/// To its place in the batch, or in a later pass.
void QemSimplifier::put_off(EdgeKey key) {
  if (key >= limit_ || !queue_.push(key)) candidates_.keep(key);
  ++outcome_.work.queue_operations;
}

// What the next edges of the batch will need is asked for while this one is worked on.
[[gnu::always_inline]] inline void QemSimplifier::fetch_ahead() {
  constexpr std::size_t kFar = 8, kNear = 4;
  if (queue_.run_left() <= kFar) return;
  const Corner far = edge_of(queue_.in_run(kFar));
  __builtin_prefetch(&surface_.links[far]);
  __builtin_prefetch(&surface_.indices[corner_index(far)]);
  const Corner near = edge_of(queue_.in_run(kNear));
  if ((surface_.links[near] & kRepresentative) == 0) return;
  fetch_vertex_at(near);
  fetch_vertex_at(next_in_face(near));
}

/// The cheapest of all edges but the refused ones, as many as fit. False where there is none.
bool QemSimplifier::find_candidates() {
  // Found first and costed after, a block at a time: each loop then runs without surprises for the processor.
  Corner edges[kEdgesAtOnce + 3];
  std::uint32_t count = 0;
  candidates_.begin_fill();
  for (std::uint32_t face = 0; face < surface_.face_count; ++face) {
    const std::uint32_t* links = surface_.links + std::size_t{face} * 4;
    for (std::uint32_t k = 0; k < 3; ++k) {
      // Stored in any case, counted where it stands for an edge: as good as random, so no branch.
      edges[count] = face * 4 + k;
      count += (links[k] & (kRepresentative | kRefused)) == kRepresentative ? 1u : 0u;
    }
    if (count < kEdgesAtOnce) continue;
    offer({edges, kEdgesAtOnce});
    count -= kEdgesAtOnce;
    for (std::uint32_t i = 0; i < count; ++i) edges[i] = edges[kEdgesAtOnce + i];
  }
  if (count > 0) offer({edges, count});
  return candidates_.size() > 0;
}

void QemSimplifier::offer(std::span<const Corner> edges) {
  float costs[kEdgesAtOnce];
  if (texture_.active()) {
    for (std::size_t i = 0; i < edges.size(); ++i)
      costs[i] = texture_.cost_edge(surface_, edges[i], options_.placement).cost;
  } else {
    cost_edges(surface_, edges, options_.placement, costs);
  }
  for (std::size_t i = 0; i < edges.size(); ++i) candidates_.offer(edge_key(costs[i], edges[i]));
  outcome_.work.edges_costed += edges.size();
}

void QemSimplifier::push_edge(Corner edge) {
  put_off(edge_key(cost_of_edge(edge).cost, edge));
}

bool QemSimplifier::try_collapse(Corner edge, const EdgeCost& cost) {
  Neighbourhood n;
  n.a = surface_.vertex_at(edge);
  n.b = surface_.vertex_at(next_in_face(edge));
  if (!rules_.keeps_topology(n)) return false;
  const Vec3 a = surface_.position(n.a);
  Vec3 position = a + cost.offset;
  const Vec3 volume_kept =
      position + (options_.placement == Placement::kOptimal ? shift_to_keep_volume(n, cost) : Vec3{});
  if (!(volume_kept == position) && !rules_.turns_a_face(n, volume_kept)) position = volume_kept;
  else if (rules_.turns_a_face(n, position)) return false;

  AttributeShares shares;
  if (working_.attributes.any()) {
    const float t = position_along(surface_.position(n.b) - a, cost.offset);
    shares = shares_at(t, weight_of(surface_.vertices[n.a].quadric), weight_of(surface_.vertices[n.b].quadric));
  }
  const std::uint32_t singular = (surface_.places[n.a].mark | surface_.places[n.b].mark) & kSingular;
  if (texture_.active()) texture_.begin_collapse(surface_, edge, position);
  const CollapsedEdge collapsed = collapse_edge(surface_, working_.seam_map, working_.attributes, n, shares);
  const std::uint32_t v = collapsed.vertex;
  if (texture_.active()) texture_.end_collapse(surface_, v);
  faces_ -= collapsed.faces_removed;
  ++outcome_.work.collapses;

  surface_.places[v].position = position;
  surface_.places[v].mark |= singular;
  Quadric& quadric = surface_.vertices[v].quadric;
  quadric = moved_to(cost.quadric, position - a);  // where rounding put it, not where it was meant to go
  quadric.c = at_least_zero(quadric.c);
  const float weight = weight_of(quadric);
  const float error = weight > 0 ? std::sqrt(quadric.c / weight) : 0.0f;
  if (error > outcome_.max_error) outcome_.max_error = error;
  if (options_.log != nullptr) recorder_.record(collapsed);

  for (std::uint32_t i = 0; i < collapsed.uncosted_count; ++i) push_edge(collapsed.uncosted[i]);
  if (n.touches_refused) allow_again_around(v);
  return true;
}

void QemSimplifier::refuse(Corner edge) {
  surface_.links[edge] |= kRefused;
  surface_.places[surface_.vertex_at(edge)].mark |= kTouchesRefused;
  surface_.places[surface_.vertex_at(next_in_face(edge))].mark |= kTouchesRefused;
}

// A collapse into `v` changed the faces of `v` and of its neighbours, and with them what is allowed at those vertices.
// The edges are taken up at once: by the next fill dearer ones would have gone, a cube's corners before its flat sides.
void QemSimplifier::allow_again_around(std::uint32_t v) {
  allow_again_at(v);
  for (Corner c = surface_.first_corner(v); c != kNoCorner; c = surface_.next_corner_of(c)) {
    for (const Corner other : {next_in_face(c), previous_in_face(c)}) {
      const std::uint32_t u = surface_.vertex_at(other);
      if ((surface_.places[u].mark & kTouchesRefused) != 0) allow_again_at(u);
    }
  }
}

void QemSimplifier::allow_again_at(std::uint32_t v) {
  surface_.places[v].mark &= ~kTouchesRefused;
  for (Corner c = surface_.first_corner(v); c != kNoCorner; c = surface_.next_corner_of(c)) {
    for (const Corner half_edge : {c, previous_in_face(c)}) {
      std::uint32_t& flags = surface_.links[half_edge];
      if ((flags & kRefused) == 0) continue;
      flags &= ~kRefused;
      push_edge(half_edge);
    }
  }
}

}  // namespace

Result<SimplifyOutcome> simplify_qem(WorkingMesh& mesh, const SimplifyOptions& options, Arena& scratch) {
  const ScratchScope scope(scratch);
  QemSimplifier simplifier(mesh, options);
  return simplifier.run(scratch);
}

}  // namespace usuzumi::firmware
