#include "sim/cli/policy_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "sim/cli/option_values.h"
#include "sim/common/error.h"
#include "sim/pack/names.h"

namespace usuzumi::sim {
namespace {

using firmware::Policy;
using firmware::PolicyKind;

constexpr std::uint64_t kMostPixels = 1u << 24;  // an area as exact as a single-precision number holds it
constexpr std::uint64_t kMostSeed = 0xFFFFFFFF;

[[noreturn]] void refuse(const std::string& word, const std::string& why) {
  throw Error(ExitCode::kUsage, fmt::format("--policy {}: {}", word, why));
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (;;) {
    const auto at = text.find(separator);
    parts.emplace_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

/// Numbers of the meshes, of whatever level, whose name matches one of the patterns; rising.
std::vector<std::uint32_t> named_meshes(const std::string& word, std::string_view patterns, const firmware::DrawingData& data) {
  std::vector<std::string> names;
  data.for_each_mesh([&](const firmware::MeshView& mesh) { names.emplace_back(mesh.name); });
  std::vector<std::uint32_t> numbers;
  for (const std::string& pattern : split(patterns, ',')) {
    const std::size_t before = numbers.size();
    for (std::uint32_t n = 0; n < names.size(); ++n)
      if (matches_pattern(pattern, names[n])) numbers.push_back(n);
    if (numbers.size() == before) refuse(word, fmt::format("no mesh is called {}; {}", pattern, suggest(pattern, names)));
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

void set_random(const std::string& word, std::string_view argument, Policy& policy) {
  const auto parts = split(argument, ':');
  if (parts.size() > 2 || parts[0].empty() || parts[0].back() != '%') refuse(word, "must be random:SHARE% or random:SHARE%:SEED, e.g. random:50%:7");
  const FaceQuota share = quota_option("--policy", parts[0]);
  policy.kind = PolicyKind::kRandom;
  policy.random_millionths = share.value;
  if (parts.size() == 1) return;
  const auto seed = parse_whole_number(parts[1], kMostSeed);
  if (!seed) refuse(word, fmt::format("SEED must be a whole number up to {}", kMostSeed));
  policy.seed = static_cast<std::uint32_t>(*seed);
}

}  // namespace

PolicyOptions::PolicyOptions(std::span<const std::string> words, const firmware::DrawingData& data) {
  for (const std::string& word : words) parse(word, data);
}

void PolicyOptions::parse(const std::string& word, const firmware::DrawingData& data) {
  std::string_view rest = word;
  bool for_delete = true, for_collapse = true;
  if (rest.starts_with("2=") || rest.starts_with("3=")) {
    for_delete = rest[0] == '2';
    for_collapse = !for_delete;
    rest.remove_prefix(2);
  }
  const auto colon = rest.find(':');
  const std::string_view name = rest.substr(0, colon);
  const std::string_view argument = colon == std::string_view::npos ? std::string_view{} : rest.substr(colon + 1);
  Policy policy;
  std::vector<std::uint32_t> chosen;
  if (name == "always" && colon == std::string_view::npos) {
    policy.kind = PolicyKind::kAlways;
  } else if (name == "below-area") {
    policy.kind = PolicyKind::kBelowArea;
    const auto pixels = parse_whole_number(argument, kMostPixels);
    if (!pixels) refuse(word, fmt::format("PIXELS must be a whole number up to {}", kMostPixels));
    policy.area_threshold_px = static_cast<float>(*pixels);
  } else if (name == "chosen" && !argument.empty()) {
    policy.kind = PolicyKind::kChosen;
    chosen = named_meshes(word, argument, data);
  } else if (name == "random") {
    set_random(word, argument, policy);
  } else {
    refuse(word, "must be always, below-area:PIXELS, chosen:NAME[,NAME...] or random:SHARE%[:SEED], with 2= or 3= before it for one level");
  }
  if (for_delete) delete_policy_ = policy, chosen_for_delete_ = chosen;
  if (for_collapse) collapse_policy_ = policy, chosen_for_collapse_ = chosen;
}

void PolicyOptions::apply(firmware::ThinningSettings& settings) const {
  settings.delete_policy = delete_policy_;
  settings.delete_policy.chosen = chosen_for_delete_;
  settings.collapse_policy = collapse_policy_;
  settings.collapse_policy.chosen = chosen_for_collapse_;
}

}  // namespace usuzumi::sim
