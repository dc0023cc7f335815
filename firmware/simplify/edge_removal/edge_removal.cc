// Edge removal with texture: US 6,396,952, steps S2 to S6 of its fig. 1. Page numbers are the document's own.
//
// S2, S3: every edge has a value (edge_value.h, p. 15-19); the least goes first, of equal ones the shorter (p. 17).
// S4, S5: the edge goes and its vertex is placed (placement.h, p. 19-22). S6: the texture follows (wedge_images.h,
// p. 23-27), and its boundaries hold (image_border.h, p. 27-30).
//
// Where we depart from the source: on a boundary eq. (2) is added to eq. (1), where the source orders by eq. (1) alone
// and takes eq. (2) for a bound; neighbours' values (p. 18) come in as their mean times a weight, not as a sum, so that
// an edge of many neighbours is no dearer for their number; a removal that would break the surface's topology or turn
// a face is refused (collapse_rules.h); and after a removal the edges at its vertex are valued anew at once, other
// edges at its neighbours, where a plane in five or so has changed, when they come to the front. They mostly have grown
// dearer.
#include "firmware/simplify/edge_removal/edge_removal.h"

#include "firmware/simplify/attributes.h"
#include "firmware/simplify/collapse_rules.h"
#include "firmware/simplify/cost_heap.h"
#include "firmware/simplify/edge_collapse.h"
#include "firmware/simplify/edge_removal/edge_value.h"
#include "firmware/simplify/edge_removal/image_border.h"
#include "firmware/simplify/edge_removal/placement.h"
#include "firmware/simplify/edge_removal/removal_scratch.h"
#include "firmware/simplify/edge_removal/wedge_images.h"
#include "firmware/simplify/initial_quadrics.h"
#include "firmware/simplify/log_recorder.h"
#include "firmware/simplify/refused_edges.h"
#include "firmware/simplify/surface.h"
#include "firmware/simplify/working_surface.h"

namespace usuzumi::firmware {
namespace {

class EdgeRemover {
 public:
  EdgeRemover(WorkingMesh& mesh, const SimplifyOptions& options)
      : mesh_(mesh), options_(options), rules_(surface_), recorder_(options.log, working_) {}

  Result<SimplifyOutcome> run(Arena& scratch);

 private:
  void set_author_values();
  void count_border_edges();
  void find_limit();
  void find_unit(EdgeValues& values);
  bool key_of(Corner edge, EdgeShape& shape, EdgeLengthKey& key);
  void put(Corner edge);
  void remove_to_target();
  bool try_remove(const EdgeShape& shape);
  bool try_remove_at(const EdgeShape& shape, const Neighbourhood& n, float t, bool t_is_free);
  bool swallows_an_island(const Neighbourhood& n);
  void carry_out(const Neighbourhood& n, float t, Vec3 position);

  const EdgeRemovalSettings& settings() const { return options_.edge_removal; }

  WorkingMesh& mesh_;
  const SimplifyOptions options_;
  RemovalScratch memory_;
  WorkingSurface working_;
  Surface& surface_ = working_.surface;
  Images images_;
  WedgeImages wedges_;
  CollapseRules rules_;
  LogRecorder recorder_;
  EdgeValues* values_ = nullptr;
  KeyHeap<EdgeLengthKey> heap_;
  float outline_limit_ = 0;  // of eq. (2), in working units squared
  std::uint32_t faces_ = 0;  // live
  SimplifyOutcome outcome_;
};

Result<SimplifyOutcome> EdgeRemover::run(Arena& scratch) {
  if (!carve_removal_scratch(scratch, mesh_.vertex_count, mesh_.face_count, memory_))
    return Status{StatusCode::kResourceExhausted, "scratch is smaller than edge_removal_scratch_bytes", 0};
  build_surface(mesh_, memory_.surface, working_);
  recorder_.begin();
  faces_ = working_.live_faces;
  if (faces_ > options_.target_faces) {
    heap_ = KeyHeap<EdgeLengthKey>(memory_.heap_slots, memory_.heap_place_of);
    images_ = {working_.attributes.texture_coordinates, working_.attributes.colours, mesh_.groups};
    set_initial_quadrics(surface_);
    set_author_values();
    count_border_edges();
    find_limit();
    EdgeValues values(surface_, images_, memory_.vertices.data(), options_.edge_removal);
    find_unit(values);
    values_ = &values;
    remove_to_target();
    outcome_.max_error *= 1.0f / working_.scale;
  }
  write_surface(mesh_, working_);
  if (recorder_.full()) return log_full_status();
  return outcome_;
}

/// Over the wedges of a vertex, referenced or not, a lock wins, else the largest value.
void EdgeRemover::set_author_values() {
  for (RemovalVertex& v : memory_.vertices) v = {};
  for (std::size_t w = 0; w < mesh_.edge_values.size() && w < mesh_.vertex_count; ++w) {
    float& value = memory_.vertices[memory_.surface.vertex_of_wedge[w]].author_value;
    const float given = mesh_.edge_values[w];
    if (given == given) value = larger_author_value(value, given);  // what is no number says nothing
  }
}

/// Where images differ at the other end alone, a boundary comes to a point here. But where two such edges meet, one
/// goes on through this vertex, at which both images happen to be the same.
void EdgeRemover::count_border_edges() {
  for (std::uint32_t v = 0; v < surface_.vertex_count; ++v) {
    // Without seams only what is singular has a boundary.
    if (working_.seam_map == nullptr && (surface_.places[v].mark & kSingular) == 0) continue;
    std::uint32_t here = 0, elsewhere = 0;
    visit_border_edges(surface_, images_, v, [&](const BorderEdge& border) { ++(border.here ? here : elsewhere); });
    memory_.vertices[v].border_edges = here + (elsewhere > 1 ? elsewhere : 0);
  }
}

void EdgeRemover::find_limit() {
  Vec3 low, high;
  find_extent(surface_, [this](std::uint32_t v) { return surface_.position(v); }, low, high);
  const Vec3 diagonal = high - low;
  outline_limit_ = settings().boundary_limit * dot(diagonal, diagonal);
}

/// The sum is in double precision: a million values added to a single would lose most of their bits. Only meshes with
/// authors' values pay for it.
void EdgeRemover::find_unit(EdgeValues& values) {
  if (mesh_.edge_values.empty()) return;
  double sum = 0;
  std::uint64_t count = 0;
  for (std::uint32_t face = 0; face < surface_.face_count; ++face) {
    for (Corner c = face * 4; c < face * 4 + 3; ++c) {
      if ((surface_.links[c] & kRepresentative) == 0) continue;
      sum += static_cast<double>(values.computed(c, values.shape_of(c)));
      ++count;
      ++outcome_.work.edges_costed;
    }
  }
  if (count > 0) values.set_unit(static_cast<float>(sum / static_cast<double>(count)));
}

bool EdgeRemover::key_of(Corner edge, EdgeShape& shape, EdgeLengthKey& key) {
  ++outcome_.work.edges_costed;
  shape = values_->shape_of(edge);
  if (values_->freedom_of(shape) == Freedom::kNone) return false;
  key = {values_->value(edge, shape), shape.length, edge};
  return true;
}

/// To its place in the heap, or out of it where it may not be removed.
void EdgeRemover::put(Corner edge) {
  EdgeShape shape;
  EdgeLengthKey key;
  ++outcome_.work.queue_operations;
  if (key_of(edge, shape, key)) heap_.set(key);
  else heap_.remove(edge);
}

void EdgeRemover::remove_to_target() {
  for (std::uint32_t face = 0; face < surface_.face_count; ++face)
    for (Corner c = face * 4; c < face * 4 + 3; ++c)
      if ((surface_.links[c] & kRepresentative) != 0) put(c);
  while (faces_ > options_.target_faces && !recorder_.full()) {
    if (heap_.empty()) {
      outcome_.stop = StopReason::kNoCollapseAllowed;
      return;
    }
    const EdgeLengthKey top = heap_.top();
    ++outcome_.work.queue_operations;
    EdgeShape shape;
    EdgeLengthKey now;
    // Its face may be gone, or another half-edge may stand for the edge now.
    if ((surface_.links[top.edge] & kRepresentative) == 0 || !key_of(top.edge, shape, now)) {
      heap_.remove(top.edge);
    } else if (top < now) {
      heap_.set(now);
    } else {
      heap_.remove(top.edge);
      if (!try_remove(shape)) refuse_edge(surface_, top.edge);
    }
  }
}

bool EdgeRemover::try_remove(const EdgeShape& shape) {
  const Freedom freedom = values_->freedom_of(shape);
  if (shape.border && settings().boundary_answer == BoundaryAnswer::kRefuse &&
      !(shape.at_a.outline + shape.at_b.outline <= outline_limit_))
    return false;
  Neighbourhood n;
  n.a = shape.a;
  n.b = shape.b;
  if (!rules_.keeps_topology(n)) return false;
  if (freedom == Freedom::kAtA) return try_remove_at(shape, n, 0.0f, false);
  if (freedom == Freedom::kAtB) return try_remove_at(shape, n, 1.0f, false);
  const float t = place_on_edge(shape, settings().placement);
  if (try_remove_at(shape, n, t, true)) return true;
  if (settings().placement != EdgePlacement::kAutomatic) return false;
  const float other = place_on_edge(shape, settings().placement, true);
  return other != t && try_remove_at(shape, n, other, true);
}

/// `n` is of the last call of keeps_topology. Where `t_is_free` the outline's limit may move `t`.
bool EdgeRemover::try_remove_at(const EdgeShape& shape, const Neighbourhood& n, float t, bool t_is_free) {
  if (shape.border) {
    const float limit = outline_limit_;
    if (t_is_free ? !limit_movement(shape, limit, t) : !(outline_change(shape, t) <= limit)) return false;
  }
  const Vec3 a = surface_.position(n.a), b = surface_.position(n.b);
  const Vec3 position = t == 1 ? b : a + (b - a) * t;
  if (rules_.turns_a_face(n, position)) return false;
  if (!wedges_.plan(surface_, images_, n, t)) return false;
  if (shape.border && swallows_an_island(n)) return false;
  carry_out(n, t, position);
  return true;
}

/// A face on a boundary edge whose two other sides are boundaries too is all there is of its image.
bool EdgeRemover::swallows_an_island(const Neighbourhood& n) {
  std::uint32_t met[2] = {0, 0};  // a bit for each apex whose edge to the end is a boundary
  for (std::uint32_t end = 0; end < 2; ++end) {
    visit_border_edges(surface_, images_, end == 0 ? n.a : n.b, [&](const BorderEdge& border) {
      for (std::uint32_t i = 0; i < n.apex_count; ++i)
        if (border.is_boundary() && n.apexes[i] == border.other) met[end] |= 1u << i;
    });
  }
  return (met[0] & met[1]) != 0;
}

void EdgeRemover::carry_out(const Neighbourhood& n, float t, Vec3 position) {
  const Vec3 a = surface_.position(n.a), b = surface_.position(n.b);
  const Quadric quadric_a = surface_.vertices[n.a].quadric, quadric_b = surface_.vertices[n.b].quadric;
  const RemovalVertex at_a = memory_.vertices[n.a], at_b = memory_.vertices[n.b];
  const std::uint32_t singular = (surface_.places[n.a].mark | surface_.places[n.b].mark) & kSingular;

  AttributeShares shares;
  if (working_.attributes.any()) {
    const float between = t < 0 ? 0.0f : (t > 1 ? 1.0f : t);
    shares = shares_at(between, weight_of(quadric_a), weight_of(quadric_b));
    wedges_.apply(surface_, working_.attributes);
  }
  // Images are done with; the ends' normals are left.
  const CollapsedEdge collapsed = collapse_edge(surface_, working_.seam_map,
                                                {.normals = working_.attributes.normals}, n, shares);
  const std::uint32_t v = collapsed.vertex;
  faces_ -= collapsed.faces_removed;
  ++outcome_.work.collapses;
  surface_.places[v].position = position;
  surface_.places[v].mark |= singular;
  memory_.vertices[v] = {larger_author_value(at_a.author_value, at_b.author_value),
                         at_a.border_edges > at_b.border_edges ? at_a.border_edges : at_b.border_edges};

  // Only what the outcome says of the error, and how normals mix, rest on the quadrics.
  Quadric& quadric = surface_.vertices[v].quadric;
  quadric = moved_to(quadric_a, position - a) + moved_to(quadric_b, position - b);
  quadric.c = quadric.c > 0 ? quadric.c : 0.0f;
  const float error = distance_of(quadric);
  if (error > outcome_.max_error) outcome_.max_error = error;

  recorder_.record(collapsed);
  for (Corner c = surface_.first_corner(v); c != kNoCorner; c = surface_.next_corner_of(c))
    for (const Corner half_edge : {c, previous_in_face(c)})
      if ((surface_.links[half_edge] & (kRepresentative | kRefused)) == kRepresentative) put(half_edge);
  if (n.touches_refused) allow_again_around(surface_, v, [this](Corner again) { put(again); });
}

}  // namespace

Result<SimplifyOutcome> simplify_edge_removal(WorkingMesh& mesh, const SimplifyOptions& options, Arena& scratch) {
  const ScratchScope scope(scratch);
  EdgeRemover remover(mesh, options);
  return remover.run(scratch);
}

}  // namespace usuzumi::firmware
