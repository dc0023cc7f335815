#include "sim/cli/compare_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/cli/option_values.h"
#include "sim/common/error.h"
#include "sim/common/files.h"
#include "sim/common/progress.h"
#include "sim/common/report_errors.h"
#include "sim/image/compare.h"
#include "sim/image/png.h"

namespace usuzumi::sim {
namespace {

constexpr std::uint64_t kMostPngPixels = std::uint64_t{kMaxPngSize} * kMaxPngSize;

struct CompareArguments {
  std::string expected, actual, difference;
  std::uint32_t max_diff = 0;
  std::uint64_t max_pixels = 0;
  std::vector<std::string> ignore;
  bool json = false;
};

int compare(const CompareArguments& arguments) {
  CompareOptions options;
  options.max_diff = arguments.max_diff;
  options.max_pixels = arguments.max_pixels;
  for (const std::string& text : arguments.ignore) {
    const auto rectangle = parse_rectangle(text);
    if (!rectangle)
      throw Error(ExitCode::kUsage,
                  fmt::format("--ignore {}: must be x0:y0-x1:y1, both corners included, e.g. 10:20-30:40", text));
    options.ignore.push_back(*rectangle);
  }
  if (!arguments.difference.empty())
    check_output(arguments.difference, "--diff",
                 std::array<std::filesystem::path, 2>{arguments.expected, arguments.actual});
  const CompareReport report = [&] {
    const Progress progress("comparing " + arguments.actual);
    return compare_png_files(
        arguments.expected, arguments.actual, options,
        arguments.difference.empty() ? std::nullopt : std::optional<std::filesystem::path>(arguments.difference));
  }();
  if (arguments.json) {
    fmt::print("{}", report_json(report));
  } else if (report.result == CompareResult::kCannotCompare) {
    throw Error(ExitCode::kUsage, report.reason);
  } else {
    fmt::print("{}", report_text(report));
  }
  return exit_code(report.result);
}

}  // namespace

void add_compare_command(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand("compare", "Hold one picture against another");
  command->add_option("EXPECTED", arguments->expected, "PNG: the picture as it should be")->required();
  command->add_option("ACTUAL", arguments->actual, "PNG: the picture as it is")->required();
  command->add_option("--max-diff", arguments->max_diff, "Largest difference of a channel that still counts as equal")
      ->transform(whole_number(0, 255))
      ->capture_default_str();
  command->add_option("--max-pixels", arguments->max_pixels, "Pixels that may differ")
      ->transform(whole_number(0, kMostPngPixels))
      ->capture_default_str();
  command
      ->add_option("--ignore", arguments->ignore,
                   "Rectangle to leave out, x0:y0-x1:y1, both corners included. May be given several times")
      ->allow_extra_args(false);  // so that a picture may follow
  command->add_option("--diff", arguments->difference, "PNG to write: where the pictures differ, in red");
  command->add_flag("--json", arguments->json, "Report as JSON");
  command->footer(
      "Example: usuzumi compare golden.png actual.png --ignore 0:0-99:19 --diff difference.png\nExit code 0 same, 1 "
      "differ, 2 cannot compare.");
  command->callback([arguments, &exit_code] { report_errors(exit_code, [&] { return compare(*arguments); }); });
}

}  // namespace usuzumi::sim
