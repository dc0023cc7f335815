// What every part of the usuzumi command throws when it cannot go on, and the exit code that goes with it.
#pragma once

#include <stdexcept>
#include <string>

namespace usuzumi::sim {

/// Exit codes of the usuzumi command; scripts rely on them.
enum class ExitCode : int {
  kOk = 0,
  kDifference = 1,   // compare only: the pictures differ
  kUsage = 2,        // bad options, or (compare) pictures that cannot be compared
  kBadInput = 3,     // an input file is missing, damaged or of a kind that is not read
  kCannotWrite = 4,  // an output file or folder, or standard output, cannot be written
  kDevice = 5,       // the drawing data do not fit the device's memory, or the device reported an error
};
constexpr int exit_status(ExitCode code) { return static_cast<int>(code); }

/// For the --help of the whole command.
inline constexpr const char* kExitCodesHelp =
    "Exit codes: 0 done; 1 pictures differ (compare); 2 bad usage, or pictures that cannot be compared;\n"
    "3 bad input file; 4 output cannot be written; 5 does not fit the device's memory, or a device error.";

/// what() is one line: where, what, and what to do about it; no trailing period, no line break.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& line) : std::runtime_error(line), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace usuzumi::sim
