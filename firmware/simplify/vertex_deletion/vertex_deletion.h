// Vertex deletion by least energy, Method::kVertexDeletion: see vertex_deletion.cc for the paper and where we depart
// from it.
#pragma once

#include <cstdint>

#include "firmware/simplify/simplify.h"

namespace usuzumi::firmware {

inline constexpr std::uint32_t kDeletionStages = 6;

/// As simplify(), by vertex deletion. Vertices are a subset of those given, bit for bit.
Result<SimplifyOutcome> simplify_vertex_deletion(WorkingMesh& mesh, const SimplifyOptions& options, Arena& scratch);

/// Bytes of scratch that simplify_vertex_deletion needs for a mesh of these counts. May be more than the device can
/// address.
std::uint64_t vertex_deletion_scratch_bytes(std::uint32_t vertex_count, std::uint32_t face_count);

}  // namespace usuzumi::firmware
