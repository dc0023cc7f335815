// Vertex deletion by least energy: Sato, Kitazawa & Onozawa, "Mesh Simplification Algorithm Considering Global
// Feature", section 2.
//
// Step 1 costs every vertex, step 2 orders them, leaving out those whose terms exceed their limits, steps 3 to 6 delete
// the least, fill its polygon and cost its neighbours anew, until there are no more faces than asked or none is left in
// the order (step 7; the paper counts vertices). Section 3's limits of E_area and E_move, raised six times "as
// simplification goes on", are raised when none is left: stage s = 1..6 allows s/6 of the settings' values. The fill is
// that of least energy, whatever its terms; limits are applied to the vertex.
//
// An edge that a fill would add may have come to be elsewhere since the vertex was costed (two triangles would then lie
// on each other, or three on an edge). That is looked for when the vertex has its turn, and the vertex costed again
// without such fills: the energy first found is a lower bound, so that the order is the same.
#include "firmware/simplify/vertex_deletion/vertex_deletion.h"

#include "firmware/simplify/cost_heap.h"
#include "firmware/simplify/log_recorder.h"
#include "firmware/simplify/vertex_deletion/delete_vertex.h"
#include "firmware/simplify/vertex_deletion/deletion_energy.h"
#include "firmware/simplify/vertex_deletion/vertex_deletion_scratch.h"

namespace usuzumi::firmware {
namespace {

// The mean area of the faces, each of which is told where it looks.
float measure_faces(Surface& s) {
  double area = 0;
  std::uint32_t faces = 0;
  for (std::uint32_t face = 0; face < s.face_count; ++face) {
    if (s.is_dead(face)) continue;
    const Corner c = face * 4;
    const Vec3 p = s.position(s.vertex_at(c));
    const Vec3 normal = cross(s.position(s.vertex_at(c + 1)) - p, s.position(s.vertex_at(c + 2)) - p);
    const float twice_area = length(normal);
    if (twice_area > 0) s.set_facing(c, pack_normal(normal * (1.0f / twice_area)));
    area += static_cast<double>(twice_area) * 0.5;
    ++faces;
  }
  return faces > 0 ? static_cast<float>(area / faces) : 0.0f;
}

std::uint8_t first_stage(const DeletionTerms& terms, const VertexDeletionSettings& settings) {
  if (settings.limit_normal > 0 && !(terms.normal <= settings.limit_normal)) return kNever;
  if (settings.limit_largest > 0 && !(terms.largest <= settings.limit_largest)) return kNever;
  for (std::uint32_t stage = 1; stage <= kDeletionStages; ++stage) {
    const float share = static_cast<float>(stage) / static_cast<float>(kDeletionStages);
    if (settings.limit_area > 0 && !(terms.area <= settings.limit_area * share)) continue;
    if (settings.limit_move > 0 && !(terms.move <= settings.limit_move * share)) continue;
    return static_cast<std::uint8_t>(stage);
  }
  return kNever;
}

// The edges between a sector's corners that the mesh has, other than the polygon's own sides.
void find_taken(const Surface& s, const Ring& ring, TakenEdges& taken) {
  for (std::uint32_t k = 0; k < ring.sector_count; ++k) {
    const Sector& sector = ring.sectors[k];
    const std::uint32_t* vertices = ring.vertices + sector.first_corner;
    const std::uint32_t n = sector.corner_count;
    for (std::uint32_t a = 0; a + 2 < n; ++a) {
      for (std::uint32_t b = a + 2; b < n; ++b) {
        if (a == 0 && b + 1 == n && !ring.adds_closing_edge()) continue;
        if (has_edge(s, vertices[a], vertices[b])) taken.edges[k][a] |= 1u << b;
      }
    }
  }
}

// True where the mesh already has an edge that filling would add, or the face.
bool meets_itself(const Surface& s, const Ring& ring, const std::uint8_t fills[2]) {
  if (ring.adds_closing_edge()) {
    const Sector& sector = ring.sectors[0];
    if (has_edge(s, ring.vertices[0], ring.vertices[sector.corner_count - 1])) return true;
  }
  for (std::uint32_t k = 0; k < ring.sector_count; ++k) {
    const Sector& sector = ring.sectors[k];
    const std::uint32_t* vertices = ring.vertices + sector.first_corner;
    for (std::uint32_t t = 0; t + 2 < sector.corner_count; ++t) {
      const FillTriangle f = fill_triangle(sector.corner_count, fills[k], t);
      // Each inner edge is the a-c edge of the triangle on its far side; the polygon's last side is no inner edge.
      if (f.a == 0 && f.c + 1u == sector.corner_count) continue;
      if (has_edge(s, vertices[f.a], vertices[f.c])) return true;
    }
  }
  return false;
}

// Three faces are filled by one, whose sides are all there before: it must not be.
bool is_back_of_a_face(const Surface& s, const Ring& ring) {
  if (ring.open || ring.face_count != 3) return false;
  const Corner* c = ring.corners;
  return has_face(s, s.vertex_at(next_in_face(c[0])), s.vertex_at(next_in_face(c[1])),
                  s.vertex_at(next_in_face(c[2])), ring.vertex);
}

class VertexDeletion {
 public:
  VertexDeletion(WorkingMesh& mesh, const SimplifyOptions& options) : mesh_(mesh), options_(options) {}

  Result<SimplifyOutcome> run(Arena& scratch) {
    VertexDeletionScratch memory;
    if (!carve_vertex_deletion_scratch(scratch, mesh_.vertex_count, mesh_.face_count, memory))
      return Status{StatusCode::kResourceExhausted, "scratch is smaller than vertex_deletion_scratch_bytes", 0};
    build_surface(mesh_, memory.surface, working_);
    LogRecorder(options_.log, working_).begin();
    faces_ = working_.live_faces;
    states_ = memory.states;
    if (faces_ > options_.target_faces) {
      heap_ = CostHeap(memory.heap_slots, memory.heap_places);
      delete_to_target();
      outcome_.max_error *= 1.0f / working_.scale;
    }
    write_surface(mesh_, working_);
    if (log_is_full()) return log_full_status();
    return outcome_;
  }

 private:
  void delete_to_target();
  void enter_stage(std::uint32_t stage);
  void cost(DeletionEnergy& energy, std::uint32_t v);
  void take_turn(DeletionEnergy& energy, std::uint32_t v);
  void remember(std::uint32_t v, bool any, const Deletion& best);
  bool log_is_full() const { return options_.log != nullptr && options_.log->full(); }

  WorkingMesh& mesh_;
  const SimplifyOptions options_;
  WorkingSurface working_;
  Surface& surface_ = working_.surface;
  std::span<VertexState> states_;
  CostHeap heap_;
  std::uint32_t stage_ = 1;
  std::uint32_t faces_ = 0;  // live
  Ring ring_;
  SimplifyOutcome outcome_;
};

void VertexDeletion::delete_to_target() {
  const float mean_area = measure_faces(surface_);
  DeletionEnergy energy(surface_, working_.attributes.texture_coordinates, options_.vertex_deletion, mean_area,
                        options_.for_layers);
  stage_ = 0;
  for (std::uint32_t v = 0; v < surface_.vertex_count; ++v) cost(energy, v);
  while (faces_ > options_.target_faces && !log_is_full()) {
    if (!heap_.empty()) {
      ++outcome_.work.queue_operations;
      take_turn(energy, edge_of(heap_.pop()));
    } else if (stage_ < kDeletionStages) {
      enter_stage(stage_ + 1);
    } else {
      outcome_.stop = StopReason::kNoCollapseAllowed;
      return;
    }
  }
}

void VertexDeletion::enter_stage(std::uint32_t stage) {
  stage_ = stage;
  for (std::uint32_t v = 0; v < surface_.vertex_count; ++v)
    if (states_[v].stage == stage) heap_.set(v, states_[v].energy);
}

void VertexDeletion::cost(DeletionEnergy& energy, std::uint32_t v) {
  Deletion best;
  const bool any = gather_ring(surface_, working_.attributes, v, ring_) && energy.least(ring_, nullptr, best);
  remember(v, any, best);
}

void VertexDeletion::remember(std::uint32_t v, bool any, const Deletion& best) {
  ++outcome_.work.edges_costed;
  VertexState& state = states_[v];
  state = {.energy = best.energy,
           .distance = best.distance,
           .fills = {best.fills[0], best.fills[1]},
           .stage = any ? first_stage(best.terms, options_.vertex_deletion) : kNever,
           .reserved = 0};
  if (state.stage <= stage_) heap_.set(v, state.energy);
  else heap_.remove(v);
  ++outcome_.work.queue_operations;
}

/// Deletes `v`, or finds that it has to wait or to stay.
void VertexDeletion::take_turn(DeletionEnergy& energy, std::uint32_t v) {
  Ring ring;
  if (!gather_ring(surface_, working_.attributes, v, ring) || is_back_of_a_face(surface_, ring)) {
    states_[v].stage = kNever;
    return;
  }
  if (meets_itself(surface_, ring, states_[v].fills)) {
    TakenEdges taken;
    find_taken(surface_, ring, taken);
    Deletion best;
    const bool any = energy.least(ring, &taken, best);
    remember(v, any, best);
    return;
  }
  faces_ -= delete_vertex(surface_, working_.attributes.texture_coordinates, ring, states_[v].fills, options_.log);
  ++outcome_.work.collapses;
  if (states_[v].distance > outcome_.max_error) outcome_.max_error = states_[v].distance;
  states_[v].stage = kNever;
  for (std::uint32_t k = 0; k < ring.sector_count; ++k) {
    // The second sector begins and ends where the first ends and begins.
    const Sector& sector = ring.sectors[k];
    for (std::uint32_t i = k; i + k < sector.corner_count; ++i) cost(energy, ring.vertices[sector.first_corner + i]);
  }
}

}  // namespace

Result<SimplifyOutcome> simplify_vertex_deletion(WorkingMesh& mesh, const SimplifyOptions& options, Arena& scratch) {
  const ScratchScope scope(scratch);
  VertexDeletion method(mesh, options);
  return method.run(scratch);
}

}  // namespace usuzumi::firmware
