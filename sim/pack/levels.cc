#include "sim/pack/levels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "sim/common/error.h"
#include "sim/common/strict_json.h"
#include "sim/pack/edge_regions.h"
#include "sim/pack/method_settings.h"
#include "sim/pack/names.h"
#include "sim/pack/tag_values.h"

namespace usuzumi::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kLevelDelete = 2, kLevelCollapse = 3;

std::vector<std::string> all_names(const Model& model) {
  std::vector<std::string> names;
  for (const Mesh& mesh : model.meshes) {
    names.push_back(mesh.name);
    if (!mesh.node_name.empty()) names.push_back(mesh.node_name);
  }
  return names;
}

bool is_for(const TagRule& rule, const Mesh& mesh) { return rule.for_all_layered || matches_mesh(rule.pattern, mesh); }

/// The rules' tags by mesh, later rules over earlier ones.
std::vector<Tags> matched_tags(const Model& model, std::span<const TagRule> rules, ExitCode code) {
  std::vector<Tags> tags(model.meshes.size());
  for (const TagRule& rule : rules) {
    bool used = false;
    for (std::size_t m = 0; m < model.meshes.size(); ++m) {
      if (!is_for(rule, model.meshes[m])) continue;
      tags[m] = merge_tags(rule.tags, tags[m]);
      used = true;
    }
    if (!used)
      throw Error(code, fmt::format("{}: no mesh is named '{}'; {}", rule.origin, rule.pattern,
                                    suggest(rule.pattern, all_names(model))));
  }
  return tags;
}

void note_unused_properties(Model& model) {
  for (const Mesh& mesh : model.meshes) {
    const std::uint32_t level = mesh.tags.level.value_or(0);
    auto note = [&](std::string_view key, std::string_view used_by) {
      model.notes.push_back(
          fmt::format("mesh '{}': {} is kept in ROM, but level {} does not use it; it is for level {}", mesh.name, key,
                      level, used_by));
    };
    if (mesh.tags.quota && level != kLevelCollapse) note(kQuotaKey, "3");
    if (mesh.tags.area_threshold_px && level < kLevelDelete) note(kAreaKey, "2 to 5");
    if (mesh.tags.method && level != kLevelCollapse) note(kMethodKey, "3");
  }
}

/// Layers are made of meshes of level 3 alone. Where they were given by a mesh's name, a note says so.
void settle_layers(Model& model, std::span<const TagRule> options) {
  const TagRule* for_all = nullptr;
  for (const TagRule& rule : options)
    if (rule.for_all_layered) for_all = &rule;
  bool any = false;
  for (Mesh& mesh : model.meshes) {
    const std::uint32_t level = mesh.tags.level.value_or(0);
    any = any || level == kLevelCollapse;
    if (!mesh.tags.layers || level == kLevelCollapse) continue;
    mesh.tags.layers.reset();
    const auto from = std::find_if(options.rbegin(), options.rend(),
                                   [&](const TagRule& rule) { return rule.tags.layers && is_for(rule, mesh); });
    if (from != options.rend() && from->for_all_layered) continue;
    model.notes.push_back(fmt::format("mesh '{}': {} are left out: they are for level 3, and its level is {}",
                                      mesh.name, kLayersKey, level));
  }
  if (for_all != nullptr && !any)
    model.notes.push_back(fmt::format("{} has no effect: no mesh is of level 3", for_all->origin));
}

/// Settings mean something to their method alone; who gives both must have them agree.
void check_settings(const Model& model) {
  for (const Mesh& mesh : model.meshes) {
    if (!mesh.tags.settings) continue;
    const std::string wrong = misplaced_setting(mesh.tags.method.value_or(firmware::Method::kQem), *mesh.tags.settings);
    if (!wrong.empty())
      throw Error(ExitCode::kBadInput,
                  fmt::format("mesh '{}': {}; give it that method or leave the setting out", mesh.name, wrong));
  }
}

TagRule value_rule(std::string_view option, const std::string& argument, const std::string& pattern,
                   std::string_view key, const std::string& value) {
  TagRule rule{pattern, {}, fmt::format("{} {}", option, argument)};
  const std::string wrong = set_tag(rule.tags, key, TagValue{{}, {}, value});
  if (!wrong.empty()) throw Error(ExitCode::kUsage, fmt::format("{}: the value {}", rule.origin, wrong));
  return rule;
}

}  // namespace

TagRule rule_from_option(std::string_view option, const std::string& argument, std::string_view key) {
  const std::size_t equals = argument.rfind('=');
  if (equals == std::string::npos || equals == 0)
    throw Error(ExitCode::kUsage, fmt::format("{} {}: wants NAME=VALUE, with a mesh's name (* and ? stand for others)",
                                              option, argument));
  return value_rule(option, argument, argument.substr(0, equals), key, argument.substr(equals + 1));
}

TagRule layers_rule(const std::string& argument) {
  constexpr std::string_view kOption = "--layers";
  if (argument.find('=') != std::string::npos) return rule_from_option(kOption, argument, kLayersKey);
  TagRule rule = value_rule(kOption, argument, "", kLayersKey, argument);
  rule.for_all_layered = true;
  return rule;
}

std::vector<TagRule> read_sidecar(const fs::path& path) {
  const std::string file = path.string();
  auto refuse = [&](const std::string& why) { throw Error(ExitCode::kBadInput, fmt::format("{}: {}", file, why)); };
  const nlohmann::ordered_json root = read_strict_json(path);  // later rules win, so their order matters
  if (!root.is_object() || !root.contains("meshes") || !root["meshes"].is_object())
    refuse("a sidecar is {\"meshes\": {\"NAME\": {\"thinning_level\": 3, …}}}; see usuzumi pack --help");
  for (const auto& [key, value] : root.items())
    if (key != "meshes") refuse(fmt::format("\"{}\" is not known here; only \"meshes\" is", key));
  if (root["meshes"].empty()) refuse("\"meshes\" names no mesh, so the file does nothing; fill it in or leave it out");
  const std::vector<std::string> known(kTagKeys.begin(), kTagKeys.end());
  std::vector<TagRule> rules;
  for (const auto& [pattern, properties] : root["meshes"].items()) {
    TagRule rule{pattern, {}, fmt::format("{}: meshes.{}", file, pattern)};
    if (!properties.is_object()) refuse(fmt::format("meshes.{} must be an object of properties", pattern));
    if (properties.empty())
      refuse(fmt::format("meshes.{} gives no property; give one of {}", pattern, fmt::join(known, ", ")));
    for (const auto& [key, value] : properties.items()) {
      if (std::find(known.begin(), known.end(), key) == known.end())
        refuse(fmt::format("meshes.{}: property \"{}\" is not known; {}", pattern, key, suggest(key, known)));
      const std::string wrong = set_tag(rule.tags, key, tag_value_of(value));
      if (!wrong.empty()) refuse(fmt::format("meshes.{}: {} {}", pattern, key, wrong));
    }
    rules.push_back(std::move(rule));
  }
  return rules;
}

void apply_tags(Model& model, const TagSources& sources) {
  const std::vector<Tags> options = matched_tags(model, sources.options, ExitCode::kUsage);
  const std::vector<Tags> sidecars = matched_tags(model, sources.sidecars, ExitCode::kBadInput);
  Tags fallback;
  fallback.level = sources.default_level;
  bool any_level = false, any_default = false;
  for (std::size_t m = 0; m < model.meshes.size(); ++m) {
    Tags& tags = model.meshes[m].tags;
    tags = merge_tags(merge_tags(options[m], sidecars[m]), tags);
    any_default = any_default || !tags.level;
    tags = merge_tags(tags, fallback);
    any_level = any_level || tags.level;
  }
  // First, so that no crowd of other notes hides it.
  if (fallback.level && !any_default && !model.meshes.empty())
    model.notes.insert(
        model.notes.begin(),
        fmt::format("--default-level {} has no effect: every mesh has a level already", *fallback.level));
  check_settings(model);
  apply_regions(model);
  note_unused_properties(model);
  settle_layers(model, sources.options);
  if (!any_level && !model.meshes.empty())
    model.notes.push_back(
        "no mesh has a thinning level, so all are kept whole. Give --level NAME=3 or --default-level 3, or in Blender "
        "give the "
        "objects a custom property thinning_level and tick Export glTF > Include > Data > Custom Properties");
}

}  // namespace usuzumi::sim
