#include "sim/pack/method_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "firmware/simplify/vertex_deletion/presets.h"
#include "sim/pack/names.h"

namespace usuzumi::sim {
namespace {

using firmware::EdgeRemovalSettings;
using firmware::Method;
using firmware::VertexDeletionSettings;
using nlohmann::ordered_json;

template <class Settings>
struct Field {
  std::string_view name;
  float Settings::*value;
};

constexpr std::array<Field<EdgeRemovalSettings>, 6> kEdgeRemoval{
    {{"a", &EdgeRemovalSettings::a},
     {"b", &EdgeRemovalSettings::b},
     {"neighbour_weight", &EdgeRemovalSettings::neighbour_weight},
     {"computed_weight", &EdgeRemovalSettings::computed_weight},
     {"user_weight", &EdgeRemovalSettings::user_weight},
     {"boundary_limit", &EdgeRemovalSettings::boundary_limit}}};
constexpr std::array<Field<VertexDeletionSettings>, 10> kVertexDeletion{
    {{"area", &VertexDeletionSettings::area},
     {"move", &VertexDeletionSettings::move},
     {"normal", &VertexDeletionSettings::normal},
     {"largest", &VertexDeletionSettings::largest},
     {"boundary_area", &VertexDeletionSettings::boundary_area},
     {"limit_area", &VertexDeletionSettings::limit_area},
     {"limit_move", &VertexDeletionSettings::limit_move},
     {"limit_normal", &VertexDeletionSettings::limit_normal},
     {"limit_largest", &VertexDeletionSettings::limit_largest},
     {"protrusion_penalty", &VertexDeletionSettings::protrusion_penalty}}};

constexpr std::string_view kPlacement = "placement", kBoundaryAnswer = "boundary_answer", kPreset = "preset";
constexpr std::array<std::string_view, 5> kPlacements{"automatic", "equal-volume", "least-volume", "keep-an-end",
                                                      "midpoint"};
constexpr std::array<std::string_view, 2> kBoundaryAnswers{"refuse", "limit-movement"};
constexpr std::array<std::pair<std::string_view, VertexDeletionSettings>, 3> kPresets{
    {{"flat", firmware::kFlatPreset}, {"curved", firmware::kCurvedPreset}, {"bounded", firmware::kBoundedPreset}}};

template <class List>
bool has_field(const List& fields, std::string_view name) {
  return std::any_of(fields.begin(), fields.end(), [&](const auto& field) { return field.name == name; });
}

template <class List>
std::optional<std::uint32_t> place_in(const List& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - names.begin());
}

std::vector<std::string> all_setting_names() {
  std::vector<std::string> names;
  for (const auto& field : kEdgeRemoval) names.emplace_back(field.name);
  for (std::string_view name : {kPlacement, kBoundaryAnswer}) names.emplace_back(name);
  for (const auto& field : kVertexDeletion) names.emplace_back(field.name);
  names.emplace_back(kPreset);
  return names;
}

/// A choice by name, or its number in `settings`.
template <class List>
std::string set_choice(MethodSettings& settings, const std::string& name, const List& choices,
                       const std::string* text) {
  const auto number = text != nullptr ? place_in(choices, *text) : std::nullopt;
  if (!number) return fmt::format("{} must be one of {}", name, fmt::join(choices, ", "));
  settings.values[name] = *number;
  return "";
}

/// `number` or `text` as the value of setting `name`; neither is there for a value of another kind.
std::string set_value(MethodSettings& settings, const std::string& name, const double* number,
                      const std::string* text) {
  if (name == kPlacement) return set_choice(settings, name, kPlacements, text);
  if (name == kBoundaryAnswer) return set_choice(settings, name, kBoundaryAnswers, text);
  if (name == kPreset) {
    std::vector<std::string_view> names;
    for (const auto& [preset, values] : kPresets) names.push_back(preset);
    if (text == nullptr || !place_in(names, *text))
      return fmt::format("{} must be one of {}", name, fmt::join(names, ", "));
    settings.preset = *text;
    return "";
  }
  if (!has_field(kEdgeRemoval, name) && !has_field(kVertexDeletion, name))
    return fmt::format("{} is not a setting; {}", name, suggest(name, all_setting_names()));
  if (number == nullptr || !(*number >= 0) || *number > static_cast<double>(std::numeric_limits<float>::max()))
    return fmt::format("{} must be a number, 0 or more", name);
  settings.values[name] = *number;
  return "";
}

template <class Settings, class List>
void overlay(Settings& out, const List& fields, const MethodSettings& settings) {
  for (const auto& field : fields)
    if (const auto given = settings.values.find(std::string(field.name)); given != settings.values.end())
      out.*field.value = static_cast<float>(given->second);
}

std::optional<std::uint32_t> choice_of(const MethodSettings& settings, std::string_view name) {
  const auto given = settings.values.find(std::string(name));
  if (given == settings.values.end()) return std::nullopt;
  return static_cast<std::uint32_t>(given->second);
}

/// Whether the setting is one of `method`'s.
bool belongs(Method method, std::string_view name) {
  if (method == Method::kEdgeRemoval)
    return has_field(kEdgeRemoval, name) || name == kPlacement || name == kBoundaryAnswer;
  return method == Method::kVertexDeletion && (has_field(kVertexDeletion, name) || name == kPreset);
}

std::string region_fault(const ordered_json& object, EdgeRegion& out) {
  if (!object.is_object()) return "must be objects like {\"group\": \"rim\", \"value\": 2}";
  bool valued = false, locked = false;
  for (const auto& [key, value] : object.items()) {
    if (key == "group" || key == "material") {
      if (!value.is_string() || value.get<std::string>().empty()) return fmt::format("{} must be a name", key);
      (key == "group" ? out.group : out.material) = value.get<std::string>();
    } else if (key == "value") {
      const double number = value.is_number() ? value.get<double>() : -1;
      if (!(number >= 0) || number > static_cast<double>(std::numeric_limits<float>::max()))
        return "value must be a number, 0 or more";
      out.value = static_cast<float>(number);
      valued = true;
    } else if (key == "locked") {
      if (value != true) return "locked must be true, or left out";
      locked = true;
    } else {
      const std::vector<std::string> known{"group", "material", "value", "locked"};
      return fmt::format("\"{}\" is not known; {}", key, suggest(key, known));
    }
  }
  if (out.group.empty() == out.material.empty()) return "want a group or a material, one of them";
  if (valued == locked) return "want a value or \"locked\": true, one of them";
  if (locked) out.value = firmware::kLockedEdgeValue;
  return "";
}

}  // namespace

std::string_view method_name(Method method) { return kMethodNames[static_cast<std::size_t>(method)]; }

std::optional<Method> method_of(std::string_view name) {
  const auto number = place_in(kMethodNames, name);
  if (!number) return std::nullopt;
  return static_cast<Method>(*number);
}

std::string parse_settings(const std::string& json_text, MethodSettings& out) {
  const ordered_json object = ordered_json::parse(json_text, nullptr, false);
  if (!object.is_object() || object.empty()) return "must be an object of settings, like {\"preset\": \"flat\"}";
  for (const auto& [name, value] : object.items()) {
    const double number = value.is_number() ? value.get<double>() : 0;
    const std::string text = value.is_string() ? value.get<std::string>() : "";
    const std::string wrong =
        set_value(out, name, value.is_number() ? &number : nullptr, value.is_string() ? &text : nullptr);
    if (!wrong.empty()) return "are wrong: " + wrong;
  }
  return "";
}

std::string parse_regions(const std::string& json_text, std::vector<EdgeRegion>& out) {
  const ordered_json list = ordered_json::parse(json_text, nullptr, false);
  if (!list.is_array() || list.empty()) return "must be a list like [{\"group\": \"rim\", \"locked\": true}]";
  for (const ordered_json& object : list) {
    const std::string wrong = region_fault(object, out.emplace_back());
    if (!wrong.empty()) return fmt::format("(number {}) {}", out.size(), wrong);
  }
  return "";
}

std::string set_setting(MethodSettings& settings, const std::string& name, const std::string& value) {
  double number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  const bool is_number = error == std::errc() && end == value.data() + value.size() && std::isfinite(number);
  return set_value(settings, name, is_number ? &number : nullptr, &value);
}

std::string misplaced_setting(Method method, const MethodSettings& settings) {
  const auto fault = [&](std::string_view name) {
    const Method owner = belongs(Method::kEdgeRemoval, name) ? Method::kEdgeRemoval : Method::kVertexDeletion;
    return fmt::format("the setting '{}' is of method {}, not of {}{}", name, method_name(owner), method_name(method),
                       method == Method::kQem && name == kPlacement ? ", whose own is --placement" : "");
  };
  if (!settings.preset.empty() && !belongs(method, kPreset)) return fault(kPreset);
  for (const auto& [name, value] : settings.values)
    if (!belongs(method, name)) return fault(name);
  return "";
}

EdgeRemovalSettings edge_removal_settings(const MethodSettings& settings) {
  EdgeRemovalSettings out;
  overlay(out, kEdgeRemoval, settings);
  if (const auto placement = choice_of(settings, kPlacement))
    out.placement = static_cast<firmware::EdgePlacement>(*placement);
  if (const auto answer = choice_of(settings, kBoundaryAnswer))
    out.boundary_answer = static_cast<firmware::BoundaryAnswer>(*answer);
  return out;
}

VertexDeletionSettings vertex_deletion_settings(const MethodSettings& settings) {
  VertexDeletionSettings out;
  for (const auto& [name, values] : kPresets)
    if (name == settings.preset) out = values;
  overlay(out, kVertexDeletion, settings);
  return out;
}

std::array<std::uint32_t, 10> setting_words(Method method, const MethodSettings& settings) {
  std::array<std::uint32_t, 10> words{};
  const EdgeRemovalSettings edge_removal = edge_removal_settings(settings);
  const VertexDeletionSettings vertex_deletion = vertex_deletion_settings(settings);
  const void* from = method == Method::kEdgeRemoval ? static_cast<const void*>(&edge_removal) : &vertex_deletion;
  std::memcpy(words.data(), from, sizeof words);
  return words;
}

std::vector<std::pair<std::string, std::string>> spelled_settings(const EdgeRemovalSettings& settings) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const auto& field : kEdgeRemoval) out.emplace_back(field.name, fmt::format("{:g}", settings.*field.value));
  out.emplace_back(kPlacement, kPlacements[static_cast<std::size_t>(settings.placement)]);
  out.emplace_back(kBoundaryAnswer, kBoundaryAnswers[static_cast<std::size_t>(settings.boundary_answer)]);
  return out;
}

std::vector<std::pair<std::string, std::string>> spelled_settings(const VertexDeletionSettings& settings) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const auto& field : kVertexDeletion) out.emplace_back(field.name, fmt::format("{:g}", settings.*field.value));
  return out;
}

}  // namespace usuzumi::sim
