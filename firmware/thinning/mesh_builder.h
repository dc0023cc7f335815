// Builds one mesh's block of the RAM copy: as it is, collapsed to a quota, or as a point or a line.
#pragma once

#include <cstdint>

#include "firmware/drawing_data/drawing_data.h"
#include "firmware/simplify/simplify.h"
#include "firmware/thinning/policy.h"
#include "firmware/thinning/ram_copy.h"
#include "hal/clock.h"

namespace usuzumi::firmware {

/// How building a block ended.
enum class BuildOutcome : std::uint8_t {
  kBuilt,           // as decided
  kQuotaNotReached, // collapsed as far as the surface allows, above its quota
  kUnthinned,       // no room to work in: copied as it is instead
  kDropped,         // no room even for that: the mesh is not in the copy
};

struct BuildReport {
  BuildOutcome outcome = BuildOutcome::kBuilt;
  bool collapsed = false;  // level 3 ran; a mesh within its quota is copied
  float max_error = 0;     // model units, collapsed meshes only
  std::uint32_t bytes_left_in_rom = 0;  // of the vertices that are drawn from there: the copy would hold them else
};

/// Adds the block of `mesh`, decided as `decision` (not kDelete), to `copy`, and charges the work to `clock`. `faces`
/// is the mesh's proper_face_count(), here and below.
BuildReport build_mesh(const MeshView& mesh, std::uint32_t faces, const Decision& decision, RamCopy& copy,
                       Clock& clock);

/// Bytes that building would need at most, the simplifier's scratch included: what the order of building goes by.
std::uint64_t working_bytes(const MeshView& mesh, std::uint32_t faces, const Decision& decision, const RamCopy& copy);

}  // namespace usuzumi::firmware
