#include "boards/cortex-a9/options.h"

#include "boards/common/command_line.h"

namespace usuzumi::boards::cortex_a9 {
namespace {

bool read_size(std::string_view text, firmware::DeviceConfig& device) {
  const std::size_t x = text.find('x');
  return x != std::string_view::npos && read_number(text.substr(0, x), device.width) &&
         read_number(text.substr(x + 1), device.height);
}

}  // namespace

std::string_view read_options(std::string_view command_line, Options& options) {
  firmware::DeviceConfig& device = options.run.instrument.device;
  take_word(command_line);  // the program's name
  for (std::string_view word = take_word(command_line); !word.empty(); word = take_word(command_line)) {
    const OptionRead read = read_run_option(word, command_line, options.run);
    if (read == OptionRead::kRead) continue;
    bool sound = read == OptionRead::kOther;
    if (word == "--rgb565") device.pixel_format = command::PixelFormat::kRgb565;
    else if (word == "--hold") options.hold = true;
    else if (word == "--size") sound = read_size(take_word(command_line), device);
    else sound = false;
    if (!sound) return word;
  }
  return {};
}

}  // namespace usuzumi::boards::cortex_a9
