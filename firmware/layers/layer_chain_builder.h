// Makes a chain of layers from what a method logged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/layers/layer_chain.h"
#include "firmware/simplify/collapse_log.h"
#include "firmware/simplify/simplify.h"
#include "hal/arena.h"
#include "hal/status.h"

namespace usuzumi::firmware {

struct LayerChainInput {
  LayerChainMesh mesh;                               // as given
  std::span<const MaterialGroup> groups;             // as given; empty where the mesh has one material
  std::span<const std::uint32_t> quotas_millionths;  // layers, see layer_quotas_fall()
  Method method = Method::kQem;
  Placement placement = Placement::kOptimal;
  const CollapseLog* log = nullptr;                  // finished, not full
};

/// Whether quotas can be those of layers: 1 to format::kMaxLayers of them, the first 1,000,000, each further one
/// smaller than the one before, the last at least 1.
bool layer_quotas_fall(std::span<const std::uint32_t> quotas_millionths);

/// Faces that a mesh of `faces` keeps by the last, smallest quota: what the method is asked for.
std::uint32_t layer_faces(std::uint32_t faces, std::uint32_t quota_millionths);

/// Writes the chain to the front of `out` (4-byte aligned) and returns its bytes. A layer whose quota the method did
/// not reach ends the chain at the method's last state, where that has fewer faces than the layer before; so do quotas
/// of so few faces that they fall together.
/// kInvalidArgument: the quotas do not fall. kResourceExhausted: `out` or `scratch` (4 bytes per store vertex) is too
/// small, or the log is full. kDataLoss: the log contradicts itself, in the step in `where`, or a vertex that it added
/// cannot be in drawing data.
Result<std::uint32_t> build_layer_chain(const LayerChainInput& input, Arena& scratch, std::span<std::byte> out);

/// What a log of one thinning needs at most in practice, by the faces of the mesh. A collapse removes a face or two and
/// tells of every corner of the vertex that moves, eight or so; a log that turns out too small is full, and the mesh
/// gets no layers.
struct CollapseLogSizes {
  std::uint32_t steps = 0, changes = 0, successions = 0, added = 0;
};
CollapseLogSizes collapse_log_sizes(std::uint32_t vertex_count, std::uint32_t face_count);

/// A log's memory of those sizes; false when `arena` has no room.
bool allocate_collapse_log(Arena& arena, std::uint32_t vertex_count, std::uint32_t face_count,
                           CollapseLog::Memory& memory);

}  // namespace usuzumi::firmware
