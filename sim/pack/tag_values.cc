#include "sim/pack/tag_values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

#include "firmware/layers/layer_format.h"
#include "sim/common/error.h"
#include "sim/pack/method_settings.h"
#include "sim/pack/names.h"

namespace usuzumi::sim {
namespace {

/// Letters to change in a property's name, of which we have `ours`, for it to be nearly that one. Arbitrary; short
/// names resemble many.
std::size_t nearly(std::string_view ours) { return std::min<std::size_t>(3, ours.size() / 3); }

/// All of `text` as a plain decimal number: no sign but -, no hexadecimal, no infinity.
std::optional<double> parse_number(std::string_view text) {
  if (text.empty() || text.find_first_not_of("0123456789.-+eE") != std::string_view::npos) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string spelled(const TagValue& v) {
  if (v.text) return fmt::format("\"{}\"", *v.text);
  if (v.number) return fmt::format("{}", *v.number);
  if (v.truth) return *v.truth ? "true" : "false";
  if (v.structure) return *v.structure;
  return "something else";
}

std::optional<double> number_of(const TagValue& v) {
  return v.number ? v.number : (v.text ? parse_number(*v.text) : std::nullopt);
}

bool is_count(double d) { return d >= 0 && d <= std::numeric_limits<std::uint32_t>::max() && d == std::floor(d); }

std::optional<FaceQuota> parse_quota(const TagValue& v) {
  if (v.text)
    if (const auto share = parse_share(*v.text)) return FaceQuota{firmware::format::QuotaKind::kMillionths, *share};
  const auto count = number_of(v);
  if (!count || !is_count(*count) || *count < 1) return std::nullopt;
  return FaceQuota{firmware::format::QuotaKind::kFaces, static_cast<std::uint32_t>(*count)};
}

/// Blender writes a custom property that is a checkbox as true or false, an older one as 0 or 1.
std::optional<bool> parse_truth(const TagValue& v) {
  if (v.truth) return v.truth;
  if (v.text && (*v.text == "true" || *v.text == "false")) return *v.text == "true";
  const auto number = number_of(v);
  if (number && (*number == 0 || *number == 1)) return *number == 1;
  return std::nullopt;
}

/// JSON of an object or a list. Custom properties of some tools hold text alone, which may then be JSON.
std::string structure_of(const TagValue& v) {
  if (v.structure) return *v.structure;
  const bool looks_so = v.text && !v.text->empty() && (v.text->front() == '{' || v.text->front() == '[');
  return looks_so ? *v.text : "null";
}

/// The entries of "100, 60" or "[100, 60]".
std::vector<std::string_view> entries_of(std::string_view list) {
  if (list.size() >= 2 && list.front() == '[' && list.back() == ']') list = list.substr(1, list.size() - 2);
  std::vector<std::string_view> entries;
  for (bool more = true; more;) {
    const std::size_t comma = list.find(',');
    std::string_view entry = list.substr(0, comma);
    entry.remove_prefix(std::min(entry.find_first_not_of(' '), entry.size()));
    entry = entry.substr(0, entry.find_last_not_of(' ') + 1);
    entries.push_back(entry);
    more = comma != std::string_view::npos;
    if (more) list.remove_prefix(comma + 1);
  }
  return entries;
}

/// A list of per cent, falling from 100, in millionths. Returns "" or what is wrong with it.
std::string parse_layers(const TagValue& v, std::vector<std::uint32_t>& out) {
  const std::optional<std::string>& list = v.structure ? v.structure : v.text;
  const std::vector<std::string_view> entries = entries_of(list ? std::string_view(*list) : std::string_view());
  constexpr std::string_view kLike = "per cent of the faces, falling from 100, like [100, 60, 36, 21.6]";
  if (entries.size() < 2) return fmt::format("must be two layers or more in {}, not {}", kLike, spelled(v));
  if (entries.size() > firmware::format::kMaxLayers)
    return fmt::format("must be {} layers at most, not {}", firmware::format::kMaxLayers, entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::string share = std::string(entries[i]) + (entries[i].ends_with('%') ? "" : "%");
    const auto millionths = parse_share(share);
    if (!millionths)
      return fmt::format("must be {}; layer {} is {}, no number above 0 and up to 100", kLike, i + 1,
                         entries[i].empty() ? "nothing" : entries[i]);
    if (i == 0 && *millionths != 1'000'000)
      return fmt::format("must begin with 100, the whole mesh, and not with {}", entries[i]);
    if (i > 0 && *millionths >= out.back())
      return fmt::format("must fall from layer to layer; layer {}, {}, is not below {}", i + 1, entries[i],
                         entries[i - 1]);
    out.push_back(*millionths);
  }
  return "";
}

}  // namespace

std::optional<std::uint32_t> parse_share(std::string_view text) {
  if (text.empty() || text.back() != '%') return std::nullopt;
  const std::optional<double> percent = parse_number(text.substr(0, text.size() - 1));
  if (!percent || !(*percent > 0) || *percent > 100) return std::nullopt;
  const auto millionths = static_cast<std::uint32_t>(*percent * 10'000 + 0.5);
  if (millionths == 0) return std::nullopt;
  return millionths;
}

std::string set_tag(Tags& tags, std::string_view key, const TagValue& value) {
  if (key == kLevelKey) {
    const auto level = number_of(value);
    if (!level || !is_count(*level) || *level > 5)
      return fmt::format("must be 0 (unset), 1 (keep), 2 (delete), 3 (collapse), 4 (point) or 5 (line), not {}",
                         spelled(value));
    tags.level = static_cast<std::uint32_t>(*level);
  } else if (key == kQuotaKey) {
    tags.quota = parse_quota(value);
    if (!tags.quota)
      return fmt::format("must be a number of faces from 1, or a share like \"25%\" up to 100%, not {}",
                         spelled(value));
  } else if (key == kAreaKey) {
    const auto area = number_of(value);
    if (!area || !(*area >= 0) || *area > static_cast<double>(std::numeric_limits<float>::max()))
      return fmt::format("must be an area in pixels, 0 or more, not {}", spelled(value));
    tags.area_threshold_px = static_cast<float>(*area);
  } else if (key == kTelltaleKey) {
    tags.telltale = parse_truth(value);
    if (!tags.telltale) return fmt::format("must be true or false, not {}", spelled(value));
  } else if (key == kMethodKey) {
    tags.method = value.text ? method_of(*value.text) : std::nullopt;
    if (!tags.method) return fmt::format("must be one of {}, not {}", fmt::join(kMethodNames, ", "), spelled(value));
  } else if (key == kSettingsKey) {
    return parse_settings(structure_of(value), tags.settings.emplace());
  } else if (key == kRegionsKey) {
    return parse_regions(structure_of(value), tags.regions.emplace());
  } else if (key == kLayersKey) {
    return parse_layers(value, tags.layers.emplace());
  } else {
    return "is not a thinning property";
  }
  return "";
}

Tags tags_from_extras(const std::vector<std::pair<std::string, TagValue>>& extras, const std::string& file,
                      const std::string& whose, std::vector<std::string>& notes) {
  Tags tags;
  for (const auto& [key, value] : extras) {
    if (std::find(kTagKeys.begin(), kTagKeys.end(), key) != kTagKeys.end()) {
      const std::string wrong = set_tag(tags, key, value);
      if (!wrong.empty()) throw Error(ExitCode::kBadInput, fmt::format("{}: {}: {} {}", file, whose, key, wrong));
      continue;
    }
    for (std::string_view ours : kTagKeys)
      if (edit_distance(key, ours) <= nearly(ours))
        notes.push_back(fmt::format("{}: {}: property '{}' is not used; did you mean {}?", file, whose, key, ours));
  }
  return tags;
}

}  // namespace usuzumi::sim
