// What the host asks of the program by semihosting's command line.
#pragma once

#include <string_view>

#include "boards/common/run.h"
#include "boards/cortex-m7/pin_script.h"

namespace usuzumi::boards::cortex_m7 {

inline constexpr std::string_view kUsage = "--frames N, --orbit, --full, --gpio FRAME:ignition|mode=0|1,...";

/// Of a command line that begins with the program's name: --frames, --orbit and --full (the button begins at full) go
/// into `config`, --gpio into `pins`. Empty, or the first word that is wrong.
std::string_view read_options(std::string_view command_line, RunConfig& config, PinScript& pins);

}  // namespace usuzumi::boards::cortex_m7
