// Level-3 thinning: one interface for every method that reduces a mesh to a face quota.
#pragma once

#include <cstdint>
#include <span>

#include "hal/arena.h"
#include "hal/status.h"
#include "hal/vec.h"

namespace usuzumi::firmware {

/// A triangle list in RAM that a method works on in place. Positions may repeat with different normals or colours (a
/// sharp border); methods weld them by exact position (-0 equals 0) and keep the attributes apart.
struct WorkingMesh {
  std::span<Vec3> positions;         // vertex_count; finite
  std::span<PackedNormal> normals;   // vertex_count, or empty
  std::span<Rgba8> colours;          // vertex_count, or empty
  std::span<std::uint32_t> indices;  // 3 per face, each < vertex_count (checked by the caller)
  std::uint32_t vertex_count = 0;
  std::uint32_t face_count = 0;
};

enum class Placement : std::uint8_t {
  kOptimal,  // where the quadric is least, shifted so that the volume stays (by twice the quadric's error at most);
             // best of both ends and the middle where the quadric is ill-conditioned
  kMidpoint,  // the middle of the two ends (JP2015-22462A claim 5)
};

struct SimplifyOptions {
  std::uint32_t target_faces = 0;
  Placement placement = Placement::kOptimal;
};

enum class StopReason : std::uint8_t {
  kQuotaReached,         // faces <= target
  kNoCollapseAllowed,    // every edge left would turn a face over, make a sliver or break the surface
};

struct SimplifyWork {  // for the machine's cost model
  std::uint64_t edges_costed = 0;
  std::uint64_t queue_operations = 0;
  std::uint64_t collapses = 0;
};

struct SimplifyOutcome {
  StopReason stop = StopReason::kQuotaReached;
  float max_error = 0;  // largest root of (collapse cost / summed quadric area): a distance, in model units
  SimplifyWork work;
};

/// Quadric error edge collapse (Garland & Heckbert 1997) down to `options.target_faces`. On return the mesh's counts
/// are the thinned ones and its spans' first elements hold the result, unreferenced vertices removed, original order
/// kept. kResourceExhausted: `scratch` is too small. kUnsupported: more than 2^28 - 1 faces. The mesh is then as it
/// was. `scratch` is left as it was found.
Result<SimplifyOutcome> simplify_qem(WorkingMesh& mesh, const SimplifyOptions& options, Arena& scratch);

/// Bytes of scratch that simplify_qem needs for a mesh of these counts. May be more than the device can address.
std::uint64_t qem_scratch_bytes(std::uint32_t vertex_count, std::uint32_t face_count);

}  // namespace usuzumi::firmware
