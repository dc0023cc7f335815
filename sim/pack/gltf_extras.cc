#include "sim/pack/gltf_extras.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>

#include "sim/common/error.h"
#include "sim/pack/names.h"
#include "sim/pack/tag_values.h"

namespace usuzumi::sim {
namespace {

constexpr std::size_t kNearlyOurs = 3;  // edits; arbitrary

TagValue tag_value(const tinygltf::Value& v) {
  TagValue value;
  if (v.IsBool())
    value.truth = v.Get<bool>();
  else if (v.IsNumber())
    value.number = v.GetNumberAsDouble();
  else if (v.IsString())
    value.text = v.Get<std::string>();
  return value;
}

}  // namespace

Tags tags_from_extras(const tinygltf::Value& extras, const std::string& file, const std::string& whose, std::vector<std::string>& notes) {
  Tags tags;
  if (!extras.IsObject()) return tags;
  for (const std::string& key : extras.Keys()) {
    if (std::find(kTagKeys.begin(), kTagKeys.end(), key) != kTagKeys.end()) {
      const std::string wrong = set_tag(tags, key, tag_value(extras.Get(key)));
      if (!wrong.empty()) throw Error(ExitCode::kBadInput, fmt::format("{}: {}: {} {}", file, whose, key, wrong));
      continue;
    }
    for (std::string_view ours : kTagKeys)
      if (edit_distance(key, ours) <= kNearlyOurs)
        notes.push_back(fmt::format("{}: {}: property '{}' is not used; did you mean {}?", file, whose, key, ours));
  }
  return tags;
}

}  // namespace usuzumi::sim
