// Meshes out of the command, for looking at them elsewhere: PLY and Wavefront OBJ.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "firmware/simplify/simplify.h"
#include "hal/vec.h"
#include "sim/cli/joined_mesh.h"

namespace usuzumi::sim {

struct MeshToWrite {
  std::span<const Vec3> positions;
  std::span<const Rgba8> colours;                        // empty or as many as positions; PLY only
  std::span<const std::uint32_t> indices;                // three a face
  std::span<const TexCoord> texture_coordinates = {};    // empty or as many as positions
  std::span<const firmware::MaterialGroup> groups = {};  // with texture coordinates alone
  std::span<const Look> looks = {};                      // as many as groups
  std::span<const Picture> textures = {};
};

/// The files that write_mesh() writes beside `path`: the textures that looks name, as NAME-1.png and so on, and for OBJ
/// the materials, NAME.mtl.
std::vector<std::filesystem::path> files_beside(const std::filesystem::path& path, std::span<const Look> looks);

/// Whether the extension is one that write_mesh() knows: .ply (binary, little-endian) or .obj.
bool is_mesh_file_name(const std::filesystem::path& path);

/// Whether a file of that extension has a place for colours: .ply.
bool keeps_colours(const std::filesystem::path& path);

/// Positions and texture coordinates are written without loss but for t, which runs up in both formats. A PLY names its
/// texture, of which it can have one, in a comment "TextureFile". Textures lose their alpha. Throws Error kUsage for
/// another extension, kCannotWrite.
void write_mesh(const std::filesystem::path& path, const MeshToWrite& mesh);

}  // namespace usuzumi::sim
