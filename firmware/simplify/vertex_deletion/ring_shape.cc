#include "firmware/simplify/vertex_deletion/ring_shape.h"

#include <cmath>
#include <limits>

#include "firmware/simplify/vertex_deletion/angle.h"

namespace usuzumi::firmware {
namespace {

constexpr float kLeastMeanNormal = 1e-3f;

float larger(float a, float b) { return a > b ? a : b; }

void measure_faces(const Surface& s, const Ring& ring, const Sector& sector, SectorShape& shape) {
  shape.area = shape.angles = 0;
  shape.weighted_normals = {};
  shape.worst_sliver = std::numeric_limits<float>::infinity();
  Vec3 p = shape.corners[0];
  float p_squared = dot(p, p);
  for (std::uint32_t i = 0; i < sector.face_count; ++i) {
    const Vec3 q = shape.corners[i + 1 == shape.corner_count ? 0 : i + 1], side = q - p;
    const float q_squared = dot(q, q);
    shape.facing[i] = unpack(s.facing(ring.corners[sector.first_face + i]));
    const Vec3 normal = cross(p, q);
    const float squared = dot(normal, normal), twice_area = std::sqrt(squared);
    const float sliver = sliverness(squared, larger(larger(p_squared, q_squared), dot(side, side)));
    shape.worst_sliver = sliver < shape.worst_sliver ? sliver : shape.worst_sliver;
    const float theta = angle_rad(dot(p, q), twice_area);
    shape.angles += theta;
    if (twice_area > 0) {  // else without area, and without normal
      shape.area += twice_area * 0.5f;
      shape.weighted_normals = shape.weighted_normals + normal * (theta / twice_area);
    }
    p = q;
    p_squared = q_squared;
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

}  // namespace

bool measure_ring(const Surface& surface, const TexCoord* texture_coordinates, const Ring& ring, RingShape& shape) {
  shape.area = 0;
  shape.sectors[1].area = 0;
  float angles = 0;
  Vec3 weighted_normals;
  const Vec3 origin = surface.position(ring.vertex);
  for (std::uint32_t k = 0; k < ring.sector_count; ++k) {
    const Sector& from = ring.sectors[k];
    SectorShape& sector = shape.sectors[k];
    sector.corner_count = from.corner_count;
    sector.closing_edge = ring.has_closing_edge();
    for (std::uint32_t i = 0; i < from.corner_count; ++i)
      sector.corners[i] = surface.position(ring.vertices[from.first_corner + i]) - origin;
    measure_faces(surface, ring, from, sector);
    sector.texture_side = 0;
    if (texture_coordinates != nullptr) measure_texture(texture_coordinates, surface, ring, from, sector);
    if (!(sector.area > 0) || !(sector.angles > 0)) return false;
    sector.mean_normal = sector.weighted_normals * (1.0f / sector.angles);
    const float sector_length = length(sector.mean_normal);
    if (!(sector_length > kLeastMeanNormal)) return false;
    sector.mean_direction = sector.mean_normal * (1.0f / sector_length);
    shape.area += sector.area;
    angles += sector.angles;
    weighted_normals = weighted_normals + sector.weighted_normals;
  }
  shape.direction = shape.sectors[0].mean_direction;
  if (ring.sector_count == 1) return true;
  const Vec3 mean_normal = weighted_normals * (1.0f / angles);
  const float mean_length = length(mean_normal);
  shape.direction = normalized(mean_normal);
  return mean_length > kLeastMeanNormal;
}

}  // namespace usuzumi::firmware
