// Writes the golden cases into a bundle (player/bundle.h): what is drawn, never what comes out.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tests/golden/runs.h"
#include "tests/support/scene.h"

namespace usuzumi::golden {

/// Throws std::runtime_error for a text that is longer than a bundle's may be.
std::vector<std::byte> write_bundle(std::span<const scenes::Scene> scenes, std::span<const DeviceRun> runs);

}  // namespace usuzumi::golden
