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

/// Whether `pattern` means the mesh of this unique name. "Wheel" means Wheel, Wheel#2, Wheel#3 … (make_names_unique()),
/// "Wheel#1" the first of them alone, "Wheel#2" the second. A name with * or ? in it is also found by that very name.
bool matches_name(std::string_view pattern, std::string_view name);

/// matches_name(), or the same of the node that places the mesh.
bool matches_mesh(std::string_view pattern, const Mesh& mesh);

/// The rule of matches_name() for every --help.
inline constexpr const char* kNamesHelp =
    "NAME is a mesh's name as usuzumi inspect lists it. Wheel means Wheel and, of several by that name, Wheel#2,\n"
    "Wheel#3 and so on; Wheel#1 means the first of them alone. * stands for any characters, ? for one.";

/// Letters to insert, remove or change to make one of the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// "did you mean Wheel, Wheel#2?" from the names closest to `wanted`, or the first ten names where none is close.
std::string suggest(std::string_view wanted, std::span<const std::string> names);

/// Makes mesh names unique: #2, #3 … behind the second and later meshes of a name.
void make_names_unique(Model& model);

/// Names go into ROM as UTF-8 and into one line of text; formats older than Unicode bring anything.
std::string clean_name(const std::string& name);

}  // namespace usuzumi::sim
