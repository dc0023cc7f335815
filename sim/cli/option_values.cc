#include "sim/cli/option_values.h"

#include <fmt/format.h>

#include <charconv>

#include "sim/common/error.h"
#include "sim/pack/tag_values.h"

namespace usuzumi::sim {
namespace {

/// The display controller's bounds.
constexpr std::uint32_t kLeastSize = 16, kMostSize = 4096;

}  // namespace

FaceQuota quota_option(const std::string& option, const std::string& value) {
  Tags tags;
  const std::string fault = set_tag(tags, kQuotaKey, {.number = {}, .truth = {}, .text = value});
  if (!fault.empty()) throw Error(ExitCode::kUsage, fmt::format("{} {}: {}", option, value, fault));
  return *tags.quota;
}

firmware::Placement placement_option(const std::string& value) {
  return value == "midpoint" ? firmware::Placement::kMidpoint : firmware::Placement::kOptimal;
}

std::uint32_t count_option(const std::string& option, const std::string& value, std::uint32_t limit) {
  std::uint32_t n = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), n);
  if (error != std::errc{} || end != value.data() + value.size() || n > limit)
    throw Error(ExitCode::kUsage, fmt::format("{} {}: must be a whole number up to {}", option, value, limit));
  return n;
}

PictureSize size_option(const std::string& option, const std::string& value) {
  const auto x = value.find('x');
  if (x != std::string::npos) {
    try {
      const PictureSize size{count_option(option, value.substr(0, x), kMostSize), count_option(option, value.substr(x + 1), kMostSize)};
      if (size.width >= kLeastSize && size.height >= kLeastSize) return size;
    } catch (const Error&) {
    }
  }
  throw Error(ExitCode::kUsage, fmt::format("{} {}: must be WIDTHxHEIGHT in pixels, each {} to {}, e.g. 1920x720", option, value, kLeastSize, kMostSize));
}

}  // namespace usuzumi::sim
