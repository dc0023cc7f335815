// What a panel wants to be sent, and the modes for common panels at about 60 frames a second.
#pragma once

#include <cstdint>

#include "hal/registers/display.h"
#include "hal/status.h"

namespace usuzumi {

/// Picture size, blanking and pixel clock. A line is picture, front porch, sync, back porch, in this order; so is a
/// frame.
struct DisplayMode {
  std::uint32_t width = 0, height = 0;                                             // pixels, lines
  std::uint32_t h_front_porch = 0, h_sync = 0, h_back_porch = 0;                   // pixels
  std::uint32_t v_front_porch = 0, v_sync = 0, v_back_porch = 0;                   // lines
  std::uint32_t clock_divider = 1;  // pixel clock = 400 MHz / this; 1..64

  constexpr std::uint32_t line_pixels() const { return width + h_front_porch + h_sync + h_back_porch; }
  constexpr std::uint32_t frame_lines() const { return height + v_front_porch + v_sync + v_back_porch; }
  /// Rounded down.
  constexpr std::uint32_t pixel_clock_hz() const { return display_registers::kReferenceClockHz / clock_divider; }
  /// Reference clock ticks from one frame's start to the next.
  constexpr std::uint64_t frame_ticks() const {
    return std::uint64_t{line_pixels()} * frame_lines() * clock_divider;
  }
  /// Rounded down; 60 Hz is 60000.
  constexpr std::uint32_t refresh_millihertz() const {
    return static_cast<std::uint32_t>(std::uint64_t{display_registers::kReferenceClockHz} * 1000 / frame_ticks());
  }
  friend constexpr bool operator==(const DisplayMode&, const DisplayMode&) = default;
};

/// Porches and pixel clocks as data sheets of such panels give them, the clock being the nearest 400 MHz / n.
inline constexpr DisplayMode kMode480x272{480, 272, 2, 41, 2, 4, 10, 2, 44};      // 9.09 MHz, 60.13 Hz
inline constexpr DisplayMode kMode800x480{800, 480, 40, 128, 88, 10, 2, 33, 12};  // 33.33 MHz, 60.13 Hz
inline constexpr DisplayMode kMode1280x480{1280, 480, 40, 48, 40, 10, 2, 33, 9};  // 44.44 MHz, 60.13 Hz
inline constexpr DisplayMode kMode1920x720{1920, 720, 48, 32, 80, 36, 10, 35, 4}; // 100 MHz, 60.02 Hz

/// A legal mode for any size from 16 x 16 to 4096 x 4096: one of the above when the size is theirs; otherwise the
/// slowest pixel clock that reaches 60 frames a second, with the back porches stretched to meet it (60 to 60.2 Hz).
/// Pictures too large for 400 MHz at 60 Hz get 400 MHz and what refresh that gives (4096 x 4096: 23.3 Hz).
/// kInvalidArgument for sizes out of range.
Result<DisplayMode> make_display_mode(std::uint32_t width, std::uint32_t height);

/// The mode in register values. Zero-length porches and syncs wrap to values that timing_fault() refuses.
constexpr display_registers::Timing timing_of(const DisplayMode& m) {
  return {.htp = m.line_pixels() - 1,
          .hdp = m.width - 1,
          .hsp = m.width + m.h_front_porch - 1,
          .hsw = m.h_sync - 1,
          .vtr = m.frame_lines() - 1,
          .vdp = m.height - 1,
          .vsp = m.height + m.v_front_porch - 1,
          .vsw = m.v_sync - 1,
          .sc = m.clock_divider - 1};
}

}  // namespace usuzumi
