#include "boards/common/command_line.h"

#include <charconv>

namespace usuzumi::boards {

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

OptionRead read_run_option(std::string_view word, std::string_view& rest, RunConfig& config) {
  if (word == "--orbit") config.orbit = true;
  else if (word == "--full") config.thinning.enabled = false;
  else if (word != "--frames") return OptionRead::kOther;
  else if (!read_number(take_word(rest), config.frames)) return OptionRead::kWrongValue;
  return OptionRead::kRead;
}

}  // namespace usuzumi::boards
