// A model as drawing data in ROM: the container, or the patent's bare layout. firmware/drawing_data/format.h is the
// law.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/pack/model.h"

namespace usuzumi::sim {

/// The container: one record per mesh, indexed, with normals, colours, quotas, thresholds and names. The same model
/// gives the same bytes. Throws Error kBadInput where the format's bounds are exceeded.
/// `board`: the only one that will take it; empty for any.
std::vector<std::byte> write_container(const Model& model, const std::string& board = {});

/// The patent's layout alone: per mesh one triangle strip that draws every face of it with its winding, joined by faces
/// without area. Positions and levels survive, nothing else.
std::vector<std::byte> write_bare(const Model& model);

}  // namespace usuzumi::sim
