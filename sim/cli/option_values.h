// Values that several subcommands take as options.
#pragma once

#include <cstdint>
#include <string>

#include "firmware/simplify/simplify.h"
#include "sim/pack/model.h"

namespace usuzumi::sim {

/// "1200" (faces) or "25%" of `option`. Throws Error kUsage.
FaceQuota quota_option(const std::string& option, const std::string& value);

/// "optimal" or "midpoint"; the parser has checked it.
firmware::Placement placement_option(const std::string& value);

/// "1920x720". Throws Error kUsage.
struct PictureSize {
  std::uint32_t width = 0, height = 0;
};
PictureSize size_option(const std::string& option, const std::string& value);

/// A whole number of at most `limit`. Throws Error kUsage.
std::uint32_t count_option(const std::string& option, const std::string& value, std::uint32_t limit);

}  // namespace usuzumi::sim
