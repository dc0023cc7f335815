// usuzumi thin: the firmware's own thinning on one model, without the device around it.
#pragma once

namespace CLI {
class App;
}

namespace usuzumi::sim {

/// Adds the subcommand to `app`; when it is given, parsing runs it and sets `exit_code` (sim/common/error.h).
void add_thin_command(CLI::App& app, int& exit_code);

}  // namespace usuzumi::sim
