// What is in section LAYR of a ROM, for people and for scripts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "firmware/drawing_data/drawing_data.h"

namespace usuzumi::sim {

struct LayerTotals {
  std::size_t meshes = 0;   // that have layers
  std::uint64_t bytes = 0;  // of their chains
};
LayerTotals layer_totals(const firmware::DrawingData& data);

/// null, or {"bytes": …, "steps": …, "added_vertices": …, "layers": [{"quota": "60%", "faces": …}, …]}.
nlohmann::ordered_json layers_json(const firmware::MeshView& mesh);

/// A line for each mesh that has layers, and one for all where there are several.
std::string layers_text(const firmware::DrawingData& data);

}  // namespace usuzumi::sim
