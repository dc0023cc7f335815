// The frame around every subcommand: errors become one line on standard error and an exit code.
#pragma once

#include <functional>

namespace usuzumi::sim {

/// Runs `body` and sets `exit_code` to what it returns, or to an Error's code after printing "usuzumi: " and its line.
/// Exhausted memory and unforeseen exceptions are reported in the same way (kDevice), and so is standard output that
/// cannot be written (kCannotWrite) where printing finds out; what is still to be sent on is left to main().
void report_errors(int& exit_code, const std::function<int()>& body);

}  // namespace usuzumi::sim
