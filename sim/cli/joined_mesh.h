// All meshes of a model or a ROM as one surface, for thin and for looking at them elsewhere.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/simplify/simplify.h"
#include "hal/vec.h"
#include "sim/pack/model.h"

namespace usuzumi::sim {

/// What the faces of one group are covered with.
struct Look {
  std::optional<std::uint32_t> texture;  // number in JoinedMesh::textures
  Rgba8 base_colour{};
  friend bool operator==(const Look&, const Look&) = default;
};

struct JoinedMesh {
  std::vector<Vec3> positions;
  std::vector<Rgba8> colours;                 // where asked for, as many as positions
  std::vector<TexCoord> texture_coordinates;  // where textures are asked for and there are any
  std::vector<float> edge_values;             // where a ROM has any
  std::vector<std::uint32_t> indices;
  std::vector<firmware::MaterialGroup> groups;  // by look, in the order of their first face; empty without textures
  std::vector<Look> looks;                      // as many as groups
  std::vector<Picture> textures;
  std::vector<std::filesystem::path> files;  // that were read
  std::vector<std::string> notes;            // what was left out; where textures are asked for: what became of them
};

struct JoinOptions {
  bool colours = false;
  bool textures = false;
};

/// A vertex per place; per place and colour, texture coordinate and look where these are asked for. Faces with two
/// corners at one place are left out. Throws Error kBadInput.
JoinedMesh load_joined(const std::filesystem::path& path, const JoinOptions& options);

}  // namespace usuzumi::sim
