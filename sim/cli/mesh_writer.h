// Meshes out of the command, for looking at them elsewhere: PLY and Wavefront OBJ.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "hal/vec.h"

namespace usuzumi::sim {

struct MeshToWrite {
  std::span<const Vec3> positions;
  std::span<const Rgba8> colours;          // empty or as many as positions; PLY only
  std::span<const std::uint32_t> indices;  // three a face
};

/// Whether the extension is one that write_mesh() knows: .ply (binary, little-endian) or .obj.
bool is_mesh_file_name(const std::filesystem::path& path);

/// Whether a file of that extension has a place for colours: .ply.
bool keeps_colours(const std::filesystem::path& path);

/// Positions are written without loss. Throws Error kUsage for another extension, kCannotWrite.
void write_mesh(const std::filesystem::path& path, const MeshToWrite& mesh);

}  // namespace usuzumi::sim
