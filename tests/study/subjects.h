// What is thinned in the studies: shapes and models whose textures have seams.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/pack/model.h"

namespace usuzumi::study {

struct Subject {
  std::string name;
  sim::Model model;
};

/// A cube whose sides have a texture each, in one mesh.
sim::Model textured_cube();
/// A cylinder whose mantle and caps lie in one texture: a seam along the mantle, a crease around each cap.
sim::Model textured_cylinder();
/// The truck of Debian's assimp-testmodels, textures halved until they are no larger than `most_texels` each way, the
/// primitives of a mesh kept together. Nothing, and a line on stderr, where it is not installed.
std::optional<sim::Model> truck(std::uint32_t most_texels = 512);
/// The sphere of US 6,396,952's example with a map of an earth-like planet.
sim::Model earth();

/// All of these that there are.
std::vector<Subject> subjects();

}  // namespace usuzumi::study
