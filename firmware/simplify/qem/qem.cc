// Quadric error edge collapse: Garland & Heckbert 1997, section 4; patent JP2015-22462A steps S801-S808.
//
// Where we depart from the paper: quadrics are relative to their vertices (quadric.h); pairs are edges only; an edge's
// cost is brought up to date when the edge comes to the front of the queue, not at every collapse beside it. Costs
// mostly rise as quadrics are summed, and then that is the same order; an edge whose cost has fallen (by midpoint
// placement, by the pull towards the edge's middle or where the minimum could not be used) is taken later than it might
// be. And edges are not ordered over the whole mesh but region by region up to a cost that rises from pass to pass
// (edge_passes.h): memory is then walked along, not jumped about in, and the time per face hardly grows with the
// mesh.
#include "firmware/simplify/qem/qem.h"

#include <cmath>

#include "firmware/simplify/attributes.h"
#include "firmware/simplify/collapse_rules.h"
#include "firmware/simplify/edge_collapse.h"
#include "firmware/simplify/edge_passes.h"
#include "firmware/simplify/initial_quadrics.h"
#include "firmware/simplify/log_recorder.h"
#include "firmware/simplify/qem/edge_cost.h"
#include "firmware/simplify/qem/qem_scratch.h"
#include "firmware/simplify/qem/texture_error.h"
#include "firmware/simplify/refused_edges.h"
#include "firmware/simplify/surface.h"
#include "firmware/simplify/working_surface.h"

namespace usuzumi::firmware {
namespace {

// Planes that touch a curved surface meet outside it, but not as far outside as evens out the chords of the faces
// between: simplified to the quadrics' minima, a ball shrinks. Moving along the mean normal until the collapse keeps
// the volume (Lindstrom & Turk, "Fast and Memory Efficient Polygonal Simplification", 1998) takes that bias out and
// lowers the root-mean-square error by about a fifth. No further than this many times the quadric's own error. Chosen
// by measuring.
constexpr float kMostShift = 2;

// A border's edges at a vertex may become this many times as long when a vertex inside the surface is drawn to it: the
// mouth of a thin pipe is worth little by its error, and would be drawn in to wherever the pipe bends. Arbitrary.
constexpr float kMostStretch = 2;

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
      : mesh_(mesh), options_(options), recorder_(options.log, working_), rules_(surface_) {}

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
  void collapse_next(EdgeKey key);
  void put_off(EdgeKey key);
  void offer(std::span<const Corner> edges);
  void push_edge(Corner edge);
  bool try_collapse(Corner edge, const EdgeCost& cost);
  bool stretches_border(const Neighbourhood& n, Vec3 position) const;

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
  EdgePasses passes_;
  std::uint32_t faces_ = 0;  // live
  SimplifyOutcome outcome_;
};

bool QemSimplifier::carve(Arena& scratch) {
  QemScratch memory;
  if (!carve_qem_scratch(scratch, mesh_.vertex_count, mesh_.face_count, !mesh_.texture_coordinates.empty(), memory))
    return false;
  memory_ = memory.surface;
  texture_fits_ = memory.texture_fits;
  passes_ = EdgePasses(surface_, memory.candidates, memory.queue, memory.batch_size);
  return true;
}

void QemSimplifier::collapse_to_target() {
  while (faces_ > options_.target_faces && !recorder_.full()) {
    if (passes_.empty() && !passes_.fill([this](std::span<const Corner> edges) { offer(edges); })) {
      outcome_.stop = StopReason::kNoCollapseAllowed;
      return;
    }
    // A collapse removes two faces at most (more only where the surface is no manifold), so this many candidates cannot
    // reach the target before every region has had its turn; the last batch is then one of the whole mesh, by cost
    // alone.
    const std::size_t most = (faces_ - options_.target_faces) / 2;
    passes_.run(most > passes_.batch_size() ? most : passes_.batch_size(), kEdgeKeyMax, [this](EdgeKey key) {
      if (faces_ <= options_.target_faces || recorder_.full()) return false;
      collapse_next(key);
      return true;
    });
  }
}

void QemSimplifier::collapse_next(EdgeKey key) {
  ++outcome_.work.queue_operations;
  const Corner edge = edge_of(key);
  // Its face may be gone, or another half-edge may stand for the edge now.
  if ((surface_.links[edge] & kRepresentative) == 0) return;
  EdgeCost cost = cost_of_edge(edge);
  const EdgeKey now = edge_key(cost.cost, edge);
  if (now > key && !passes_.is_next(now)) {
    put_off(now);
    return;
  }
  cost.offset = refined_offset(cost);
  if (!try_collapse(edge, cost)) refuse_edge(surface_, edge);
}

/// To its place in the batch, or in a later pass.
void QemSimplifier::put_off(EdgeKey key) {
  (void)passes_.put_off(key);  // an edge without room is found by a later fill
  ++outcome_.work.queue_operations;
}

void QemSimplifier::offer(std::span<const Corner> edges) {
  float costs[EdgePasses::kEdgesAtOnce];
  if (texture_.active()) {
    for (std::size_t i = 0; i < edges.size(); ++i)
      costs[i] = texture_.cost_edge(surface_, edges[i], options_.placement).cost;
  } else {
    cost_edges(surface_, edges, options_.placement, costs);
  }
  for (std::size_t i = 0; i < edges.size(); ++i) passes_.add(edge_key(costs[i], edges[i]));
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
  if (stretches_border(n, position)) return false;

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
  const float error = distance_of(quadric);
  if (error > outcome_.max_error) outcome_.max_error = error;
  if (options_.log != nullptr) recorder_.record(collapsed);

  for (std::uint32_t i = 0; i < collapsed.uncosted_count; ++i) push_edge(collapsed.uncosted[i]);
  // At once: by the next fill dearer edges would have gone, a cube's corners before its flat sides.
  if (n.touches_refused) allow_again_around(surface_, v, [this](Corner again) { push_edge(again); });
  return true;
}

/// Where one end of the edge lies on a border, and the edge does not.
bool QemSimplifier::stretches_border(const Neighbourhood& n, Vec3 position) const {
  const auto is_singular = [this](std::uint32_t v) { return (surface_.places[v].mark & kSingular) != 0; };
  if (is_singular(n.a) == is_singular(n.b)) return false;
  const std::uint32_t v = is_singular(n.a) ? n.a : n.b;
  float before = 0, after = 0;
  for (Corner c = surface_.first_corner(v); c != kNoCorner; c = surface_.next_corner_of(c)) {
    for (const Corner other : {next_in_face(c), previous_in_face(c)}) {
      const std::uint32_t u = surface_.vertex_at(other);
      if (!is_singular(u)) continue;
      before += length(surface_.position(u) - surface_.position(v));
      after += length(surface_.position(u) - position);
    }
  }
  return after > kMostStretch * before;
}

}  // namespace

Result<SimplifyOutcome> simplify_qem(WorkingMesh& mesh, const SimplifyOptions& options, Arena& scratch) {
  const ScratchScope scope(scratch);
  QemSimplifier simplifier(mesh, options);
  return simplifier.run(scratch);
}

}  // namespace usuzumi::firmware
