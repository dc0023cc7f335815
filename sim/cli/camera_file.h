// Camera paths from a JSON file: what `usuzumi run --camera` reads.
#pragma once

#include <filesystem>
#include <vector>

#include "firmware/scene/camera.h"

namespace usuzumi::sim {

/// One camera per frame. The file is one object, or {"frames": [object, ...]}; an object has "eye" and "target" (three
/// numbers each) and may have "up", "fov_y_deg", "near" and "far". Near and far default to what holds `bounds`.
/// Throws Error kBadInput with the frame's number.
std::vector<firmware::Camera> read_camera_file(const std::filesystem::path& path, const firmware::Bounds& bounds);

}  // namespace usuzumi::sim
