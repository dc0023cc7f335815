// GPIO chips for the stand-ins of both libgpiods: levels, edges in a queue that overflows, lines that others hold.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

namespace usuzumi::linux_hal::testing {

struct FakeEdge {
  unsigned offset = 0;
  bool rising = false;  // logical
  std::uint64_t time_ns = 0;
};

struct FakeLine {
  bool level = false;  // the voltage
  bool active_low = false, requested = false, output = false, edges = false;
  bool held_by_another = false, has_interrupt = true, broken = false;
  std::deque<FakeEdge> queue;
  unsigned chatter = 0;  // edges still to come, as fast as they are read
  bool active() const { return level != active_low; }
};

struct FakeChip {
  static constexpr std::size_t kQueue = 16;  // edges the kernel keeps for a line; later ones are lost

  std::string path = "/dev/gpiochip0", name = "gpiochip0", label = "9030000.pl061";
  std::array<FakeLine, 8> lines;
  int open_error = 0;  // errno
  std::uint64_t now_ns = 1'000'000'000;

  /// Sets the voltage of an input; the kernel sees the edge a microsecond later.
  void drive(unsigned offset, bool level);
  /// A pulse so short that the kernel finds the old level when it looks: two edges of the same name.
  void glitch(unsigned offset);
  int requested_lines() const;
  /// Whether edges wait, those of a line that chatters among them.
  bool edges_wait(unsigned offset);
};

struct FakeChips {
  std::vector<FakeChip*> chips;
  int open_chips = 0, objects = 0;  // of the library: taken and not given back
  std::function<void()> on_wait;    // called when edges are waited for, with time to wait
};

/// What the stand-ins look into.
FakeChips& fake_chips();
/// nullptr with errno.
FakeChip* open_fake_chip(const char* path);

}  // namespace usuzumi::linux_hal::testing
