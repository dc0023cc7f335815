// Who may be thinned, and how far: authors' wishes from options, sidecar files and the model itself, brought together.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/pack/model.h"

namespace usuzumi::sim {

/// Tags for the meshes whose name matches `pattern` (names.h).
struct TagRule {
  std::string pattern;
  Tags tags;
  std::string origin;            // for messages: "--level Wheel*=3", "car.json: meshes.Wheel*"
  bool for_all_layered = false;  // no pattern: for every mesh that layers are made of, which is of level 3
};

/// `option` is "--level" and the like, `argument` "NAME=VALUE" (split at the last '='), `key` one of kTagKeys.
/// Throws Error kUsage.
TagRule rule_from_option(std::string_view option, const std::string& argument, std::string_view key);

/// The same of "--layers", whose argument may do without "NAME=": it is then for every mesh of level 3.
TagRule layers_rule(const std::string& argument);

/// {"meshes": {"pattern": {"thinning_level": 3, "face_quota": "25%", "area_threshold_px": 400, "telltale": true,
/// "method": "edge-removal", "method_settings": {"a": 2}, "regions": [{"group": "rim", "locked": true}],
/// "layers": [100, 60, 36]}}}; anything else in the file is an error. Throws Error kBadInput.
std::vector<TagRule> read_sidecar(const std::filesystem::path& path);

struct TagSources {
  std::span<const TagRule> options;            // strongest; a later rule wins over an earlier one
  std::span<const TagRule> sidecars;           // over what the model says itself
  std::optional<std::uint32_t> default_level;  // of meshes whose level nobody gives
};

/// Sets every mesh's tags, and its edge values from regions. A rule that matches no mesh is an error: kUsage for
/// options, kBadInput for sidecars. Adds notes about properties that the mesh's level or method does not use, and where
/// no mesh has a level. Settings of another method than the mesh's and regions of nothing are kBadInput.
void apply_tags(Model& model, const TagSources& sources);

}  // namespace usuzumi::sim
