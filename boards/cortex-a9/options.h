// What the host asks of the program by semihosting's command line. On a board without a debugger there is none.
#pragma once

#include <string_view>

#include "boards/common/run.h"

namespace usuzumi::boards::cortex_a9 {

inline constexpr std::string_view kUsage = "--frames N, --orbit, --full, --rgb565, --size WIDTHxHEIGHT, --hold";

struct Options {
  RunConfig run;
  bool hold = false;  // after the first step already
};

/// Of a command line that begins with the program's name. Empty, or the first word that is wrong; `options` has then
/// what came before it.
std::string_view read_options(std::string_view command_line, Options& options);

}  // namespace usuzumi::boards::cortex_a9
