// Scenes' pictures as PNG files.
#pragma once

#include <filesystem>

#include "tests/support/scene.h"

namespace usuzumi::golden {

/// Both throw an exception with the path and the reason.
scenes::RgbPicture read_png(const std::filesystem::path& path);
void write_png(const std::filesystem::path& path, const scenes::RgbPicture& picture);

}  // namespace usuzumi::golden
