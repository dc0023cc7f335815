// The usuzumi command: pack, inspect, thin, run, compare.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "sim/cli/compare_command.h"
#include "sim/cli/inspect_command.h"
#include "sim/cli/pack_command.h"
#include "sim/cli/run_command.h"
#include "sim/cli/thin_command.h"
#include "sim/common/error.h"
#include "sim/common/standard_streams.h"

namespace {

using namespace usuzumi::sim;

/// A variable that a script forgot to set must not count as an option that was not given.
void refuse_empty_values(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; }))
    for (CLI::Option* option : command->get_options())
      if (option->get_items_expected() > 0)
        option->check(
            [](const std::string& value) { return value.empty() ? std::string("must not be empty") : std::string(); });
}

/// The exit code, before anybody knows whether what was printed has arrived.
int run_command_line(int argc, char** argv) {
  int exit_code = exit_status(ExitCode::kOk);
  CLI::App app("Usuzumi: an embedded drawing device for instrument clusters, simulated on the desk", "usuzumi");
  app.require_subcommand(1);
  app.set_version_flag("--version", "usuzumi " USUZUMI_VERSION);
  app.footer(std::string("Example: usuzumi pack car.glb -o car.rom && usuzumi run car.rom --out pictures\n\n") +
             kExitCodesHelp);
  add_pack_command(app, exit_code);
  add_inspect_command(app, exit_code);
  add_thin_command(app, exit_code);
  add_run_command(app, exit_code);
  add_compare_command(app, exit_code);
  refuse_empty_values(app);
  const std::string command = argc > 1 && argv[1][0] != '-' ? argv[1] : "";
  if (!command.empty() && app.get_subcommands([&](CLI::App* known) { return known->check_name(command); }).empty()) {
    print_error(fmt::format("there is no command {}; there are pack, inspect, thin, run and compare", command));
    return exit_status(ExitCode::kUsage);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& e) {
    return app.exit(e);
  } catch (const CLI::CallForAllHelp& e) {
    return app.exit(e);
  } catch (const CLI::CallForVersion& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    print_error(fmt::format("{}; see usuzumi {}--help", e.what(), command.empty() ? "" : command + " "));
    return exit_status(ExitCode::kUsage);
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  occupy_closed_standard_streams();
  const int exit_code = run_command_line(argc, argv);
  const bool is_result = exit_code == exit_status(ExitCode::kOk) || exit_code == exit_status(ExitCode::kDifference);
  if (!is_result || flush_standard_output()) return exit_code;
  print_error(kStandardOutputLost);
  return exit_status(ExitCode::kCannotWrite);
}
