#include "boards/linux-arm64/changed_lines.h"

#include <algorithm>

namespace usuzumi::linux_arm64 {

bool ChangedLines::is_news(std::string_view line) {
  constexpr std::string_view kFrame = "frame ", kSignature = " crc32=", kNumbers = " meshes=", kFault = " fault=";
  if (!line.starts_with(kFrame)) return true;
  line.remove_prefix(std::min(line.find(' ', kFrame.size()), line.size()));  // each frame has its own number
  const std::size_t end = std::min(line.find(kSignature), line.find(kNumbers));
  if (end == line.npos) return true;  // no frame's line after all
  const std::string_view state = line.substr(0, end);
  const std::size_t fault = line.find(kFault);
  std::array<char, 320> words;
  std::size_t size = 0;
  for (const std::string_view part : {state, fault != line.npos ? line.substr(fault) : std::string_view{}})
    for (const char c : part)
      if (size < words.size()) words[size++] = c;
  const bool news = std::string_view(words.data(), size) != std::string_view(last_.data(), last_size_);
  last_ = words;
  last_size_ = size;
  return news;
}

}  // namespace usuzumi::linux_arm64
