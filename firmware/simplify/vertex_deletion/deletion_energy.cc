#include "firmware/simplify/vertex_deletion/deletion_energy.h"

#include <cmath>
#include <limits>

#include "firmware/simplify/vertex_deletion/angle.h"

namespace usuzumi::firmware {
namespace {

constexpr float kLeastCosine = 0.2f;
constexpr float kLeastMeanNormal = 1e-3f;
// Squared ratio of twice a face's area to the square of its longest side; see collapse_rules.cc.
constexpr float kSliverSquared = 1e-4f;
constexpr float kSliverWorseSquared = 0.25f;
constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr float kMostEnergy = std::numeric_limits<float>::max();

float larger(float a, float b) { return a > b ? a : b; }
float smaller(float a, float b) { return a < b ? a : b; }
float absolute(float a) { return a < 0 ? -a : a; }

float sliverness(Vec3 a, Vec3 b, Vec3 c, float squared_double_area) {
  const Vec3 u = b - a, v = c - b, w = a - c;
  const float side = larger(larger(dot(u, u), dot(v, v)), dot(w, w));
  return side > 0 ? squared_double_area / (side * side) : 0.0f;
}

float texture_area(TexCoord a, TexCoord b, TexCoord c) {
  return (b.s - a.s) * (c.t - a.t) - (c.s - a.s) * (b.t - a.t);
}

// A sector as it is before the deletion. Positions are relative to the vertex.
struct SectorShape {
  std::uint32_t corner_count = 0;
  bool closing_edge = false;
  Vec3 corners[kMostCorners + 1];
  TexCoord texture[kMostCorners + 1];
  Vec3 facing[kMostRingFaces];
  const std::uint32_t* taken = nullptr;
  float area = 0;
  Vec3 weighted_normals;   // sum theta_i n_i
  float angles = 0;        // sum theta_i
  Vec3 mean_normal, mean_direction;
  float worst_sliver = kFar;
  float texture_side = 0;  // 1 or -1 where all faces lie on the texture that way round, else 0
};

// What one new face contributes.
struct Part {
  bool allowed = false;
  float area = 0, normal = 0, distance = kFar;
};

struct FillSums {
  bool allowed = false;
  float area = 0, normal = 0, largest = 0, distance = kFar;
};

void measure_faces(const Surface& s, const Ring& ring, const Sector& sector, SectorShape& shape) {
  for (std::uint32_t i = 0; i < sector.face_count; ++i) {
    const Vec3 p = shape.corners[i], q = shape.corners[i + 1 == shape.corner_count ? 0 : i + 1];
    shape.facing[i] = unpack(s.facing(ring.corners[sector.first_face + i]));
    const Vec3 normal = cross(p, q);
    const float squared = dot(normal, normal), twice_area = std::sqrt(squared);
    shape.worst_sliver = smaller(shape.worst_sliver, sliverness({}, p, q, squared));
    const float theta = angle_rad(dot(p, q), twice_area);
    shape.angles += theta;
    if (!(twice_area > 0)) continue;  // without area, without normal
    shape.area += twice_area * 0.5f;
    shape.weighted_normals = shape.weighted_normals + normal * (theta / twice_area);
  }
}

void measure_texture(const TexCoord* coordinates, const Surface& s, const Ring& ring, const Sector& sector,
                     SectorShape& shape) {
  for (std::uint32_t i = 0; i < sector.corner_count; ++i)
    shape.texture[i] = coordinates[ring.wedges[sector.first_corner + i]];
  const TexCoord at_vertex = coordinates[s.indices[corner_index(ring.corners[sector.first_face])]];
  bool all_positive = true, all_negative = true;
  for (std::uint32_t i = 0; i < sector.face_count; ++i) {
    const float area =
        texture_area(at_vertex, shape.texture[i], shape.texture[i + 1 == shape.corner_count ? 0 : i + 1]);
    all_positive = all_positive && area > 0;
    all_negative = all_negative && area < 0;
  }
  shape.texture_side = all_positive ? 1.0f : (all_negative ? -1.0f : 0.0f);
}

bool may_be(const SectorShape& sector, FillTriangle t, Vec3 normal, float squared, float twice_area) {
  if (!(twice_area > 0)) return false;
  if (!(dot(normal, sector.mean_direction) > kLeastCosine * twice_area)) return false;
  if (t.b == t.a + 1 && dot(normal, sector.facing[t.a]) < 0) return false;
  if (t.c == t.b + 1 && dot(normal, sector.facing[t.b]) < 0) return false;
  const bool last_side = t.a == 0 && t.c + 1u == sector.corner_count;
  if (last_side && !sector.closing_edge && dot(normal, sector.facing[t.c]) < 0) return false;
  const float sliver =
      sliverness(sector.corners[t.a], sector.corners[t.b], sector.corners[t.c], squared);
  if (sliver < kSliverSquared && sliver < kSliverWorseSquared * sector.worst_sliver) return false;
  if (sector.texture_side != 0 &&
      !(sector.texture_side * texture_area(sector.texture[t.a], sector.texture[t.b], sector.texture[t.c]) > 0))
    return false;
  if (sector.taken == nullptr) return true;
  const std::uint32_t from_a = 1u << t.b | 1u << t.c, from_b = 1u << t.c;
  return (sector.taken[t.a] & from_a) == 0 && (sector.taken[t.b] & from_b) == 0;
}

// `direction` is the unit mean normal of the whole ring.
Part measure_triangle(const SectorShape& sector, FillTriangle t, Vec3 direction) {
  const Vec3 a = sector.corners[t.a], b = sector.corners[t.b], c = sector.corners[t.c];
  const Vec3 normal = cross(b - a, c - a);
  const float squared = dot(normal, normal), twice_area = std::sqrt(squared);
  Part part;
  if (!may_be(sector, t, normal, squared, twice_area)) return part;
  part.allowed = true;
  part.area = twice_area * 0.5f;
  const Vec3 turn = normal * (1.0f / twice_area) - sector.mean_normal;
  part.normal = dot(turn, turn);
  // The line passes left of an edge, or through it: computed from the other side, the sign is exactly the opposite, so
  // that it cannot slip between two new faces.
  const float along = dot(normal, direction);
  if (along > 0 && dot(direction, cross(a, b)) >= 0 && dot(direction, cross(b, c)) >= 0 &&
      dot(direction, cross(c, a)) >= 0)
    part.distance = absolute(dot(normal, a) / along);
  return part;
}

void add(FillSums& sums, const Part& part) {
  sums.allowed = sums.allowed && part.allowed;
  sums.area += part.area;
  sums.normal += part.normal;
  sums.largest = larger(sums.largest, part.area);
  sums.distance = smaller(sums.distance, part.distance);
}

void measure_fills(const SectorShape& sector, Vec3 direction, FillSums* fills) {
  const std::uint32_t n = sector.corner_count, count = fill_count(n);
  Part triples[kMostTriples];
  const bool all = n <= kMostCornersOfAllFills;
  for (std::uint32_t i = 0; all && i < n * (n - 1) * (n - 2) / 6; ++i)
    triples[i] = measure_triangle(sector, triple(i), direction);
  for (std::uint32_t f = 0; f < count; ++f) {
    FillSums sums;
    sums.allowed = true;
    for (std::uint32_t t = 0; t + 2 < n && sums.allowed; ++t)
      add(sums, all ? triples[triple_of(n, f, t)] : measure_triangle(sector, fill_triangle(n, f, t), direction));
    fills[f] = sums;
  }
}

// From the origin to the segment.
float distance_to_segment(Vec3 a, Vec3 b) {
  const Vec3 edge = b - a;
  const float squared = dot(edge, edge);
  float t = squared > 0 ? -dot(a, edge) / squared : 0.0f;
  t = t > 0 ? (t < 1 ? t : 1.0f) : 0.0f;
  return length(a + edge * t);
}

float nearest_corner(const SectorShape& sector) {
  float squared = kFar;
  for (std::uint32_t i = 0; i < sector.corner_count; ++i)
    squared = smaller(squared, dot(sector.corners[i], sector.corners[i]));
  return std::sqrt(squared);
}

struct RingShape {
  SectorShape sectors[2];
  float area = 0;
  Vec3 direction;  // the unit mean normal of all its faces
};

// False where the ring or one of its sides has no area or no mean normal.
bool measure_ring(const Surface& s, const TexCoord* coordinates, const Ring& ring, const TakenEdges* taken,
                  RingShape& shape) {
  float angles = 0;
  Vec3 weighted_normals;
  const Vec3 origin = s.position(ring.vertex);
  for (std::uint32_t k = 0; k < ring.sector_count; ++k) {
    const Sector& from = ring.sectors[k];
    SectorShape& sector = shape.sectors[k];
    sector.corner_count = from.corner_count;
    sector.closing_edge = ring.has_closing_edge();
    sector.taken = taken != nullptr ? taken->edges[k] : nullptr;
    for (std::uint32_t i = 0; i < from.corner_count; ++i)
      sector.corners[i] = s.position(ring.vertices[from.first_corner + i]) - origin;
    measure_faces(s, ring, from, sector);
    if (coordinates != nullptr) measure_texture(coordinates, s, ring, from, sector);
    if (!(sector.area > 0) || !(sector.angles > 0)) return false;
    sector.mean_normal = sector.weighted_normals * (1.0f / sector.angles);
    if (!(length(sector.mean_normal) > kLeastMeanNormal)) return false;
    sector.mean_direction = normalized(sector.mean_normal);
    shape.area += sector.area;
    angles += sector.angles;
    weighted_normals = weighted_normals + sector.weighted_normals;
  }
  const Vec3 mean_normal = weighted_normals * (1.0f / angles);
  shape.direction = normalized(mean_normal);
  return length(mean_normal) > kLeastMeanNormal;
}

// `other` is empty where there is one sector.
Deletion weighed(const VertexDeletionSettings& settings, float mean_area, const RingShape& shape, const FillSums& one,
                 const FillSums& other, std::uint32_t triangles) {
  const float unit = std::sqrt(mean_area);
  const SectorShape& sector = shape.sectors[0];
  Deletion trial;
  DeletionTerms& terms = trial.terms;
  terms.area = (absolute(one.area - sector.area) + absolute(other.area - shape.sectors[1].area)) / shape.area;
  trial.distance = smaller(one.distance, other.distance);
  if (trial.distance < kFar) {
    terms.move = trial.distance / unit;
  } else if (sector.closing_edge) {
    trial.distance = distance_to_segment(sector.corners[0], sector.corners[sector.corner_count - 1]);
    terms.move = trial.distance / unit;
  } else {
    trial.distance = nearest_corner(sector);
    terms.move = settings.protrusion_penalty;
  }
  terms.normal = (one.normal + other.normal) / static_cast<float>(triangles);
  terms.largest = larger(one.largest, other.largest) / mean_area;
  const float energy = (sector.closing_edge ? settings.boundary_area : settings.area) * terms.area +
                       settings.move * terms.move + settings.normal * terms.normal +
                       settings.largest * terms.largest;
  trial.energy = energy < kMostEnergy ? energy : kMostEnergy;
  return trial;
}

}  // namespace

DeletionEnergy::DeletionEnergy(const Surface& surface, const TexCoord* texture_coordinates,
                               const VertexDeletionSettings& settings, float mean_area)
    : surface_(surface),
      texture_coordinates_(texture_coordinates),
      settings_(settings),
      mean_area_(mean_area) {}

bool DeletionEnergy::least(const Ring& ring, const TakenEdges* taken, Deletion& best) const {
  RingShape shape;
  if (!measure_ring(surface_, texture_coordinates_, ring, taken, shape)) return false;
  // Of two sectors, every pair of fills is tried.
  FillSums fills[2][kMostFills];
  std::uint32_t counts[2] = {0, 1}, triangles = 0;
  fills[1][0].allowed = true;
  for (std::uint32_t k = 0; k < ring.sector_count; ++k) {
    measure_fills(shape.sectors[k], shape.direction, fills[k]);
    counts[k] = fill_count(shape.sectors[k].corner_count);
    triangles += shape.sectors[k].corner_count - 2;
  }
  bool any = false;
  for (std::uint32_t i = 0; i < counts[0]; ++i) {
    for (std::uint32_t j = 0; fills[0][i].allowed && j < counts[1]; ++j) {
      if (!fills[1][j].allowed) continue;
      Deletion trial = weighed(settings_, mean_area_, shape, fills[0][i], fills[1][j], triangles);
      if (any && !(trial.energy < best.energy)) continue;
      trial.fills[0] = static_cast<std::uint8_t>(i);
      trial.fills[1] = static_cast<std::uint8_t>(j);
      best = trial;
      any = true;
    }
  }
  return any;
}

}  // namespace usuzumi::firmware
