// Scene files: solids, and models beside them, in JSON that people write.
//
//     {"solids": [{"name": "head", "kind": "sphere", "diameter": 2, "colour": "#c08040",
//                  "position": [0, 3, 1], "rotation_deg": [0, 90, 0], "scale": [1, 0.9, 1]}, ...],
//      "models": ["truck.glb"],
//      "view_candidates": [[1, 0, 0], ...],
//      "detail": {"sphere": [[16, 8], [10, 5], [8, 4]], "hemisphere": [[16, 4], [7, 4], [8, 2]], "round": [16, 12, 8]}}
//
// A solid is scaled, turned about x, then y, then z, and moved; or it has "transform", twelve numbers, row by row.
#pragma once

#include <filesystem>
#include <vector>

#include "sim/pack/model.h"

namespace usuzumi::sim {

struct SceneFile {
  Model model;                                // its solids, and nothing else
  std::vector<std::filesystem::path> models;  // where they lie, by the scene file's folder
};

bool is_scene_file_name(const std::filesystem::path& path);

/// Throws Error kBadInput with the solid's number or name.
SceneFile read_scene_file(const std::filesystem::path& path);

}  // namespace usuzumi::sim
