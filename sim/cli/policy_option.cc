#include "sim/cli/policy_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "sim/cli/option_values.h"
#include "sim/common/error.h"
#include "sim/pack/names.h"
#include "sim/pack/rom_report.h"
#include "sim/pack/tag_values.h"

namespace usuzumi::sim {
namespace {

using firmware::Level;
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

bool policy_rules(const NamedMesh& mesh, bool for_delete, bool for_collapse) {
  return (for_delete && mesh.level == Level::kDelete) || (for_collapse && mesh.level == Level::kCollapse);
}

/// Numbers of the meshes, of whatever level, whose name matches the pattern.
std::vector<std::uint32_t> matching(const std::string& word, const std::string& pattern,
                                    std::span<const NamedMesh> meshes) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t n = 0; n < meshes.size(); ++n)
    if (matches_name(pattern, meshes[n].name)) numbers.push_back(n);
  if (numbers.empty()) {
    std::vector<std::string> names;
    for (const NamedMesh& mesh : meshes)
      if (!mesh.name.empty()) names.push_back(mesh.name);
    if (names.empty()) refuse(word, "bare drawing data have no names; pack the model without --bare");
    refuse(word, fmt::format("no mesh is called {}; {}", pattern, suggest(pattern, names)));
  }
  return numbers;
}

void set_random(const std::string& word, std::string_view argument, Policy& policy) {
  const auto parts = split(argument, ':');
  const auto share = parse_share(parts[0]);
  if (!share || parts.size() > 2)
    refuse(word, "the share must be above 0 and up to 100 %, as in random:50% or, with a seed, random:50%:7");
  policy.kind = PolicyKind::kRandom;
  policy.random_millionths = *share;
  if (parts.size() == 1) return;
  const auto seed = parse_whole_number(parts[1], kMostSeed);
  if (!seed) refuse(word, fmt::format("SEED must be a whole number up to {}", kMostSeed));
  policy.seed = static_cast<std::uint32_t>(*seed);
}

}  // namespace

std::vector<NamedMesh> named_meshes(const firmware::DrawingData& data) {
  std::vector<NamedMesh> meshes;
  data.for_each_mesh([&](const firmware::MeshView& mesh) { meshes.push_back({std::string(mesh.name), mesh.level}); });
  return meshes;
}

PolicyOptions::PolicyOptions(std::span<const std::string> words, const firmware::DrawingData& data) {
  if (words.empty()) return;
  const std::vector<NamedMesh> meshes = named_meshes(data);
  for (const std::string& word : words) parse(word, meshes);
}

void PolicyOptions::parse(const std::string& word, std::span<const NamedMesh> meshes) {
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
  const char* const levels = for_delete && for_collapse ? "2 or 3" : for_delete ? "2" : "3";
  const auto ruled = [&](const NamedMesh& mesh) { return policy_rules(mesh, for_delete, for_collapse); };
  ForLevel given{word, {}, {}};
  Policy& policy = given.policy;
  if (name == "always" && colon == std::string_view::npos) {
    policy.kind = PolicyKind::kAlways;
  } else if (name == "below-area") {
    policy.kind = PolicyKind::kBelowArea;
    const auto pixels = parse_whole_number(argument, kMostPixels);
    if (!pixels) refuse(word, fmt::format("PIXELS must be a whole number up to {}", kMostPixels));
    policy.area_threshold_px = static_cast<float>(*pixels);
  } else if (name == "chosen" && !argument.empty()) {
    policy.kind = PolicyKind::kChosen;
    for (const std::string& pattern : split(argument, ',')) {
      const auto numbers = matching(word, pattern, meshes);
      if (std::none_of(numbers.begin(), numbers.end(), [&](std::uint32_t n) { return ruled(meshes[n]); }))
        notes_.push_back(fmt::format("--policy {}: choosing {} has no effect: its level is {}, the policy is for {}",
                                     word, pattern, level_label(static_cast<unsigned>(meshes[numbers.front()].level)),
                                     levels));
      given.chosen.insert(given.chosen.end(), numbers.begin(), numbers.end());
    }
    std::sort(given.chosen.begin(), given.chosen.end());
    given.chosen.erase(std::unique(given.chosen.begin(), given.chosen.end()), given.chosen.end());
  } else if (name == "random") {
    set_random(word, argument, policy);
  } else {
    refuse(word,
           "must be always, below-area:PIXELS, chosen:NAME[,NAME...] or random:SHARE%[:SEED], with 2= or 3= before it "
           "for one level");
  }
  if (std::none_of(meshes.begin(), meshes.end(), ruled))
    notes_.push_back(fmt::format("--policy {} has no effect: no mesh has level {}", word, levels));
  if (for_delete) set(delete_, "2", given);
  if (for_collapse) set(collapse_, "3", given);
}

void PolicyOptions::set(ForLevel& level, const char* number, const ForLevel& given) {
  if (!level.word.empty())
    refuse(given.word,
           fmt::format("level {} has its policy from --policy {}; give each level one", number, level.word));
  level = given;
}

void PolicyOptions::apply(firmware::ThinningSettings& settings) const {
  settings.delete_policy = delete_.policy;
  settings.delete_policy.chosen = delete_.chosen;
  settings.collapse_policy = collapse_.policy;
  settings.collapse_policy.chosen = collapse_.chosen;
}

}  // namespace usuzumi::sim
