// The words of a command line, and the options that every board's main loop takes.
#pragma once

#include <cstdint>
#include <string_view>

#include "boards/common/run.h"

namespace usuzumi::boards {

/// Cuts the first word off, words being parted by spaces; empty where there is none left.
std::string_view take_word(std::string_view& text);

/// Decimal digits and nothing else; false where there are others, none, or too many.
bool read_number(std::string_view text, std::uint32_t& number);

enum class OptionRead { kRead, kWrongValue, kOther };

/// Takes `word` into `config` if it is --frames N (N from `rest`), --orbit or --full (the mode button begins at full).
/// kOther: it is the board's own to read.
OptionRead read_run_option(std::string_view word, std::string_view& rest, RunConfig& config);

}  // namespace usuzumi::boards
