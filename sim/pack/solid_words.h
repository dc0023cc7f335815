// Solids in the words of authors: kinds and sizes by name, for scene files and reports.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "firmware/solids/solid_format.h"

namespace usuzumi::sim {

struct SolidWords {
  std::string_view kind;
  std::array<std::string_view, firmware::format::kMaxSolidSizes> sizes;  // as many as the kind has
};

/// By number of format::SolidKind.
inline constexpr std::array<SolidWords, firmware::format::kSolidKindCount> kSolidWords{{
    {"sphere", {"diameter"}},
    {"hemisphere", {"diameter"}},
    {"cone", {"diameter", "height"}},
    {"cylinder", {"diameter", "height"}},
    {"frustum-cone", {"bottom_diameter", "top_diameter", "height"}},
    {"cube", {"edge"}},
    {"cuboid", {"width", "height", "depth"}},
    {"square-pyramid", {"edge", "height"}},
    {"triangular-pyramid", {"base", "depth", "height"}},
    {"trapezoid", {"bottom_width", "bottom_depth", "top_width", "top_depth", "height"}},
}};

/// Nothing where there is no such kind.
std::optional<firmware::format::SolidKind> solid_kind_of(std::string_view word);

}  // namespace usuzumi::sim
