#include "sim/pack/names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <utility>

namespace usuzumi::sim {
namespace {

constexpr std::size_t kMostSuggestions = 3;
constexpr std::size_t kMostListed = 10;  // arbitrary; all properties of a mesh fit in

/// "Wheel" of "Wheel#2".
std::string_view without_number(std::string_view name) {
  const std::size_t hash = name.find_last_not_of("0123456789");
  const bool numbered = hash != std::string_view::npos && name[hash] == '#' && hash + 1 < name.size();
  return numbered ? name.substr(0, hash) : name;
}

bool is_or_matches(std::string_view pattern, std::string_view text) {
  return pattern == text || matches_pattern(pattern, text);
}

}  // namespace

bool matches_pattern(std::string_view pattern, std::string_view text) {
  // On a mismatch the last * takes one more character; earlier ones need never be reconsidered.
  std::size_t p = 0, t = 0, star = std::string_view::npos, star_text = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      star_text = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++star_text;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

bool matches_name(std::string_view pattern, std::string_view name) {
  constexpr std::string_view kFirst = "#1";
  const std::string_view base = without_number(name);
  if (is_or_matches(pattern, name) || is_or_matches(pattern, base)) return true;
  return pattern.ends_with(kFirst) && base == name &&
         is_or_matches(pattern.substr(0, pattern.size() - kFirst.size()), name);
}

bool matches_mesh(std::string_view pattern, const Mesh& mesh) {
  return matches_name(pattern, mesh.name) || (!mesh.node_name.empty() && is_or_matches(pattern, mesh.node_name));
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t change = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, change});
    }
  }
  return row[b.size()];
}

std::string suggest(std::string_view wanted, std::span<const std::string> names) {
  const std::set<std::string> distinct(names.begin(), names.end());
  std::vector<std::pair<std::size_t, std::string>> close;
  for (const std::string& name : distinct) {
    const std::size_t distance = edit_distance(wanted, name);
    if (distance <= std::max<std::size_t>(2, wanted.size() / 3)) close.emplace_back(distance, name);
  }
  std::sort(close.begin(), close.end());
  if (close.size() > kMostSuggestions) close.resize(kMostSuggestions);
  std::vector<std::string> listed;
  for (const auto& [distance, name] : close) listed.push_back(name);
  if (!listed.empty()) return fmt::format("did you mean {}?", fmt::join(listed, ", "));
  for (const std::string& name : distinct)
    if (listed.size() < kMostListed) listed.push_back(name);
  return fmt::format("there are: {}{}", fmt::join(listed, ", "), distinct.size() > listed.size() ? ", …" : "");
}

void make_names_unique(Model& model) {
  std::set<std::string> used;
  for (const Mesh& mesh : model.meshes) used.insert(mesh.mesh_name);
  std::map<std::string, std::size_t> count;
  for (Mesh& mesh : model.meshes) {
    std::size_t& n = count[mesh.mesh_name];
    mesh.name = mesh.mesh_name;
    if (n++ == 0) continue;
    while (!used.insert(mesh.name = fmt::format("{}#{}", mesh.mesh_name, n)).second) ++n;
  }
}

std::string clean_name(const std::string& name) {
  using nlohmann::json;
  const std::string valid =
      json::parse(json(name).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
  std::string clean;
  for (char c : valid) clean += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '_' : c;
  return clean;
}

}  // namespace usuzumi::sim
