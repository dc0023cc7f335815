// JSON files that people write: sidecars and camera paths.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace usuzumi::sim {

/// The file's value, its objects in the order in which they are written. Of two equal names in one object the parser
/// would keep one and not say so: that is an error here. Throws Error kBadInput, also above 64 MiB.
nlohmann::ordered_json read_strict_json(const std::filesystem::path& path);

}  // namespace usuzumi::sim
