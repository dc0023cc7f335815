#include "sim/cli/option_values.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
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

std::vector<std::uint32_t> layers_option(const std::string& option, const std::string& value) {
  Tags tags;
  const std::string fault = set_tag(tags, kLayersKey, {.number = {}, .truth = {}, .text = value});
  if (!fault.empty()) throw Error(ExitCode::kUsage, fmt::format("{} {}: {}", option, value, fault));
  return *tags.layers;
}

firmware::Thresholds thresholds_option(const std::string& option, const std::string& value) {
  const auto refuse = [&]() -> void {
    throw Error(ExitCode::kUsage,
                fmt::format("{} {}: must be three sizes in pixels that do not rise, like 32,24,16", option, value));
  };
  float sizes[3] = {};
  const char* at = value.data();
  const char* const end = at + value.size();
  for (std::size_t i = 0; i < 3; ++i) {
    if (i > 0 && (at == end || *at++ != ',')) refuse();
    const auto [next, error] = std::from_chars(at, end, sizes[i], std::chars_format::fixed);
    if (error != std::errc{}) refuse();
    at = next;
  }
  const firmware::Thresholds thresholds{sizes[0], sizes[1], sizes[2]};
  if (at != end || !firmware::thresholds_fall(thresholds)) refuse();
  return thresholds;
}

firmware::Placement placement_option(const std::string& value) {
  return value == "midpoint" ? firmware::Placement::kMidpoint : firmware::Placement::kOptimal;
}

std::optional<std::uint64_t> parse_whole_number(std::string_view text, std::uint64_t most) {
  std::uint64_t n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  if (error != std::errc{} || end != text.data() + text.size() || n > most) return std::nullopt;
  return n;
}

CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
  const std::string range = fmt::format("{} to {}", least, most);
  return {[=](std::string& text) {
            const auto n = parse_whole_number(text, most);
            if (!n || *n < least) return fmt::format("{} must be a whole number, {}", text, range);
            text = std::to_string(*n);  // without leading zeros
            return std::string();
          },
          range};
}

PictureSize size_option(const std::string& option, const std::string& value) {
  const auto x = value.find('x');
  if (x != std::string::npos) {
    const auto width = parse_whole_number(value.substr(0, x), kMostSize),
               height = parse_whole_number(value.substr(x + 1), kMostSize);
    if (width && height && *width >= kLeastSize && *height >= kLeastSize)
      return {static_cast<std::uint32_t>(*width), static_cast<std::uint32_t>(*height)};
  }
  throw Error(ExitCode::kUsage, fmt::format("{} {}: must be WIDTHxHEIGHT in pixels, each {} to {}, e.g. 1920x720",
                                            option, value, kLeastSize, kMostSize));
}

}  // namespace usuzumi::sim
