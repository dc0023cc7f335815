#include "sim/common/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>

namespace usuzumi::sim {
namespace {

/// Takes no heap and throws nothing: it is also called where memory has run out.
void say_on_stderr(const char* who, std::string_view line) noexcept {
  std::fprintf(stderr, "%s: %.*s\n", who, static_cast<int>(line.size()), line.data());
}

bool is_closed(int fd) { return ::fcntl(fd, F_GETFD) == -1; }

}  // namespace

void occupy_closed_standard_streams() {
  // open() takes the lowest free number. Opened in the wrong direction, and full for who opens /dev/stdout anew.
  if (is_closed(STDIN_FILENO)) static_cast<void>(::open("/dev/null", O_WRONLY));
  for (const int out : {STDOUT_FILENO, STDERR_FILENO})
    if (is_closed(out)) static_cast<void>(::open("/dev/full", O_RDONLY));
}

bool flush_standard_output() noexcept { return std::fflush(stdout) == 0 && std::ferror(stdout) == 0; }

void print_error(std::string_view line) noexcept { say_on_stderr("usuzumi", line); }
void print_note(std::string_view line) noexcept { say_on_stderr("note", line); }

void print_notes(std::span<const std::string> lines) noexcept {
  constexpr std::size_t kMost = 30;
  for (const std::string& line : lines.first(std::min(lines.size(), kMost))) print_note(line);
  if (lines.size() > kMost) std::fprintf(stderr, "note: and %zu more of this kind\n", lines.size() - kMost);
}

}  // namespace usuzumi::sim
