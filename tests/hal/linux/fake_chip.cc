#include "tests/hal/linux/fake_chip.h"

#include <cerrno>

namespace usuzumi::linux_hal::testing {
namespace {

constexpr std::uint64_t kLookNs = 1000;

void append(FakeLine& line, const FakeEdge& edge) {
  if (line.requested && line.edges && line.queue.size() < FakeChip::kQueue) line.queue.push_back(edge);
}

}  // namespace

void FakeChip::drive(unsigned offset, bool level) {
  FakeLine& line = lines[offset];
  now_ns += kLookNs;
  if (line.level == level) return;
  line.level = level;
  append(line, {offset, line.active(), now_ns});
}

void FakeChip::glitch(unsigned offset) {
  FakeLine& line = lines[offset];
  for (int i = 0; i < 2; ++i) append(line, {offset, line.active(), now_ns += kLookNs});
}

bool FakeChip::edges_wait(unsigned offset) {
  FakeLine& line = lines[offset];
  for (; line.chatter > 0 && line.queue.empty(); --line.chatter) drive(offset, !line.level);
  return !line.queue.empty();
}

int FakeChip::requested_lines() const {
  int count = 0;
  for (const FakeLine& line : lines) count += line.requested ? 1 : 0;
  return count;
}

FakeChips& fake_chips() {
  static FakeChips chips;
  return chips;
}

FakeChip* open_fake_chip(const char* path) {
  for (FakeChip* chip : fake_chips().chips) {
    if (chip->path != path) continue;
    errno = chip->open_error;
    return chip->open_error == 0 ? chip : nullptr;
  }
  errno = ENOENT;
  return nullptr;
}

}  // namespace usuzumi::linux_hal::testing
