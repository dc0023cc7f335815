#include "sim/machine/board.h"

#include <array>

#include "gfx_subsystem/engine/cost_model.h"

namespace usuzumi::sim {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

constexpr std::size_t kKiB = 1024;

constexpr std::array<BoardDescription, 5> kBoards{{
    {.name = "host-sim",
     .ram_bytes = 512 * kMiB,
     .vram_bytes = 64 * kMiB,
     .cpu_hz = 800'000'000,
     .engine_hz = gfx::kEngineClockHz,
     .bus_bytes_per_second = 3'200'000'000,  // 64 bits at 400 MHz
     .display_fifo_bytes = 8192,             // a line of 1920 pixels
     .width = 1920,
     .height = 720,
     .pixel_format = command::PixelFormat::kXrgb8888,
     .depth_format = command::DepthFormat::kUnorm24},
    {.name = "small",
     .ram_bytes = 2 * kMiB,
     .vram_bytes = 1 * kMiB,
     .cpu_hz = 400'000'000,
     .engine_hz = 100'000'000,
     .bus_bytes_per_second = 400'000'000,  // 32 bits at 100 MHz
     .display_fifo_bytes = 2048,
     .width = 480,
     .height = 272,
     .pixel_format = command::PixelFormat::kRgb565,
     .depth_format = command::DepthFormat::kUnorm16},
    // Those of boards/: what their firmware gets of memory, and their panel. The clocks are those of the parts named in
    // their READMEs, for which the cost model is no forecast.
    {.name = "cortex-m7",
     .ram_bytes = 320 * kKiB,  // of 640
     .vram_bytes = 4 * kMiB,
     .cpu_hz = 320'000'000,
     .engine_hz = 100'000'000,
     .bus_bytes_per_second = 400'000'000,
     .display_fifo_bytes = 2048,
     .width = 480,
     .height = 272,
     .pixel_format = command::PixelFormat::kRgb565,
     .depth_format = command::DepthFormat::kUnorm16},
    {.name = "cortex-a9",
     .ram_bytes = 8 * kMiB,
     .vram_bytes = 8 * kMiB,
     .cpu_hz = 533'000'000,
     .engine_hz = 133'000'000,
     .bus_bytes_per_second = 1'066'000'000,
     .display_fifo_bytes = 4096,
     .width = 800,
     .height = 480,
     .pixel_format = command::PixelFormat::kXrgb8888,
     .depth_format = command::DepthFormat::kUnorm24},
    {.name = "linux-arm64",
     .ram_bytes = 32 * kMiB,
     .vram_bytes = 32 * kMiB,
     .cpu_hz = 650'000'000,
     .engine_hz = 200'000'000,
     .bus_bytes_per_second = 2'132'000'000,
     .display_fifo_bytes = 8192,
     .width = 800,
     .height = 480,
     .pixel_format = command::PixelFormat::kXrgb8888,
     .depth_format = command::DepthFormat::kUnorm24},
}};

}  // namespace

const BoardDescription& host_sim() { return kBoards[0]; }
const BoardDescription& small_board() { return kBoards[1]; }
std::span<const BoardDescription> boards() { return kBoards; }

const BoardDescription* find_board(std::string_view name) {
  for (const BoardDescription& board : kBoards)
    if (board.name == name) return &board;
  return nullptr;
}

}  // namespace usuzumi::sim
