// What a ROM says of how meshes look and how they are thinned, for inspect.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "firmware/drawing_data/drawing_data.h"

namespace usuzumi::sim {

/// "#rrggbb", or "#rrggbbaa" where it is not opaque.
std::string colour_label(Rgba8 colour);

/// The keys of a mesh: texture coordinates, material or groups, method, settings, edge values.
void add_appearance(nlohmann::ordered_json& mesh_json, const firmware::MeshView& mesh);
/// Lists of all materials and textures.
nlohmann::ordered_json materials_json(const firmware::DrawingData& data);
nlohmann::ordered_json textures_json(const firmware::DrawingData& data);

/// The same for people: tables of textures and materials, then a line for every mesh that has more than one material or
/// a method of its own. Empty where there is nothing to say.
std::string appearance_text(const firmware::DrawingData& data);

/// "1", "1,2" (of a mesh with groups) or "-": materials by number from 1.
std::string material_label(const firmware::MeshView& mesh);

}  // namespace usuzumi::sim
