#include "boards/cortex-m7/options.h"

#include <charconv>

namespace usuzumi::boards::cortex_m7 {
namespace {

/// Cuts the first word off.
std::string_view take_word(std::string_view& text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  const std::string_view word = text.substr(0, text.find(' '));
  text.remove_prefix(word.size());
  return word;
}

}  // namespace

bool read_number(std::string_view text, std::uint32_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}

std::string_view read_options(std::string_view command_line, RunConfig& config, PinScript& pins) {
  take_word(command_line);  // the program's name
  for (std::string_view word = take_word(command_line); !word.empty(); word = take_word(command_line)) {
    bool sound = true;
    if (word == "--orbit") config.orbit = true;
    else if (word == "--full") config.thinning.enabled = false;
    else if (word == "--frames") sound = read_number(take_word(command_line), config.frames);
    else if (word == "--gpio") sound = pins.read(take_word(command_line));
    else sound = false;
    if (!sound) return word;
  }
  return {};
}

}  // namespace usuzumi::boards::cortex_m7
