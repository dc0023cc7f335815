// Standard input, output and error as they are handed to the program: closed, full, or fine.
#pragma once

#include <string_view>

namespace usuzumi::sim {

/// Occupies closed standard descriptors, so that no file the program opens later takes their numbers and receives what
/// is meant for people. What is written to them still fails. Call it first in main().
void occupy_closed_standard_streams();

/// "usuzumi: LINE" on standard error. Where that cannot be written, there is nobody to tell.
void print_error(std::string_view line) noexcept;

/// "note: LINE" on standard error: nothing is wrong, but the user should know.
void print_note(std::string_view line) noexcept;

}  // namespace usuzumi::sim
