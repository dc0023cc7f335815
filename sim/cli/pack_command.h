// usuzumi pack: model files in, a ROM image out.
#pragma once

namespace CLI {
class App;
}

namespace usuzumi::sim {

/// Adds the subcommand to `app`; when it is given, parsing runs it and sets `exit_code` (sim/common/error.h).
void add_pack_command(CLI::App& app, int& exit_code);

}  // namespace usuzumi::sim
