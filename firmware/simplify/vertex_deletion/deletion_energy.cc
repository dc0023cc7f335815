#include "firmware/simplify/vertex_deletion/deletion_energy.h"

#include <cmath>
#include <limits>

namespace usuzumi::firmware {
namespace {

constexpr float kLeastCosine = 0.2f;
// See collapse_rules.cc.
constexpr float kSliverSquared = 1e-4f;
constexpr float kSliverWorseSquared = 0.25f;
constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr float kMostEnergy = std::numeric_limits<float>::max();

float larger(float a, float b) { return a > b ? a : b; }
float smaller(float a, float b) { return a < b ? a : b; }
float absolute(float a) { return a < 0 ? -a : a; }

// Of two corners of the polygon: what the triangles that share them have in common.
struct Pair {
  Vec3 swept;           // first x second: a triangle's doubled area vector is the sum of those along its sides
  float passed = 0;     // >= 0: the line along the mean normal passes left of the way from the first to the second
  float squared = 0;    // distance
};

Pair measure_pair(const RingShape& ring, Vec3 a, Vec3 b) {
  const Vec3 swept = cross(a, b), way = b - a;
  return {swept, dot(ring.direction, swept), dot(way, way)};
}

// What one new face contributes.
struct Part {
  bool allowed = false;
  float area = 0, normal = 0, distance = kFar;
};

bool faces_on(const SectorShape& sector, const FillTriangle& t, Vec3 normal) {
  if (t.b == t.a + 1 && dot(normal, sector.facing[t.a]) < 0) return false;
  if (t.c == t.b + 1 && dot(normal, sector.facing[t.b]) < 0) return false;
  const bool last_side = t.a == 0 && t.c + 1u == sector.corner_count && !sector.closing_edge;
  return !(last_side && dot(normal, sector.facing[t.c]) < 0);
}

bool is_taken(const std::uint32_t* taken, const FillTriangle& t) {
  const std::uint32_t from_a = 1u << t.b | 1u << t.c, from_b = 1u << t.c;
  return ((taken[t.a] & from_a) | (taken[t.b] & from_b)) != 0;
}

bool turns_on_texture(const SectorShape& sector, const FillTriangle& t) {
  return sector.texture_side != 0 &&
         !(sector.texture_side * texture_area(sector.texture[t.a], sector.texture[t.b], sector.texture[t.c]) > 0);
}

// Inlined by force: this is where the time goes.
[[gnu::always_inline]] inline Part measure_triangle(const RingShape& ring, const SectorShape& sector,
                                                    const FillTriangle& t, const Pair& ab, const Pair& bc,
                                                    const Pair& ac) {
  const Vec3 normal = ab.swept + bc.swept - ac.swept;
  const float squared = dot(normal, normal), twice_area = std::sqrt(squared);
  Part part;
  if (!(twice_area > 0) || !(dot(normal, sector.mean_direction) > kLeastCosine * twice_area)) return part;
  const float longest = larger(larger(ab.squared, bc.squared), ac.squared);
  const float limit = smaller(kSliverSquared, kSliverWorseSquared * sector.worst_sliver);
  if (squared < limit * (longest * longest) || !faces_on(sector, t, normal) || turns_on_texture(sector, t)) return part;
  part.allowed = true;
  part.area = twice_area * 0.5f;
  const Vec3 turn = normal * (1.0f / twice_area) - sector.mean_normal;
  part.normal = dot(turn, turn);
  // The line passes left of each side, or through it. From the other side's triangle a side's sign is exactly the
  // opposite, so that the line cannot slip between two new faces.
  if (ab.passed >= 0 && bc.passed >= 0 && ac.passed <= 0) {
    const float along = dot(normal, ring.direction);
    if (along > 0) part.distance = absolute(dot(normal, sector.corners[t.a]) / along);
  }
  return part;
}

// All triples of up to six corners, in the order of their numbers (fill_patterns.h).
void measure_triples(const RingShape& ring, const SectorShape& sector, Part* parts) {
  Pair pairs[kMostCornersOfAllFills][kMostCornersOfAllFills];  // [second][first]
  for (std::uint32_t c = 1; c < sector.corner_count; ++c)
    for (std::uint32_t a = 0; a < c; ++a) pairs[c][a] = measure_pair(ring, sector.corners[a], sector.corners[c]);
  const std::uint32_t n = sector.corner_count, count = n * (n - 1) * (n - 2) / 6;
  const FillTriangle* list = triples();
  for (std::uint32_t i = 0; i < count; ++i) {
    const FillTriangle& t = list[i];
    parts[i] = measure_triangle(ring, sector, t, pairs[t.b][t.a], pairs[t.c][t.b], pairs[t.c][t.a]);
  }
}

Part measure_alone(const RingShape& ring, const SectorShape& sector, const FillTriangle& t) {
  const Vec3 a = sector.corners[t.a], b = sector.corners[t.b], c = sector.corners[t.c];
  return measure_triangle(ring, sector, t, measure_pair(ring, a, b), measure_pair(ring, b, c),
                          measure_pair(ring, a, c));
}

// From the origin to the segment.
float distance_to_segment(Vec3 a, Vec3 b) {
  const Vec3 edge = b - a;
  const float squared = dot(edge, edge);
  float t = squared > 0 ? -dot(a, edge) / squared : 0.0f;
  t = t > 0 ? (t < 1 ? t : 1.0f) : 0.0f;
  return length(a + edge * t);
}

// Whether fans of both sectors meet in one end of the closing edge, where there is any; corners are numbered sector by
// sector, and the second runs along the seam the other way.
bool meet_in_an_end(const Ring& ring, std::uint32_t apex, std::uint32_t other) {
  if (!ring.has_closing_edge()) return true;
  const std::uint32_t last = ring.sectors[0].corner_count - 1;
  if (apex != 0 && apex != last) return false;
  return !ring.has_seam() || other == (apex == 0 ? ring.sectors[1].corner_count - 1 : 0);
}

float nearest_corner(const SectorShape& sector) {
  float squared = kFar;
  for (std::uint32_t i = 0; i < sector.corner_count; ++i)
    squared = smaller(squared, dot(sector.corners[i], sector.corners[i]));
  return std::sqrt(squared);
}

}  // namespace

DeletionEnergy::DeletionEnergy(const Surface& surface, const TexCoord* texture_coordinates,
                               const VertexDeletionSettings& settings, float mean_area, bool fans_only)
    : surface_(surface),
      texture_coordinates_(texture_coordinates),
      settings_(settings),
      per_mean_area_(1.0f / mean_area),
      per_root_mean_area_(1.0f / std::sqrt(mean_area)),
      fans_only_(fans_only) {}

std::uint32_t DeletionEnergy::fills_of(std::uint32_t corners) const {
  return fans_only_ ? corners : fill_count(corners);
}

bool DeletionEnergy::least(const Ring& ring, const TakenEdges* taken, Deletion& best) {
  if (!measure_ring(surface_, texture_coordinates_, ring, shape_)) return false;
  std::uint32_t counts[2] = {0, 1}, triangles = 0;
  fills_[1][0] = {.distance = kFar};
  for (std::uint32_t k = 0; k < ring.sector_count; ++k) {
    measure_fills(k, taken != nullptr ? taken->edges[k] : nullptr);
    counts[k] = fills_of(shape_.sectors[k].corner_count);
    triangles += shape_.sectors[k].corner_count - 2;
  }
  // Of two sectors, every pair of fills is tried.
  const float per_triangle = 1.0f / static_cast<float>(triangles);
  const std::uint32_t first = fans_only_ ? kFirstFan : 0;
  bool any = false;
  for (std::uint32_t i = 0; i < counts[0]; ++i) {
    for (std::uint32_t j = 0; fills_[0][i].allowed && j < counts[1]; ++j) {
      if (!fills_[1][j].allowed || (fans_only_ && !meet_in_an_end(ring, i, j))) continue;
      const Deletion trial = weighed(fills_[0][i], fills_[1][j], per_triangle);
      if (any && !(trial.energy < best.energy)) continue;
      best = trial;
      best.fills[0] = static_cast<std::uint8_t>(first + i);
      best.fills[1] = static_cast<std::uint8_t>(first + j);
      any = true;
    }
  }
  return any;
}

void DeletionEnergy::measure_fills(std::uint32_t sector, const std::uint32_t* taken) {
  const SectorShape& shape = shape_.sectors[sector];
  const std::uint32_t n = shape.corner_count, count = fills_of(n), first = fans_only_ ? kFirstFan : 0;
  const bool all = n <= kMostCornersOfAllFills && !fans_only_;
  Part parts[kMostTriples];
  const std::uint8_t* numbers = nullptr;
  if (all && n >= 3) {
    measure_triples(shape_, shape, parts);
    numbers = triples_of_fills(n);
  }
  for (std::uint32_t f = 0; f < count; ++f) {
    FillSums sums{.distance = kFar};
    for (std::uint32_t t = 0; t + 2 < n && sums.allowed; ++t) {
      const Part part =
          all ? parts[numbers[f * kTriplesOfFill + t]] : measure_alone(shape_, shape, fill_triangle(n, first + f, t));
      sums.allowed = part.allowed && (taken == nullptr || !is_taken(taken, fill_triangle(n, first + f, t)));
      sums.area += part.area;
      sums.normal += part.normal;
      sums.largest = larger(sums.largest, part.area);
      sums.distance = smaller(sums.distance, part.distance);
    }
    fills_[sector][f] = sums;
  }
}

// `other` is empty where there is one sector.
Deletion DeletionEnergy::weighed(const FillSums& one, const FillSums& other, float per_triangle) const {
  const SectorShape& sector = shape_.sectors[0];
  Deletion trial;
  DeletionTerms& terms = trial.terms;
  terms.area = (absolute(one.area - sector.area) + absolute(other.area - shape_.sectors[1].area)) / shape_.area;
  trial.distance = smaller(one.distance, other.distance);
  if (trial.distance < kFar) {
    terms.move = trial.distance * per_root_mean_area_;
  } else if (sector.closing_edge) {
    trial.distance = distance_to_segment(sector.corners[0], sector.corners[sector.corner_count - 1]);
    terms.move = trial.distance * per_root_mean_area_;
  } else {
    trial.distance = nearest_corner(sector);
    terms.move = settings_.protrusion_penalty;
  }
  terms.normal = (one.normal + other.normal) * per_triangle;
  terms.largest = larger(one.largest, other.largest) * per_mean_area_;
  const float energy = (sector.closing_edge ? settings_.boundary_area : settings_.area) * terms.area +
                       settings_.move * terms.move + settings_.normal * terms.normal +
                       settings_.largest * terms.largest;
  trial.energy = energy < kMostEnergy ? energy : kMostEnergy;
  return trial;
}

}  // namespace usuzumi::firmware
