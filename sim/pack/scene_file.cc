#include "sim/pack/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "firmware/simplify/bounds.h"
#include "firmware/solids/solid_placement.h"
#include "hal/trigonometry.h"
#include "sim/common/error.h"
#include "sim/common/files.h"
#include "sim/common/strict_json.h"
#include "sim/pack/names.h"
#include "sim/pack/solid_words.h"

namespace usuzumi::sim {
namespace {

namespace format = firmware::format;
using json = nlohmann::ordered_json;

/// Reads what is at `where`; every complaint begins with that.
class Reader {
 public:
  Reader(std::string where, const json& value) : where_(std::move(where)), value_(value) {}

  [[noreturn]] void fail(const std::string& what) const { throw Error(ExitCode::kBadInput, where_ + ": " + what); }
  const json& value() const { return value_; }
  bool has(const char* key) const { return value_.contains(key); }

  void expect_object(const char* what) const {
    if (!value_.is_object()) fail(fmt::format("must be an object{}", what));
  }
  template <class Allowed>
  void expect_keys(const Allowed& allowed, const std::string& list) const {
    for (const auto& [key, value] : value_.items())
      if (std::find(allowed.begin(), allowed.end(), key) == allowed.end())
        fail(fmt::format("\"{}\" is none of {}", key, list));
  }

  float number(std::string_view key) const {
    const auto found = value_.find(key);
    if (found == value_.end()) fail(fmt::format("there is no \"{}\": give a number", key));
    if (!found->is_number()) fail(fmt::format("\"{}\" must be a number", key));
    return found->get<float>();
  }
  template <std::size_t N>
  std::array<float, N> numbers(std::string_view key, const json& list) const {
    bool good = list.is_array() && list.size() == N;
    for (std::size_t i = 0; good && i < N; ++i) good = list[i].is_number();
    if (!good) fail(fmt::format("\"{}\" must be {} numbers", key, N));
    std::array<float, N> out;
    for (std::size_t i = 0; i < N; ++i) out[i] = list[i].get<float>();
    return out;
  }
  std::uint32_t count(std::string_view key, const json& n, std::uint32_t least, std::uint32_t most) const {
    if (!n.is_number_integer() || n.get<double>() < least || n.get<double>() > most)
      fail(fmt::format("\"{}\" must have whole numbers from {} to {} here", key, least, most));
    return n.get<std::uint32_t>();
  }

 private:
  std::string where_;
  const json& value_;
};

Rgba8 colour_of(const Reader& r) {
  if (!r.has("colour")) return {};
  const json& value = r.value()["colour"];
  const std::string text = value.is_string() ? value.get<std::string>() : std::string();
  const bool good = text.size() == 7 && text[0] == '#' &&
                    text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (!good) r.fail("\"colour\" must be \"#rrggbb\"");
  const auto rgb = static_cast<std::uint32_t>(std::stoul(text.substr(1), nullptr, 16));
  return rgba8(rgb >> 16, rgb >> 8 & 255, rgb & 255);
}

/// Row-major 3 x 3, about x, then y, then z.
std::array<double, 9> turned(const std::array<float, 3>& degrees) {
  const auto at = [&](std::size_t i) { return sin_cos(double{degrees[i]} * kPi / 180); };
  const SinCos x = at(0), y = at(1), z = at(2);
  return {z.cos * y.cos, z.cos * y.sin * x.sin - z.sin * x.cos, z.cos * y.sin * x.cos + z.sin * x.sin,
          z.sin * y.cos, z.sin * y.sin * x.sin + z.cos * x.cos, z.sin * y.sin * x.cos - z.cos * x.sin,
          -y.sin,        y.cos * x.sin,                         y.cos * x.cos};
}

std::array<float, 12> placement_of(const Reader& r) {
  if (r.has("transform")) {
    if (r.has("position") || r.has("rotation_deg") || r.has("scale"))
      r.fail("has \"transform\" and position, rotation_deg or scale; give one or the other");
    return r.numbers<12>("transform", r.value()["transform"]);
  }
  const auto three = [&](const char* key, std::array<float, 3> otherwise) {
    if (!r.has(key)) return otherwise;
    const json& value = r.value()[key];
    if (std::string_view(key) == "scale" && value.is_number()) {
      const auto all = value.get<float>();
      return std::array<float, 3>{all, all, all};
    }
    return r.numbers<3>(key, value);
  };
  const auto position = three("position", {0, 0, 0}), scale = three("scale", {1, 1, 1});
  const auto degrees = three("rotation_deg", {0, 0, 0});
  for (const float angle : degrees)
    if (!(std::fabs(angle) <= 1e6f)) r.fail("\"rotation_deg\" must be within a million degrees");
  const auto rotation = turned(degrees);
  std::array<float, 12> out;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t c = 0; c < 3; ++c) out[4 * row + c] = static_cast<float>(rotation[3 * row + c] * double{scale[c]});
    out[4 * row + 3] = position[row];
  }
  return out;
}

Solid read_solid(const std::string& where, const json& value) {
  const Reader r(where, value);
  r.expect_object(" with \"kind\"");
  if (!r.has("kind") || !value["kind"].is_string()) r.fail("there is no \"kind\": give sphere, cone, cube, ...");
  const auto kind = solid_kind_of(value["kind"].get<std::string>());
  if (!kind) {
    std::string kinds;
    for (const SolidWords& words : kSolidWords) kinds += fmt::format("{}{}", kinds.empty() ? "" : ", ", words.kind);
    r.fail(fmt::format("kind \"{}\" is none of {}", value["kind"].get<std::string>(), kinds));
  }
  const auto number = static_cast<std::uint32_t>(*kind);
  std::vector<std::string_view> keys{"name",         "kind",  "colour",   "position",
                                     "rotation_deg", "scale", "transform"};
  Solid solid;
  solid.kind = *kind;
  for (std::uint32_t i = 0; i < format::kSolidSizeCount[number]; ++i) {
    const std::string_view word = kSolidWords[number].sizes[i];
    keys.push_back(word);
    solid.size[i] = r.number(word);
    if (!(solid.size[i] >= format::kLeastSolidSize && solid.size[i] <= firmware::kMaxCoordinate))
      r.fail(fmt::format("\"{}\" must be above 0, from 1e-6 to 1e8, not {}", word, solid.size[i]));
  }
  r.expect_keys(keys, fmt::format("{}", fmt::join(keys, ", ")));
  if (r.has("name")) {
    if (!value["name"].is_string()) r.fail("\"name\" must be text");
    solid.name = clean_name(value["name"].get<std::string>());
  }
  solid.to_model = placement_of(r);
  solid.colour = colour_of(r);
  format::Solid placed{.kind = solid.kind};
  std::copy(solid.size.begin(), solid.size.end(), placed.size);
  std::copy(solid.to_model.begin(), solid.to_model.end(), placed.to_model);
  if (!firmware::is_placed_soundly(placed)) r.fail("is placed flat, shrunk below 1e-6, or beyond 1e8 or -1e8");
  return solid;
}

void read_around_and_rows(const Reader& r, const char* key, std::uint32_t* around, std::uint32_t* rows,
                          std::uint32_t least_rows) {
  if (!r.has(key)) return;
  const json& members = r.value()[key];
  if (!members.is_array() || members.size() != format::kFacedMembers)
    r.fail(fmt::format("\"{}\" must have three pairs, for the high, the medium and the low member", key));
  for (std::size_t m = 0; m < format::kFacedMembers; ++m) {
    if (!members[m].is_array() || members[m].size() != 2) r.fail(fmt::format("\"{}\" must have pairs", key));
    around[m] = r.count(key, members[m][0], 3, format::kMaxAround);
    rows[m] = r.count(key, members[m][1], least_rows, format::kMaxRows);
  }
}

format::SolidDetail read_detail(const std::string& where, const json& value) {
  const Reader r(where, value);
  r.expect_object(" with sphere, hemisphere or round");
  r.expect_keys(std::array<std::string_view, 3>{"sphere", "hemisphere", "round"}, "sphere, hemisphere, round");
  format::SolidDetail detail;
  read_around_and_rows(r, "sphere", detail.sphere_around, detail.sphere_rows, 2);
  read_around_and_rows(r, "hemisphere", detail.hemisphere_around, detail.hemisphere_rows, 1);
  if (!r.has("round")) return detail;
  const json& sides = value["round"];
  if (!sides.is_array() || sides.size() != format::kFacedMembers)
    r.fail("\"round\" must have three numbers, for the high, the medium and the low member");
  for (std::size_t m = 0; m < format::kFacedMembers; ++m)
    detail.round_sides[m] = r.count("round", sides[m], 3, format::kMaxAround);
  return detail;
}

std::vector<Vec3> read_candidates(const std::string& where, const json& value) {
  const Reader r(where, value);
  if (!value.is_array() || value.empty() || value.size() > format::kMaxViewCandidates)
    r.fail(fmt::format("must be 1 to {} directions", format::kMaxViewCandidates));
  std::vector<Vec3> candidates;
  for (const json& entry : value) {
    const auto v = r.numbers<3>("view_candidates", entry);
    const Vec3 direction{v[0], v[1], v[2]};
    const float l = length(direction);
    if (!(l > 0) || !std::isfinite(l)) r.fail("has a direction of no length");
    candidates.push_back(direction * (1.0f / l));
  }
  return candidates;
}

}  // namespace

std::optional<format::SolidKind> solid_kind_of(std::string_view word) {
  for (std::uint32_t i = 0; i < kSolidWords.size(); ++i)
    if (kSolidWords[i].kind == word) return static_cast<format::SolidKind>(i);
  return std::nullopt;
}

bool is_scene_file_name(const std::filesystem::path& path) { return lower_extension(path) == ".json"; }

SceneFile read_scene_file(const std::filesystem::path& path) {
  const std::string file = path.string();
  const json all = read_strict_json(path);
  const Reader r(file, all);
  r.expect_object(" with \"solids\"");
  r.expect_keys(std::array<std::string_view, 4>{"solids", "models", "view_candidates", "detail"},
                "solids, models, view_candidates, detail");
  SceneFile scene;
  if (!r.has("solids") || !all["solids"].is_array() || all["solids"].empty())
    r.fail("\"solids\" must be a list of at least one solid");
  if (all["solids"].size() > format::kMaxSolids)
    r.fail(fmt::format("{} solids, but drawing data hold at most {}", all["solids"].size(), format::kMaxSolids));
  for (std::size_t i = 0; i < all["solids"].size(); ++i) {
    const json& value = all["solids"][i];
    const bool named = value.is_object() && value.contains("name") && value["name"].is_string();
    scene.model.solids.push_back(read_solid(
        named ? fmt::format("{}: solid {} ({})", file, i + 1, clean_name(value["name"].get<std::string>()))
              : fmt::format("{}: solid {}", file, i + 1),
        value));
  }
  if (r.has("view_candidates"))
    scene.model.view_candidates = read_candidates(file + ": view_candidates", all["view_candidates"]);
  if (r.has("detail")) scene.model.solid_detail = read_detail(file + ": detail", all["detail"]);
  if (r.has("models")) {
    const json& models = all["models"];
    if (!models.is_array()) r.fail("\"models\" must be a list of file names");
    for (const json& name : models) {
      if (!name.is_string()) r.fail("\"models\" must be a list of file names");
      scene.models.push_back(path.parent_path() / name.get<std::string>());
    }
  }
  return scene;
}

}  // namespace usuzumi::sim
