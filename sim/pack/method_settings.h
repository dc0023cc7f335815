// Thinning methods and their settings in the words of authors: glTF extras, sidecar files, options.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "firmware/simplify/simplify.h"
#include "sim/pack/model.h"

namespace usuzumi::sim {

/// By number of firmware::Method.
inline constexpr std::array<std::string_view, firmware::kMethodCount> kMethodNames{"qem", "edge-removal", "half-edge",
                                                                                   "vertex-deletion"};
std::string_view method_name(firmware::Method method);
std::optional<firmware::Method> method_of(std::string_view name);

/// Reads an object like {"a": 1, "placement": "midpoint"} or {"preset": "flat"} into `out`. Names are those of
/// EdgeRemovalSettings and VertexDeletionSettings. Returns "" or what is wrong with it.
std::string parse_settings(const std::string& json_text, MethodSettings& out);

/// Reads a list like [{"group": "rim", "value": 2}, {"material": "glass", "locked": true}]. Returns "" or what is
/// wrong.
std::string parse_regions(const std::string& json_text, std::vector<EdgeRegion>& out);

/// One setting by name, its value as an option has it ("0.5", "midpoint"). Returns "" or what is wrong with it.
std::string set_setting(MethodSettings& settings, const std::string& name, const std::string& value);

/// "" where all of them belong to `method`, or what does not: "has the setting 'area', which is vertex-deletion's".
std::string misplaced_setting(firmware::Method method, const MethodSettings& settings);

/// The defaults with the author's settings in their places. Settings of the other method are passed over.
firmware::EdgeRemovalSettings edge_removal_settings(const MethodSettings& settings);
firmware::VertexDeletionSettings vertex_deletion_settings(const MethodSettings& settings);

/// The words of section METH. `method` is one that has settings.
std::array<std::uint32_t, 10> setting_words(firmware::Method method, const MethodSettings& settings);

/// Every setting of `method` by name, in the order of its struct, with its value in words that parse_settings() takes.
std::vector<std::pair<std::string, std::string>> spelled_settings(const firmware::EdgeRemovalSettings& settings);
std::vector<std::pair<std::string, std::string>> spelled_settings(const firmware::VertexDeletionSettings& settings);

}  // namespace usuzumi::sim
