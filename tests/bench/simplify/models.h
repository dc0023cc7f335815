// The models that thinning is measured on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/support/mesh_shapes.h"

namespace usuzumi::bench {

struct Model {
  std::string name;
  testing::Mesh mesh;  // positions and indices only, all meshes joined, welded
};

/// nefertiti, spot, fish and sphere182 from the folder USUZUMI_MODELS (by default ../shared/models beside the project),
/// and two assemblies from Debian's assimp-testmodels. Says on stderr which are absent.
std::vector<Model> load_models();

/// A model file read by assimp (".xz" unpacked first into `cache`), joined and welded; nothing where it cannot be read.
std::optional<testing::Mesh> load_model(const std::string& path, const std::string& cache);

}  // namespace usuzumi::bench
