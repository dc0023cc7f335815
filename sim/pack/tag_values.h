// The words in which authors say what may be thinned: glTF extras, sidecar files and options share them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "sim/pack/model.h"

namespace usuzumi::sim {

inline constexpr std::string_view kLevelKey = "thinning_level", kQuotaKey = "face_quota", kAreaKey = "area_threshold_px",
                                  kTelltaleKey = "telltale";
inline constexpr std::array<std::string_view, 4> kTagKeys{kLevelKey, kQuotaKey, kAreaKey, kTelltaleKey};

/// A value as JSON or an option can give it.
struct TagValue {
  std::optional<double> number;
  std::optional<bool> truth;
  std::optional<std::string> text;  // an option's words are text; "3" is then a number as well
};

/// Reads `value` for `key` (one of kTagKeys) into `tags`. Returns "" or what is wrong with it: "must be 0 to 5, not 9".
std::string set_tag(Tags& tags, std::string_view key, const TagValue& value);

}  // namespace usuzumi::sim
