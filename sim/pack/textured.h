// What must hold of textures and their coordinates before anything is written.
#pragma once

#include <cstdint>
#include <string>

#include "sim/pack/model.h"

namespace usuzumi::sim {

/// The number of a material equal to `material`, which is added where there is none.
std::uint32_t material_number(Model& model, const Material& material);

/// Takes the texture off meshes that have no coordinates for it, or such that are not finite or beyond the format's
/// bound after whole repeats of the texture are taken off, and says so in a note each. Coordinates that no texture
/// needs are dropped.
void settle_textures(const std::string& file, Model& model);

/// Adds `more`'s meshes, textures, materials, notes and part files to `all`.
void append_model(Model& all, Model&& more);

}  // namespace usuzumi::sim
