#include "sim/pack/solid_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "sim/pack/appearance_report.h"
#include "sim/pack/solid_words.h"

namespace usuzumi::sim {
namespace {

namespace format = firmware::format;

struct NamedSizes {
  const SolidWords& words;
  std::uint32_t count;
};

NamedSizes sizes_of(const format::Solid& solid) {
  const auto kind = static_cast<std::size_t>(solid.kind);
  return {kSolidWords[kind], format::kSolidSizeCount[kind]};
}

}  // namespace

nlohmann::ordered_json solids_json(const firmware::DrawingData& data) {
  auto list = nlohmann::ordered_json::array();
  for (const format::Solid& solid : data.solids().solids) {
    const auto [words, count] = sizes_of(solid);
    nlohmann::ordered_json j{{"name", std::string(data.name_of(solid))}, {"kind", std::string(words.kind)}};
    for (std::uint32_t i = 0; i < count; ++i) j[std::string(words.sizes[i])] = solid.size[i];
    j["colour"] = colour_label({solid.colour});
    j["transform"] = solid.to_model;
    list.push_back(std::move(j));
  }
  return list;
}

std::string solids_text(const firmware::DrawingData& data) {
  const firmware::SolidsView& solids = data.solids();
  if (solids.solids.empty()) return {};
  std::size_t width = 4;
  for (const format::Solid& solid : solids.solids)
    width = std::max(width, std::min<std::size_t>(data.name_of(solid).size(), 32));
  std::string out = fmt::format("{:>5}  {:<{}}  {:<18}  {:<8}  {:<24}  {}\n", "solid", "name", width, "kind", "colour",
                                "place", "size");
  std::uint32_t number = 0;
  for (const format::Solid& solid : solids.solids) {
    const auto [words, count] = sizes_of(solid);
    const std::string_view name = data.name_of(solid);
    const std::string place =
        fmt::format("{:.4g},{:.4g},{:.4g}", solid.to_model[3], solid.to_model[7], solid.to_model[11]);
    out += fmt::format("{:>5}  {:<{}}  {:<18}  {:<8}  {:<24} ", ++number, name.empty() ? "-" : name, width, words.kind,
                       colour_label({solid.colour}), place);
    for (std::uint32_t i = 0; i < count; ++i) out += fmt::format(" {} {:g}", words.sizes[i], solid.size[i]);
    out += "\n";
  }
  const format::SolidDetail& d = solids.detail;
  out += fmt::format("members: high, medium, low of spheres {}x{}, {}x{}, {}x{} faces, of round sides {}, {}, {}; "
                     "{} view candidates\n",
                     d.sphere_around[0], d.sphere_rows[0], d.sphere_around[1], d.sphere_rows[1], d.sphere_around[2],
                     d.sphere_rows[2], d.round_sides[0], d.round_sides[1], d.round_sides[2], solids.candidates.size());
  return out;
}

}  // namespace usuzumi::sim
