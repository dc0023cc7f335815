#include "boards/cortex-m7/options.h"

#include "boards/common/command_line.h"

namespace usuzumi::boards::cortex_m7 {

std::string_view read_options(std::string_view command_line, RunConfig& config, PinScript& pins) {
  take_word(command_line);  // the program's name
  for (std::string_view word = take_word(command_line); !word.empty(); word = take_word(command_line)) {
    const OptionRead read = read_run_option(word, command_line, config);
    if (read == OptionRead::kRead) continue;
    if (read == OptionRead::kWrongValue || word != "--gpio" || !pins.read(take_word(command_line))) return word;
  }
  return {};
}

}  // namespace usuzumi::boards::cortex_m7
