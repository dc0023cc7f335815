// Half-edge collapse that keeps appearances: CN101231761A (Nanjing University, 2008). vs goes to vt, which stays as it
// is; an edge has two such collapses. Penalties keep seams whole (half_edge_cost.h), and corners take vt's continuous
// wedges (wedge_matching.h).
//
// Where we depart from the source: the quadrics have, beside the faces' planes, those along open borders and seams that
// Garland & Heckbert's paper, which the source builds on, has for borders (section 6): the claim's cost does not see
// that a border or a texture's edge is cut short where the surface is flat. A border is a seam, and a vertex there goes
// along the border or not at all. What is penalised waits until nothing else is allowed anywhere. Edges are ordered as
// QEM's are (edge_passes.h), not by a heap of vertices; an edge's cost is brought up to date when it comes to the
// front.
#include "firmware/simplify/half_edge/half_edge.h"

#include "firmware/simplify/collapse_log.h"
#include "firmware/simplify/collapse_rules.h"
#include "firmware/simplify/edge_collapse.h"
#include "firmware/simplify/edge_passes.h"
#include "firmware/simplify/half_edge/half_edge_cost.h"
#include "firmware/simplify/half_edge/half_edge_scratch.h"
#include "firmware/simplify/half_edge/seams.h"
#include "firmware/simplify/half_edge/wedge_matching.h"
#include "firmware/simplify/initial_quadrics.h"
#include "firmware/simplify/log_recorder.h"
#include "firmware/simplify/refused_edges.h"
#include "firmware/simplify/working_surface.h"

namespace usuzumi::firmware {
namespace {

constexpr std::uint32_t kBothRefused = kForwardRefused | kBackwardRefused;
constexpr std::uint32_t kTold = 1;  // in Place::mark of a wedge: the log knows where it goes

class HalfEdgeSimplifier {
 public:
  HalfEdgeSimplifier(WorkingMesh& mesh, const SimplifyOptions& options)
      : mesh_(mesh), options_(options), rules_(surface_) {}

  Result<SimplifyOutcome> run(Arena& scratch) {
    HalfEdgeScratch memory;
    if (!carve_half_edge_scratch(scratch, mesh_.vertex_count, mesh_.face_count, memory))
      return Status{StatusCode::kResourceExhausted, "scratch is smaller than half_edge_scratch_bytes", 0};
    build_surface(mesh_, memory.surface, working_);
    working_.positions_kept = true;
    faces_ = working_.live_faces;
    LogRecorder(options_.log, working_).begin();
    if (faces_ > options_.target_faces) {
      start(memory);
      collapse_to_target();
      outcome_.max_error *= 1.0f / working_.scale;
    }
    write_surface(mesh_, working_);
    if (log_is_full()) return log_full_status();
    return outcome_;
  }

 private:
  void start(const HalfEdgeScratch& memory);
  void collapse_to_target();
  bool find_candidates();
  void offer(std::span<const Corner> edges);
  bool collapse_next(EdgeKey key);
  void put_off(EdgeKey key);
  void push_edge(Corner edge);
  std::uint32_t try_collapse(const HalfEdge& half_edge);
  bool has_successors(const HalfEdge& half_edge, const WedgeMatching& matching) const;
  void replace_wedges(const HalfEdge& half_edge, const WedgeMatching& matching);
  void merge_quadrics(const HalfEdge& half_edge);
  void tell_of_removed(const CollapsedEdge& collapsed);
  void tell_successions(std::uint32_t from, const WedgeMatching& matching);
  bool joins_seam_ends(const Neighbourhood& n);
  void update_seams_around(std::uint32_t v);
  void refuse(Corner edge, std::uint32_t ways);
  void allow_again_around(std::uint32_t v);

  bool log_is_full() const { return options_.log != nullptr && options_.log->full(); }
  std::uint32_t refused_ways(Corner edge) const {
    return std::uint32_t{refused_[edge >> 2]} >> (2 * (edge & 3)) & kBothRefused;
  }
  void allow_both_ways(Corner edge) {
    std::uint8_t& ways = refused_[edge >> 2];
    ways = static_cast<std::uint8_t>(ways & ~(kBothRefused << (2 * (edge & 3))));
  }
  HalfEdge cheapest(Corner edge) {
    ++outcome_.work.edges_costed;
    return costs_.cheapest(edge, refused_ways(edge));
  }

  WorkingMesh& mesh_;
  const SimplifyOptions options_;
  WorkingSurface working_;
  Surface& surface_ = working_.surface;
  CollapseRules rules_;
  Seams seams_;
  HalfEdgeCosts costs_;
  EdgePasses passes_;
  std::uint8_t* refused_ = nullptr;  // by face: of each corner's edge, two bits: the ways that are refused
  bool penalised_too_ = false;       // nothing else is allowed
  bool left_behind_ = false;         // something without penalty found no room in the pass
  std::uint32_t faces_ = 0;          // live
  SimplifyOutcome outcome_;
};

void HalfEdgeSimplifier::start(const HalfEdgeScratch& memory) {
  set_initial_quadrics(surface_);
  seams_ = Seams(surface_, memory.seam_words);
  seams_.find();
  costs_ = HalfEdgeCosts(surface_, seams_, memory.areas);
  costs_.start();
  refused_ = memory.refused.data();
  for (std::uint8_t& ways : memory.refused) ways = 0;
  passes_ = EdgePasses(surface_, memory.candidates, memory.queue,
                       static_cast<std::size_t>(edge_batch_size(mesh_.face_count)));
}

void HalfEdgeSimplifier::collapse_to_target() {
  while (faces_ > options_.target_faces && !log_is_full()) {
    if (passes_.empty() && !find_candidates()) {
      outcome_.stop = StopReason::kNoCollapseAllowed;
      return;
    }
    // A collapse removes two faces at most (more only where the surface is no manifold), so this many candidates cannot
    // reach the target before every region has had its turn; the last batch is then one of the whole mesh, by cost
    // alone.
    const std::size_t most = (faces_ - options_.target_faces) / 2;
    // No pass takes penalised edges of one region before others of another.
    const EdgeKey cap = passes_.least() < kPenalised ? kPenalised : kEdgeKeyMax;
    left_behind_ = false;
    passes_.run(most > passes_.batch_size() ? most : passes_.batch_size(), cap, [this](EdgeKey key) {
      return faces_ > options_.target_faces && !left_behind_ && collapse_next(key);
    });
    if (left_behind_) passes_.clear();  // whatever is left is found again
  }
}

/// False where no edge is left.
bool HalfEdgeSimplifier::find_candidates() {
  const auto offered = [this](std::span<const Corner> edges) { offer(edges); };
  if (!penalised_too_ && passes_.fill(offered)) return true;
  penalised_too_ = true;
  return passes_.fill(offered);
}

void HalfEdgeSimplifier::offer(std::span<const Corner> edges) {
  const EdgeKey end = penalised_too_ ? kEdgeKeyMax : kPenalised;
  for (const Corner edge : edges) {
    const EdgeKey key = costs_.least_key(edge, refused_ways(edge));
    if (key < end) passes_.add(key);
  }
  outcome_.work.edges_costed += edges.size();
}

bool HalfEdgeSimplifier::collapse_next(EdgeKey key) {
  ++outcome_.work.queue_operations;
  const Corner edge = edge_of(key);
  // Its face may be gone, or another half-edge may stand for the edge now, or it came twice.
  if ((surface_.links[edge] & (kRepresentative | kRefused)) != kRepresentative) return true;
  const HalfEdge half_edge = cheapest(edge);
  if (half_edge.key > key && !passes_.is_next(half_edge.key)) put_off(half_edge.key);
  else if (const std::uint32_t refused = try_collapse(half_edge); refused != 0) refuse(edge, refused);
  return !log_is_full();
}

/// To its place in the batch, or in a later pass.
void HalfEdgeSimplifier::put_off(EdgeKey key) {
  ++outcome_.work.queue_operations;
  if (key == kEdgeKeyMax || (key >= kPenalised && !penalised_too_)) return;  // a later fill finds it
  if (!passes_.put_off(key) && key < kPenalised) left_behind_ = penalised_too_;
}

void HalfEdgeSimplifier::push_edge(Corner edge) {
  ++outcome_.work.edges_costed;
  put_off(costs_.least_key(edge, refused_ways(edge)));
}

/// The ways that are refused; 0 where it has collapsed.
std::uint32_t HalfEdgeSimplifier::try_collapse(const HalfEdge& half_edge) {
  Neighbourhood n;
  n.a = half_edge.from;
  n.b = half_edge.to;
  if (!rules_.keeps_topology(n)) return kBothRefused;  // whichever end goes, the same vertices become one
  const std::uint32_t this_way = half_edge.forward ? kForwardRefused : kBackwardRefused;
  if (rules_.turns_a_face(n, surface_.position(n.b))) return this_way;
  const WedgeMatching matching(surface_, working_.attributes, mesh_.groups, n.a, n.b);
  if (!has_successors(half_edge, matching)) return this_way;

  if (options_.log != nullptr) options_.log->begin_step();
  replace_wedges(half_edge, matching);
  // A singular vertex goes along a border or not at all, to another one: the mark need not be carried over.
  const CollapsedEdge collapsed = collapse_half_edge(surface_, n);
  faces_ -= collapsed.faces_removed;
  ++outcome_.work.collapses;
  if (options_.log != nullptr) tell_of_removed(collapsed);
  merge_quadrics(half_edge);
  costs_.merge_areas(n.a, n.b);

  if (half_edge.key >= kPenalised || joins_seam_ends(n)) update_seams_around(n.b);
  for (std::uint32_t i = 0; i < collapsed.uncosted_count; ++i) {
    allow_both_ways(collapsed.uncosted[i]);
    push_edge(collapsed.uncosted[i]);
  }
  if (n.touches_refused) allow_again_around(n.b);
  return 0;
}

bool HalfEdgeSimplifier::has_successors(const HalfEdge& half_edge, const WedgeMatching& matching) const {
  if (mesh_.groups.size() < 2) return true;
  for (Corner c = surface_.first_corner(half_edge.from); c != kNoCorner; c = surface_.next_corner_of(c))
    if (matching.successor(surface_.indices[corner_index(c)]) == WedgeMatching::kNone) return false;
  return true;
}

void HalfEdgeSimplifier::replace_wedges(const HalfEdge& half_edge, const WedgeMatching& matching) {
  CollapseLog* log = options_.log;
  if (log != nullptr) tell_successions(half_edge.from, matching);
  for (Corner c = surface_.first_corner(half_edge.from); c != kNoCorner; c = surface_.next_corner_of(c)) {
    if (surface_.vertex_at(next_in_face(c)) == half_edge.to ||
        surface_.vertex_at(previous_in_face(c)) == half_edge.to) {
      if (log != nullptr) log->remove_face(c >> 2);
      continue;
    }
    std::uint32_t& wedge = surface_.indices[corner_index(c)];
    const std::uint32_t successor = matching.successor(wedge);
    if (log != nullptr) log->change(static_cast<std::uint32_t>(corner_index(c)), wedge, successor);
    wedge = successor;
  }
}

void HalfEdgeSimplifier::tell_successions(std::uint32_t from, const WedgeMatching& matching) {
  const auto mark_of = [this](Corner c) -> std::uint32_t& {
    return surface_.places[surface_.indices[corner_index(c)]].mark;
  };
  for (Corner c = surface_.first_corner(from); c != kNoCorner; c = surface_.next_corner_of(c)) mark_of(c) &= ~kTold;
  for (Corner c = surface_.first_corner(from); c != kNoCorner; c = surface_.next_corner_of(c)) {
    if ((mark_of(c) & kTold) != 0) continue;
    mark_of(c) |= kTold;
    const std::uint32_t wedge = surface_.indices[corner_index(c)];
    options_.log->succeed(wedge, matching.successor(wedge));
  }
}

/// Wedges that only removed faces named go where their vertex goes.
void HalfEdgeSimplifier::tell_of_removed(const CollapsedEdge& collapsed) {
  CollapseLog& log = *options_.log;
  const auto leave = [&](std::uint32_t v, std::uint32_t wedge, std::uint32_t otherwise) {
    const StandingWedge stands = standing_wedge(surface_, working_.attributes.texture_coordinates, v, wedge);
    if (stands.wedge == wedge) return;
    log.follow(wedge, stands.wedge == kNoWedge ? otherwise : stands.wedge, stands.same_texture);
  };
  for (std::uint32_t i = 0; i < collapsed.faces_removed; ++i) {
    const RemovedFace& removed = collapsed.removed[i];
    leave(collapsed.vertex, removed.kept_wedge, removed.kept_wedge);
    leave(removed.apex, removed.apex_wedge, removed.kept_wedge);
  }
  log.end_step();
}

void HalfEdgeSimplifier::merge_quadrics(const HalfEdge& half_edge) {
  const Vec3 edge = surface_.position(half_edge.to) - surface_.position(half_edge.from);
  const Quadric moved = moved_to(surface_.vertices[half_edge.from].quadric, edge);
  Quadric& q = surface_.vertices[half_edge.to].quadric;
  q = q + moved;
  q.c = half_edge.dist;
  const float error = distance_of(q);
  if (error > outcome_.max_error) outcome_.max_error = error;
}

/// Without a penalty no seam comes or goes but where one that ended at `n.b` meets one that ended at an apex, as the
/// two edges between them have become one.
bool HalfEdgeSimplifier::joins_seam_ends(const Neighbourhood& n) {
  if (!seams_.is_seam(n.b)) return false;
  bool joins = false;
  for (std::uint32_t i = 0; i < n.apex_count; ++i)
    if (seams_.is_seam(n.apexes[i])) joins = seams_.update(n.apexes[i]) || joins;
  return joins;
}

/// Edges there may have lost their penalty: they come before whatever is left of the pass.
void HalfEdgeSimplifier::update_seams_around(std::uint32_t v) {
  seams_.update(v);
  for (Corner c = surface_.first_corner(v); c != kNoCorner; c = surface_.next_corner_of(c))
    for (const Corner other : {next_in_face(c), previous_in_face(c)}) seams_.update(surface_.vertex_at(other));
  const auto push_at = [this](std::uint32_t u) {
    for (Corner c = surface_.first_corner(u); c != kNoCorner; c = surface_.next_corner_of(c))
      for (const Corner edge : {c, previous_in_face(c)})
        if ((surface_.links[edge] & (kRepresentative | kRefused)) == kRepresentative) push_edge(edge);
  };
  push_at(v);
  for (Corner c = surface_.first_corner(v); c != kNoCorner; c = surface_.next_corner_of(c))
    for (const Corner other : {next_in_face(c), previous_in_face(c)}) push_at(surface_.vertex_at(other));
}

void HalfEdgeSimplifier::refuse(Corner edge, std::uint32_t ways) {
  refused_[edge >> 2] = static_cast<std::uint8_t>(refused_[edge >> 2] | ways << (2 * (edge & 3)));
  touch_refused(surface_, edge);
  if (refused_ways(edge) == kBothRefused) surface_.links[edge] |= kRefused;
  else push_edge(edge);
}

/// At once: by the next fill dearer edges would have gone.
void HalfEdgeSimplifier::allow_again_around(std::uint32_t v) {
  visit_touched_around(surface_, v, [this](Corner edge) {
    if ((surface_.links[edge] & kRepresentative) == 0 || refused_ways(edge) == 0) return;
    surface_.links[edge] &= ~kRefused;
    allow_both_ways(edge);
    push_edge(edge);
  });
}

}  // namespace

Result<SimplifyOutcome> simplify_half_edge(WorkingMesh& mesh, const SimplifyOptions& options, Arena& scratch) {
  const ScratchScope scope(scratch);
  HalfEdgeSimplifier simplifier(mesh, options);
  return simplifier.run(scratch);
}

}  // namespace usuzumi::firmware
