// What boards give the golden cases, as boards/ divides their memory: the host plays them as if it were the board. RAM
// and VRAM are those of sim/machine/board.cc; a test holds them together.
#pragma once

#include <cstddef>
#include <string_view>

namespace usuzumi::golden {

struct BoardBudget {
  std::string_view board;
  std::size_t ram_bytes, vram_bytes, engine_work_bytes;
};

inline constexpr std::size_t kKiB = 1024, kMiB = 1024 * kKiB;
inline constexpr BoardBudget kBoardBudgets[] = {
    {"host", 16 * kMiB, 64 * kMiB, 8 * kMiB},
    {"cortex-m7", 320 * kKiB, 4 * kMiB, 208 * kKiB},
    {"cortex-a9", 8 * kMiB, 8 * kMiB, 1 * kMiB},
    {"linux-arm64", 32 * kMiB, 32 * kMiB, 16 * kMiB},
};

}  // namespace usuzumi::golden
