// Thinning properties in the extras of a glTF node or mesh (Blender's custom properties).
#pragma once

#include <string>
#include <vector>

#include "sim/pack/model.h"

namespace tinygltf {
class Value;
}

namespace usuzumi::sim {

/// The tags in `extras`; other keys are other people's and are left alone, but one that is nearly a key of ours is told of
/// in `notes`. `whose` ("node 'Leaf'") names the place. Throws Error kBadInput for a value that cannot be.
Tags tags_from_extras(const tinygltf::Value& extras, const std::string& file, const std::string& whose,
                      std::vector<std::string>& notes);

}  // namespace usuzumi::sim
