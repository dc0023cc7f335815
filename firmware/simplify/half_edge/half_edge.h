// Seam-aware half-edge collapse, Method::kHalfEdge: see half_edge.cc for the source and where we depart from it.
#pragma once

#include <cstdint>

#include "firmware/simplify/simplify.h"

namespace usuzumi::firmware {

/// As simplify(), by half-edge collapse. No vertex is made, moved or changed: what is left of the mesh's arrays are
/// some of their entries, bit for bit. Where the log is full, the mesh is thinned as far as the log tells.
Result<SimplifyOutcome> simplify_half_edge(WorkingMesh& mesh, const SimplifyOptions& options, Arena& scratch);

/// Bytes of scratch that simplify_half_edge needs for a mesh of these counts. May be more than the device can address.
std::uint64_t half_edge_scratch_bytes(std::uint32_t vertex_count, std::uint32_t face_count);

}  // namespace usuzumi::firmware
