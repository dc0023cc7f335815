#include "boards/cortex-a9/options.h"

#include <charconv>
#include <cstdint>

namespace usuzumi::boards::cortex_a9 {
namespace {

/// Cuts the first word off.
std::string_view take_word(std::string_view& text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  const std::string_view word = text.substr(0, text.find(' '));
  text.remove_prefix(word.size());
  return word;
}

bool read_number(std::string_view text, std::uint32_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}

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
    bool sound = true;
    if (word == "--orbit") options.run.orbit = true;
    else if (word == "--full") options.run.thinning.enabled = false;
    else if (word == "--rgb565") device.pixel_format = command::PixelFormat::kRgb565;
    else if (word == "--hold") options.hold = true;
    else if (word == "--frames") sound = read_number(take_word(command_line), options.run.frames);
    else if (word == "--size") sound = read_size(take_word(command_line), device);
    else sound = false;
    if (!sound) return word;
  }
  return {};
}

}  // namespace usuzumi::boards::cortex_a9
