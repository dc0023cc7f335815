// usuzumi compare: two pictures, same or not, and where.
#pragma once

namespace CLI {
class App;
}

namespace usuzumi::sim {

/// Adds the subcommand to `app`; when it is given, parsing runs it and sets `exit_code`: 0 same, 1 differ, 2 cannot
/// compare.
void add_compare_command(CLI::App& app, int& exit_code);

}  // namespace usuzumi::sim
