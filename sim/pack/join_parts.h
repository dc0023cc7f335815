// Several materials on one mesh.
#pragma once

#include <span>
#include <string>

#include "sim/pack/model.h"

namespace usuzumi::sim {

/// Makes one mesh of those primitives that one node places as one mesh of the file and whose name matches a pattern
/// (names.h), each a part with its own material. Thinned apart, their common border would open. Names are made unique
/// again. Throws Error kUsage for a pattern that no mesh matches; a note tells of one that joins nothing.
void join_parts(Model& model, std::span<const std::string> patterns);

}  // namespace usuzumi::sim
