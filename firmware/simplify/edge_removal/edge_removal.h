// Edge removal that looks after the texture, Method::kEdgeRemoval: see edge_removal.cc for the source.
#pragma once

#include <cstdint>

#include "firmware/simplify/simplify.h"

namespace usuzumi::firmware {

/// As simplify(), by options.edge_removal. kResourceExhausted also where options.log is full: the mesh is then thinned
/// as far as the log tells, and one step further.
Result<SimplifyOutcome> simplify_edge_removal(WorkingMesh& mesh, const SimplifyOptions& options, Arena& scratch);

/// Bytes of scratch that simplify_edge_removal needs for a mesh of these counts: 72 a vertex and 68 a face, and a few.
/// May be more than the device can address.
std::uint64_t edge_removal_scratch_bytes(std::uint32_t vertex_count, std::uint32_t face_count);

}  // namespace usuzumi::firmware
