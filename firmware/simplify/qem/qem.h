// Quadric error edge collapse, Method::kQem: see qem.cc for the papers and where we depart from them.
#pragma once

#include <cstdint>

#include "firmware/simplify/simplify.h"

namespace usuzumi::firmware {

/// As simplify(), by quadric error edge collapse.
Result<SimplifyOutcome> simplify_qem(WorkingMesh& mesh, const SimplifyOptions& options, Arena& scratch);

/// Bytes of scratch that simplify_qem needs for a mesh of these counts, with texture coordinates or without. May be
/// more than the device can address.
std::uint64_t qem_scratch_bytes(std::uint32_t vertex_count, std::uint32_t face_count, bool has_texture_coordinates);

}  // namespace usuzumi::firmware
