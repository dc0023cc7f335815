// What rules one frame: the shadowed registers as they were latched, checked once and unpacked.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "gfx_subsystem/display/compose_line.h"
#include "gfx_subsystem/display/fifo.h"
#include "hal/bus.h"
#include "hal/registers/display.h"

namespace usuzumi::gfx {

struct Window {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;
};

/// A layer, or the cursor: a window full of pixels in memory.
struct LayerConfig {
  bool shown = false;
  BusAddress address = 0;
  std::uint32_t stride_bytes = 0;
  std::int32_t x = 0, y = 0;
  std::uint32_t width = 0, height = 0;
  LayerRow look;                  // format, alpha and key; pixels and range are each line's
  std::uint32_t error_bit = 0;    // its bit in CFGE
};

struct FrameConfig {
  static constexpr std::size_t kCursor = display_registers::kLayerCount;  // drawn last
  std::uint32_t background_rgb = 0;
  std::array<LayerConfig, kCursor + 1> layers;  // back to front
  bool picture_signature = false, window_signature = false, check_window = false;
  Window window;
  std::uint32_t reference_crc = 0;
};

/// Where a layer meets a line of the picture.
struct RowCut {
  bool visible = false;
  std::uint64_t address = 0;   // of the first visible pixel; above 32 bits when the layer runs out of the address space
  std::uint32_t x_begin = 0, x_end = 0;
};

/// Cuts the layer to a picture `width` pixels wide at line `line`.
constexpr RowCut cut_row(const LayerConfig& layer, std::uint32_t line, std::uint32_t width) {
  const std::int64_t row = std::int64_t{line} - layer.y;
  const std::int64_t begin = layer.x > 0 ? layer.x : 0;
  const std::int64_t layer_end = std::int64_t{layer.x} + layer.width;
  const std::int64_t end = layer_end < std::int64_t{width} ? layer_end : std::int64_t{width};
  if (!layer.shown || row < 0 || row >= std::int64_t{layer.height} || begin >= end) return {};
  const std::uint64_t skipped = static_cast<std::uint64_t>(begin - layer.x) * bytes_per_pixel(layer.look.format);
  return {true, layer.address + static_cast<std::uint64_t>(row) * layer.stride_bytes + skipped,
          static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
}

}  // namespace usuzumi::gfx
