#include "sim/pack/off_counts.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "sim/common/error.h"
#include "sim/common/files.h"

namespace usuzumi::sim {
namespace {

/// The next word, comments (# to the end of the line) left out; empty at the end.
std::string_view next_word(std::string_view& text) {
  for (;;) {
    const std::size_t start = text.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos) return {};
    text.remove_prefix(start);
    if (text.front() != '#') break;
    text.remove_prefix(std::min(text.find('\n'), text.size()));
  }
  const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n"));
  text.remove_prefix(word.size());
  return word;
}

/// Decimal; the largest number where it does not fit, 0 where it is none.
std::uint64_t number(std::string_view word) {
  std::uint64_t value = 0;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  return result.ec == std::errc::result_out_of_range ? UINT64_MAX : value;
}

}  // namespace

void check_off_counts(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_file(path);
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::string_view word = next_word(text);
  if (word.ends_with("OFF")) {
    if (word.ends_with("nOFF")) next_word(text);  // the dimension
    word = next_word(text);
  }
  if (word == "BINARY") return;
  const std::uint64_t vertices = number(word), faces = number(next_word(text));
  // A vertex is a digit and a separator at least, and so is a face.
  const std::uint64_t most = bytes.size() / 2;
  if (vertices > most || faces > most)
    throw Error(
        ExitCode::kBadInput,
        fmt::format("{}: claims {} vertices and {} faces in a file of {} bytes; it is damaged or cut off: export "
                    "it again",
                    path.string(), vertices, faces, bytes.size()));
}

}  // namespace usuzumi::sim
