// What a simulated board is made of: memory sizes, clocks, and the picture it shows when nobody says otherwise.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "hal/command_list.h"

namespace usuzumi::sim {

struct BoardDescription {
  std::string_view name;
  std::size_t ram_bytes = 0;
  std::size_t vram_bytes = 0;
  std::uint64_t cpu_hz = 0;
  std::uint64_t engine_hz = 0;
  std::uint64_t bus_bytes_per_second = 0;  // what the display controller's fetches get
  std::uint32_t display_fifo_bytes = 0;
  std::uint32_t width = 0;  // pixels of the panel
  std::uint32_t height = 0;
  command::PixelFormat pixel_format = command::PixelFormat::kXrgb8888;
  command::DepthFormat depth_format = command::DepthFormat::kUnorm24;
};

/// The desk machine: plenty of memory (reserved, used only as touched), XRGB8888 with 24 bits of depth.
const BoardDescription& host_sim();

/// A small cluster: 2 MiB RAM, 1 MiB VRAM, 480x272 in RGB565 with 16 bits of depth. Two pictures and depth fill
/// 3/4 of VRAM.
const BoardDescription& small_board();

/// Every board, for `--help` and messages.
std::span<const BoardDescription> boards();

/// nullptr when no board has that name.
const BoardDescription* find_board(std::string_view name);

}  // namespace usuzumi::sim
