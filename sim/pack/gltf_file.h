// A glTF file before any importer sees it: its JSON, its version, and what in it cannot be read here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/pack/model.h"
#include "sim/pack/transform.h"

namespace usuzumi::sim {

/// What glTF 1.0 says of a node or mesh beside its geometry, which assimp does not hand on.
struct Gltf1Label {
  std::string name;  // empty where the file has none
  Tags tags;
  std::optional<Transform> local;  // a node's, where it is given as translation, rotation and scale
};

struct GltfFile {
  std::vector<std::byte> bytes;
  bool binary = false;    // .glb
  int version_major = 2;  // 1 or 2
  std::map<std::string, std::uint64_t>
      buffer_files;  // of buffers that lie in files beside: name -> bytes the buffer takes of it
  std::map<std::string, Gltf1Label> gltf1_nodes, gltf1_meshes;  // glTF 1.0 only, by identifier
  std::map<std::string, std::string> gltf1_materials;           // the same; names
  std::vector<std::string> notes;
};

/// Reads `path` and checks, without following it into accessors: container and JSON are whole, the version is 1 or 2,
/// every required extension is known here, the files of all buffers are there. Throws Error kBadInput that says what to
/// do.
GltfFile open_gltf(const std::filesystem::path& path);

}  // namespace usuzumi::sim
