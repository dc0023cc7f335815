// The two importers behind load_model. Both may crash on damaged files: they run isolated (isolate.h).
#pragma once

#include <filesystem>

#include "sim/pack/gltf_file.h"
#include "sim/pack/model.h"

namespace usuzumi::sim {

/// glTF 2.0 by tinygltf: every primitive of every mesh that a node of the default scene places becomes a mesh, with
/// node transforms applied, strips and fans taken apart, extras read (node over mesh). Throws Error kBadInput.
Model import_gltf(const std::filesystem::path& path, const GltfFile& file);

/// .obj .ply .stl .off .dae .ac and glTF 1.0 by assimp: polygons cut into triangles, node transforms applied. Of
/// glTF 1.0 (`gltf1`) the nodes' transforms come from the file itself where it says them in parts.
Model import_assimp(const std::filesystem::path& path, const GltfFile* gltf1 = nullptr);

}  // namespace usuzumi::sim
