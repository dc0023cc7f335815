// Model files into memory: .glb .gltf (glTF 2.0), .obj .ply .stl .off .dae .ac, and glTF 1.0.
#pragma once

#include <chrono>
#include <filesystem>
#include <span>

#include "sim/pack/model.h"

namespace usuzumi::sim {

struct LoadOptions {
  std::chrono::seconds time_limit{300};  // per file; a file that keeps an importer busy for longer is refused
};

inline constexpr const char* kModelExtensions = ".glb .gltf .obj .ply .stl .off .dae .ac";
/// Whether the extension, in whatever case, is one of these.
bool is_model_file_name(const std::filesystem::path& path);

/// Reads one model: node transforms applied, triangles only, every coordinate within the format's bound, every index
/// checked, normals and unique names everywhere, equal vertices (position, packed normal, colour) welded. The importer
/// runs in a process of its own, so that a file that crashes it costs one error line. Throws Error kBadInput.
Model load_model(const std::filesystem::path& path, const LoadOptions& options = {});

/// The same for several files, joined in order; names unique over all of them.
Model load_models(std::span<const std::filesystem::path> paths, const LoadOptions& options = {});

}  // namespace usuzumi::sim
