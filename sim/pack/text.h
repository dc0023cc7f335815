// Text of others made fit for one line of ours.
#pragma once

#include <string>
#include <string_view>

namespace usuzumi::sim {

/// `text` without line breaks and control characters, trimmed, cut off after 300 bytes.
inline std::string one_line(std::string_view text) {
  constexpr std::size_t kMost = 300;
  std::string line;
  for (char c : text) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
    if (!control) line += c;
    else if (!line.empty() && line.back() != ' ') line += ' ';
    if (line.size() >= kMost) {
      line += "…";
      break;
    }
  }
  while (!line.empty() && (line.back() == ' ' || line.back() == '.')) line.pop_back();
  return line;
}

}  // namespace usuzumi::sim
