// The solids of a ROM, for inspect.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "firmware/drawing_data/drawing_data.h"

namespace usuzumi::sim {

/// A list of name, kind, its sizes by name, colour and transform; empty where there are none.
nlohmann::ordered_json solids_json(const firmware::DrawingData& data);

/// A table, and how curved surfaces are divided; empty where there are none.
std::string solids_text(const firmware::DrawingData& data);

}  // namespace usuzumi::sim
