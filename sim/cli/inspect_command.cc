#include "sim/cli/inspect_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "sim/common/error.h"
#include "sim/common/files.h"
#include "sim/common/progress.h"
#include "sim/common/report_errors.h"
#include "sim/pack/rom_report.h"

namespace usuzumi::sim {
namespace {

struct InspectOptions {
  std::string rom;
  bool json = false;
};

int inspect(const InspectOptions& options) {
  const RomReport report = [&] {
    const Progress progress("checking " + options.rom);
    return describe_rom(read_file(options.rom), options.rom);
  }();
  if (options.json) fmt::print("{}", report.json);
  if (!report.sound) throw Error(ExitCode::kBadInput, report.error);
  if (!options.json) fmt::print("{}", report.text);
  return exit_status(ExitCode::kOk);
}

}  // namespace

void add_inspect_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<InspectOptions>();
  CLI::App* command =
      app.add_subcommand("inspect", "Say what is in a ROM image, mesh by mesh, and whether it is sound");
  command->add_option("ROM", options->rom, "ROM image: container or bare drawing data")->required();
  command->add_flag("--json", options->json,
                    "One JSON object instead of the table; {\"sound\": false, ...} for a damaged ROM");
  command->footer(
      "Example:\n  usuzumi inspect car.rom --json | jq '.meshes[] | {name, level, faces}'\nBelow the table are "
      "textures, materials, methods, and the layers of meshes by faces and bytes.\nExit code 3 where the ROM is "
      "damaged.");
  command->callback([options, &exit_code] { report_errors(exit_code, [&] { return inspect(*options); }); });
}

}  // namespace usuzumi::sim
