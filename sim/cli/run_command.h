// usuzumi run: boots the device with a ROM and records what its panel shows.
#pragma once

namespace CLI {
class App;
}

namespace usuzumi::sim {

/// Adds the subcommand to `app`; when it is given, parsing runs it and sets `exit_code` (sim/common/error.h).
void add_run_command(CLI::App& app, int& exit_code);

}  // namespace usuzumi::sim
