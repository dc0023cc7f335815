// Level-3 thinning: one interface for every method that reduces a mesh to a face quota.
#pragma once

#include <cstdint>
#include <span>

#include "hal/arena.h"
#include "hal/status.h"
#include "hal/vec.h"

namespace usuzumi::firmware {

class CollapseLog;

/// One of several materials on one mesh: faces and vertices from the ends of the group before to these. Groups share no
/// vertex; where two meet, positions repeat.
struct MaterialGroup {
  std::uint32_t face_end = 0;
  std::uint32_t vertex_end = 0;
};

/// A triangle list in RAM that a method works on in place. Positions may repeat with different normals, colours or
/// texture coordinates (a sharp border, a seam); methods weld them by exact position (-0 equals 0) and keep the
/// attributes and the groups apart.
struct WorkingMesh {
  std::span<Vec3> positions = {};                // vertex_count; finite
  std::span<PackedNormal> normals = {};          // vertex_count, or empty
  std::span<Rgba8> colours = {};                 // vertex_count, or empty
  std::span<TexCoord> texture_coordinates = {};  // vertex_count, finite, or empty
  std::span<const float> edge_values = {};       // vertex_count of the mesh as given, or empty; see EdgeRemovalSettings
  std::span<MaterialGroup> groups = {};          // empty: one group; the last ends at the counts below
  std::span<std::uint32_t> indices = {};         // 3 per face, each < vertex_count (checked by the caller)
  std::uint32_t vertex_count = 0;
  std::uint32_t face_count = 0;
  /// vertex_count, or empty. Filled in by simplify(): which entry of the mesh as given each vertex that is left was. Of
  /// methods that make no vertex (keeps_vertices()) it is that entry still, unchanged.
  std::span<std::uint32_t> source_vertices = {};
};

/// The author's choice per mesh. The numbers are those of drawing data.
enum class Method : std::uint8_t {
  kQem = 0,             // quadric error edge collapse (Garland & Heckbert 1997)
  kEdgeRemoval = 1,     // evaluation-function edge removal with texture (US 6,396,952)
  kHalfEdge = 2,        // seam-aware half-edge collapse, no new vertices (CN101231761A)
  kVertexDeletion = 3,  // vertex deletion by least energy (Sato, Kitazawa, Onozawa)
};
inline constexpr std::uint32_t kMethodCount = 4;
/// Whether every vertex of a thinned mesh is one of the mesh as given, in position and attributes.
constexpr bool keeps_vertices(Method method) {
  return method == Method::kHalfEdge || method == Method::kVertexDeletion;
}

enum class Placement : std::uint8_t {
  kOptimal,  // where the quadric is least, shifted so that the volume stays (by twice the quadric's error at most);
             // best of both ends and the middle where the quadric is ill-conditioned
  kMidpoint,  // the middle of the two ends (JP2015-22462A claim 5)
};

/// Where edge removal puts the vertex that stays (US 6,396,952, p. 19-22, figs. 4 and 5).
enum class EdgePlacement : std::uint32_t {
  kAutomatic = 0,    // convex or concave around the edge: least change; S-shaped: equal change
  kEqualVolume = 1,  // the volume changes alike on both sides
  kLeastVolume = 2,  // the volume changes least
  kKeepAnEnd = 3,    // the end whose removal changes less goes
  kMidpoint = 4,
};

/// What edge removal does with an edge on a texture boundary whose value by eq. (2) is above the limit (p. 27-30).
enum class BoundaryAnswer : std::uint32_t { kRefuse = 0, kLimitMovement = 1 };

/// Of Method::kEdgeRemoval. 40 bytes; the layout of drawing data (format.h, section METH).
struct EdgeRemovalSettings {
  float a = 1;               // of the volume term of eq. (1); >= 0
  float b = 0.1f;            // of the sheet term; >= 0
  float neighbour_weight = 0;  // how much of the neighbouring edges' mean value is added to an edge's own; 0: none
  float computed_weight = 1;   // of eq. (1)'s value, >= 0 ...
  float user_weight = 1;       // ... and of the author's value of the edge: the larger of its ends' edge_values, in
                               // units of the mesh's mean computed value: 1 is as dear as the mean edge
  EdgePlacement placement = EdgePlacement::kAutomatic;
  BoundaryAnswer boundary_answer = BoundaryAnswer::kLimitMovement;
  float boundary_limit = 1e-4f;  // of eq. (2), as a share of the squared diagonal of the mesh's box; >= 0
  std::uint32_t reserved[2] = {};
};
static_assert(sizeof(EdgeRemovalSettings) == 40);
/// The edge value of a vertex that is locked: an edge of which either end is locked is not removed.
inline constexpr float kLockedEdgeValue = -1;

/// Of Method::kVertexDeletion: coefficients of eq. (5), those of boundary vertices, and what a vertex's terms may reach
/// before it is left out of the order (0: no limit). The limits of area and move rise to the values here in 6 stages.
/// d and the limits by measuring on six models at 50, 20 and 5 %: a larger d keeps small triangles in planes and spends
/// the quota there, a smaller one lets few triangles swallow the rest; lower limits run out of vertices before 5 %.
/// Presets: vertex_deletion/presets.h. 40 bytes; the layout of drawing data (format.h, section METH).
struct VertexDeletionSettings {
  float area = 1, move = 1, normal = 1, largest = 0.02f;  // a, b, c, d; >= 0
  float boundary_area = 10;                               // a of boundary vertices
  float limit_area = 1, limit_move = 4, limit_normal = 0, limit_largest = 0;
  float protrusion_penalty = 10;  // added to E_move where the line along the normal meets no new triangle
};
static_assert(sizeof(VertexDeletionSettings) == 40);

struct SimplifyOptions {
  std::uint32_t target_faces = 0;
  Placement placement = Placement::kOptimal;  // of Method::kQem
  Method method = Method::kQem;
  EdgeRemovalSettings edge_removal = {};
  VertexDeletionSettings vertex_deletion = {};
  bool for_layers = false;  // so that a layer can be drawn moving into the next: vertex deletion fills by fans alone
  CollapseLog* log = nullptr;  // receives every step where not null (firmware/simplify/collapse_log.h)
};

enum class StopReason : std::uint8_t {
  kQuotaReached,         // faces <= target
  kNoCollapseAllowed,    // every edge left would turn a face over, make a sliver or break the surface
};

struct SimplifyWork {  // for the machine's cost model
  std::uint64_t edges_costed = 0;  // edges, or vertices where the method goes by vertices
  std::uint64_t queue_operations = 0;
  std::uint64_t collapses = 0;
};

struct SimplifyOutcome {
  StopReason stop = StopReason::kQuotaReached;
  float max_error = 0;  // model units. QEM, half-edge, edge removal: largest root of (cost / summed quadric area), the
                        // quadrics being those of places alone, but by QEM with the shift of a texture counted in;
                        // vertex deletion: largest distance that a vertex was moved, or lay from the new faces
  SimplifyWork work;
};

/// Thins `mesh` by `options.method` down to `options.target_faces`. On return the mesh's counts are the thinned ones
/// and its spans' first elements hold the result, unreferenced vertices removed, original order kept.
/// kResourceExhausted: `scratch` is too small. kUnsupported: more than 2^28 - 1 faces. The mesh is then as it was.
/// kResourceExhausted too where `options.log` was full; the mesh is then whole, and thinned by what was done before.
/// `scratch` is left as it was found.
Result<SimplifyOutcome> simplify(WorkingMesh& mesh, const SimplifyOptions& options, Arena& scratch);

/// Bytes of scratch that simplify() needs for a mesh of these counts, with texture coordinates or without. May be more
/// than the device can address.
std::uint64_t simplify_scratch_bytes(Method method, std::uint32_t vertex_count, std::uint32_t face_count,
                                     bool has_texture_coordinates);

}  // namespace usuzumi::firmware
