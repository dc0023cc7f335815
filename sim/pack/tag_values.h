// The words in which authors say what may be thinned: glTF extras, sidecar files and options share them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/pack/model.h"

namespace usuzumi::sim {

inline constexpr std::string_view kLevelKey = "thinning_level", kQuotaKey = "face_quota",
                                  kAreaKey = "area_threshold_px", kTelltaleKey = "telltale", kMethodKey = "method",
                                  kSettingsKey = "method_settings", kRegionsKey = "regions", kLayersKey = "layers";
inline constexpr std::array<std::string_view, 8> kTagKeys{kLevelKey,  kQuotaKey,    kAreaKey,    kTelltaleKey,
                                                          kMethodKey, kSettingsKey, kRegionsKey, kLayersKey};

/// A value as JSON or an option can give it.
struct TagValue {
  std::optional<double> number;
  std::optional<bool> truth;
  std::optional<std::string> text;         // an option's words are text; "3" is then a number as well
  std::optional<std::string> structure{};  // JSON of an object or a list
};

/// `json` is nlohmann::json or ordered_json.
template <class Json>
TagValue tag_value_of(const Json& json) {
  TagValue value;
  if (json.is_boolean()) value.truth = json.template get<bool>();
  else if (json.is_number()) value.number = json.template get<double>();
  else if (json.is_string()) value.text = json.template get<std::string>();
  else if (json.is_structured()) value.structure = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return value;
}

/// "25%" in millionths; nullopt for what is not above 0 and up to 100 %.
std::optional<std::uint32_t> parse_share(std::string_view text);

/// Reads `value` for `key` (one of kTagKeys) into `tags`. Returns "" or what is wrong with it: "must be 0 to 5, not 9".
std::string set_tag(Tags& tags, std::string_view key, const TagValue& value);

/// The tags among the extras of a glTF node or mesh (Blender's custom properties). Other keys are other people's and
/// are left alone, but one that is nearly a key of ours is told of in `notes`. `whose` ("node 'Leaf'") names the place.
/// Throws Error kBadInput for a value that cannot be.
Tags tags_from_extras(const std::vector<std::pair<std::string, TagValue>>& extras, const std::string& file,
                      const std::string& whose, std::vector<std::string>& notes);

}  // namespace usuzumi::sim
