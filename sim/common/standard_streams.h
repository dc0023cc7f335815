// Standard input, output and error as they are handed to the program: closed, full, or fine.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace usuzumi::sim {

/// Occupies closed standard descriptors, so that no file the program opens later takes their numbers and receives what
/// is meant for people. What is written to them still fails. Call it first in main().
void occupy_closed_standard_streams();

/// Sends on what has been printed so far. False once anything printed to standard output has been lost.
[[nodiscard]] bool flush_standard_output() noexcept;

/// What the user is then told; the exit code is kCannotWrite.
inline constexpr const char* kStandardOutputLost =
    "standard output: cannot write: what was printed is lost; choose another place or free this one";

/// "usuzumi: LINE" on standard error. Where that cannot be written, there is nobody to tell.
void print_error(std::string_view line) noexcept;

/// "note: LINE" on standard error: nothing is wrong, but the user should know.
void print_note(std::string_view line) noexcept;

/// The same of each line, but of so many at most that they do not hide each other.
void print_notes(std::span<const std::string> lines) noexcept;

}  // namespace usuzumi::sim
