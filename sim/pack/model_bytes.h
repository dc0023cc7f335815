// A model as bytes and back, for the pipe between the importing process and this one.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "sim/pack/model.h"

namespace usuzumi::sim {

std::vector<std::byte> model_to_bytes(const Model& model);
/// Throws Error kBadInput about `what` where the bytes are not what model_to_bytes makes.
Model model_from_bytes(std::span<const std::byte> bytes, const std::string& what);

}  // namespace usuzumi::sim
