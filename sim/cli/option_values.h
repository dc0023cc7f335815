// Values that several subcommands take as options.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/simplify/simplify.h"
#include "firmware/solids/solid_choice.h"
#include "sim/pack/model.h"

namespace CLI {
class Validator;
}

namespace usuzumi::sim {

/// "1200" (faces) or "25%" of `option`. Throws Error kUsage.
FaceQuota quota_option(const std::string& option, const std::string& value);

/// "100,60,36", per cent of a mesh's faces, as millionths. Throws Error kUsage.
std::vector<std::uint32_t> layers_option(const std::string& option, const std::string& value);

/// "32,24,16", pixels that do not rise. Throws Error kUsage.
firmware::Thresholds thresholds_option(const std::string& option, const std::string& value);

/// "optimal" or "midpoint"; the parser has checked it.
firmware::Placement placement_option(const std::string& value);

/// "1920x720". Throws Error kUsage.
struct PictureSize {
  std::uint32_t width = 0, height = 0;
};
PictureSize size_option(const std::string& option, const std::string& value);

/// Decimal digits and nothing else; nullopt also above `most`.
std::optional<std::uint64_t> parse_whole_number(std::string_view text, std::uint64_t most);

/// For CLI::Option::transform(): the parser by itself takes -1 for 2^64 - 1 and 010 for eight.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most);

}  // namespace usuzumi::sim
