// Names of meshes: patterns that people type, and what they may have meant.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/pack/model.h"

namespace usuzumi::sim {

/// Whether `text` is `pattern`, in which * stands for any characters (also none) and ? for one byte.
bool matches_pattern(std::string_view pattern, std::string_view text);

/// Whether `pattern` means this mesh: by its unique name, its name in the file, or its node's name.
bool matches_mesh(std::string_view pattern, const Mesh& mesh);

/// Letters to insert, remove or change to make one of the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// "did you mean Wheel, Wheel#2?" from the names closest to `wanted`, or the first few names where none is close.
std::string suggest(std::string_view wanted, std::span<const std::string> names);

/// Makes mesh names unique: #2, #3 … behind the second and later meshes of a name.
void make_names_unique(Model& model);

}  // namespace usuzumi::sim
