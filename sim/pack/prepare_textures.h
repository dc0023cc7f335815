// Textures on their way from the model file to ROM.
#pragma once

#include <cstdint>

#include "sim/pack/model.h"

namespace usuzumi::sim {

/// Leaves of the model's textures and materials what its meshes use, each once: alpha that no material looks at becomes
/// full, images larger than `most_texels` either way are halved until they fit, equal images become one. A note tells
/// of images that the format's bound (4096) makes smaller, not of those that the user's does.
void prepare_textures(Model& model, std::uint32_t most_texels = firmware::format::kMaxTextureSize);

}  // namespace usuzumi::sim
